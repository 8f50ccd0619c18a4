#include "clackers/measure/impacts/gap_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/base/constants.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::measure {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Values = Eigen::Map<const VectorXd>;

// b . M^-1 (f - C v - K u - p) without forming the acceleration of each mass.
class RelativeAcceleration {
 public:
  RelativeAcceleration(const FreeMotion& motion, const model::Contact<>& contact)
      : system_(motion.system()),
        response_(motion.response(contact.direction)),
        by_u_(system_.stiffness * response_),
        by_v_(system_.damping * response_),
        force_(response_.size()) {}

  double operator()(double t, const Values& u, const VectorXd& v) {
    double a = -by_u_.dot(u) - by_v_.dot(v);
    if (!system_.add_load && !system_.nonlinear) return a;
    force_.setZero();
    if (system_.nonlinear) {
      system_.nonlinear->add(u, v, force_);
      force_ = -force_;
    }
    if (system_.add_load) system_.add_load(t, {force_.data(), std::size_t(force_.size())});
    return a + response_.dot(force_);
  }

 private:
  const model::SmoothSystem<>& system_;
  VectorXd response_, by_u_, by_v_, force_;
};

Values row_of(const std::vector<double>& values, std::size_t row, Index dof) {
  return {values.data() + row * std::size_t(dof), dof};
}

// Rows of different times, every `stride`-th of them.
std::vector<std::size_t> every(const model::Trajectory& history, std::size_t stride) {
  std::vector<std::size_t> rows;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    if (i > 0 && history.t[i] == history.t[i - 1]) continue;
    if (seen++ % stride == 0) rows.push_back(i);
  }
  return rows;
}

GapRow gap_row(const model::Trajectory& history, const model::Contact<>& contact, std::size_t row) {
  return {row,
          history.t[row],
          contact.direction.dot(row_of(history.u, row, history.dof)) - contact.gap,
          0.0,
          0.0,
          0.0,
          0.0};
}

// u(t - h) = u - h v + h^2 (a(t) / 3 + a(t - h) / 6) where a is straight, solved for v, and the
// same forward; off by h^3 a'' / 24.
void find_rates(std::vector<GapRow>& gaps) {
  gaps.front().before = gaps.back().after = unknown;
  for (std::size_t i = 0; i + 1 < gaps.size(); ++i) {
    auto &here = gaps[i], &next = gaps[i + 1];
    const double h = next.t - here.t, slope = (next.g - here.g) / h;
    here.after = slope - h * (here.acceleration / 3.0 + next.acceleration / 6.0);
    next.before = slope + h * (next.acceleration / 3.0 + here.acceleration / 6.0);
  }
}

// In free motion both rates are the same, so that half of all rows being impacts or less leaves
// the median to rounding. It is local, since a motion may decay; the factor covers the tail of a
// normal distribution down to 1e-7 (5.3 deviations, one deviation being 1.5 medians).
constexpr std::size_t noise_block = 4096;
constexpr double noise_factor = 8.0;

double find_noise(std::vector<GapRow>& gaps) {
  const auto n = gaps.size();
  std::vector<double> all, block;
  for (std::size_t from = 0; from < n; from += noise_block) {
    const auto to = std::min(n, from + noise_block);
    block.clear();
    for (auto i = std::max<std::size_t>(from, 1); i < std::min(to, n - 1); ++i)
      block.push_back(std::abs(gaps[i].after - gaps[i].before));
    all.insert(all.end(), block.begin(), block.end());
    const double noise = block.empty() ? 0.0 : noise_factor * median(block);
    for (auto i = from; i < to; ++i) gaps[i].noise = noise;
  }
  return all.empty() ? 0.0 : median(std::move(all));
}

}  // namespace

double GapHistory::contact_change(std::size_t i) const {
  const auto here = *rows_[i], next = *rows_[i + 1];
  return next.after - here.before -
         0.5 * (next.t - here.t) * (here.acceleration + next.acceleration);
}

// The trapezoidal rule is off by h^3 a'' / 12, the two rates from displacements by h^3 a'' / 24
// each, so h times a sixth of the second difference of a in all; a quarter allows for h^2 a'' being
// taken from beside the interval.
double GapHistory::uncertainty(std::size_t i) const {
  double bend = 0.0;
  for (const auto middle : {i, i + 1})
    if (middle > 0 && middle + 1 < size())
      bend = std::max(bend,
                      std::abs(rows_[middle - 1]->acceleration - 2.0 * rows_[middle]->acceleration +
                               rows_[middle + 1]->acceleration));
  return 0.25 * length(i) * bend + std::max(rows_[i]->noise, rows_[i + 1]->noise);
}

GapHistory gap_history_from_velocities(const model::Trajectory& history, const FreeMotion& motion,
                                       const model::Contact<>& contact) {
  const VectorXd size = contact.direction.cwiseAbs();
  VectorXd v(history.dof);
  double largest = 0.0;
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    v = row_of(history.v, i, history.dof);
    largest = std::max(largest, std::abs(contact.direction.dot(v)));
  }
  const auto make = [&history, &contact, size, v, largest,
                     acceleration = RelativeAcceleration(motion, contact)](
                        std::size_t first, std::size_t count, GapRow* to) mutable {
    for (auto i = first; i < first + count; ++i, ++to) {
      *to = gap_row(history, contact, i);
      v = row_of(history.v, i, history.dof);
      to->before = to->after = contact.direction.dot(v);
      to->acceleration = acceleration(to->t, row_of(history.u, i, history.dof), v);
      // Six digits are right to half a unit of the last, 5e-6 of the number; a difference has two.
      to->noise = 1e-5 * size.dot(v.cwiseAbs()) + resting_rate * largest;
    }
  };
  return {history.t.size(), make};
}

GapHistory gap_history_from_displacements(const model::Trajectory& history,
                                          const FreeMotion& motion,
                                          const model::Contact<>& contact) {
  RelativeAcceleration acceleration(motion, contact);
  std::vector<GapRow> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t stride = 1;; stride *= 2) {
    std::vector<GapRow> gaps;
    for (const auto row : every(history, stride)) gaps.push_back(gap_row(history, contact, row));
    const auto n = gaps.size();
    if (n < (stride == 1 ? 3u : 32u)) break;
    VectorXd v(history.dof);
    for (std::size_t i = 0; i < n; ++i) {
      // Damping is all that asks for a velocity here: the mean slope around the row is enough.
      const auto &left = gaps[i == 0 ? 0 : i - 1], &right = gaps[std::min(i + 1, n - 1)];
      v = (row_of(history.u, right.row, history.dof) - row_of(history.u, left.row, history.dof)) /
          (right.t - left.t);
      gaps[i].acceleration =
          acceleration(gaps[i].t, row_of(history.u, gaps[i].row, history.dof), v);
    }
    find_rates(gaps);
    const double disagreement = find_noise(gaps);
    if (disagreement > 4.0 * least) break;
    if (disagreement < least) {
      least = disagreement;
      best = std::move(gaps);
    }
  }
  const auto size = best.size();
  return {size, [best = std::move(best)](std::size_t first, std::size_t count, GapRow* to) {
            std::copy_n(best.begin() + std::ptrdiff_t(first), count, to);
          }};
}

}  // namespace clackers::measure
