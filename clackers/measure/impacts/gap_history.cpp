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

GapHistory with_gaps(const model::Trajectory& history, const model::Contact<>& contact,
                     std::vector<std::size_t> rows) {
  GapHistory gaps;
  gaps.row = std::move(rows);
  const auto n = gaps.row.size();
  for (auto* column :
       {&gaps.t, &gaps.g, &gaps.before, &gaps.after, &gaps.acceleration, &gaps.noise})
    column->assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    gaps.t[i] = history.t[gaps.row[i]];
    gaps.g[i] = contact.direction.dot(row_of(history.u, gaps.row[i], history.dof)) - contact.gap;
  }
  return gaps;
}

// u(t - h) = u - h v + h^2 (a(t) / 3 + a(t - h) / 6) where a is straight, solved for v, and the
// same forward; off by h^3 a'' / 24.
void find_rates(GapHistory& gaps) {
  const auto n = gaps.size();
  gaps.before.front() = gaps.after.back() = unknown;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = gaps.length(i), slope = (gaps.g[i + 1] - gaps.g[i]) / h;
    const double here = gaps.acceleration[i], next = gaps.acceleration[i + 1];
    gaps.after[i] = slope - h * (here / 3.0 + next / 6.0);
    gaps.before[i + 1] = slope + h * (next / 3.0 + here / 6.0);
  }
}

// In free motion both rates are the same, so that half of all rows being impacts or less leaves
// the median to rounding. It is local, since a motion may decay; the factor covers the tail of a
// normal distribution down to 1e-7 (5.3 deviations, one deviation being 1.5 medians).
constexpr std::size_t noise_block = 4096;
constexpr double noise_factor = 8.0;

double find_noise(GapHistory& gaps) {
  const auto n = gaps.size();
  std::vector<double> all, block;
  for (std::size_t from = 0; from < n; from += noise_block) {
    const auto to = std::min(n, from + noise_block);
    block.clear();
    for (auto i = std::max<std::size_t>(from, 1); i < std::min(to, n - 1); ++i)
      block.push_back(std::abs(gaps.after[i] - gaps.before[i]));
    all.insert(all.end(), block.begin(), block.end());
    std::fill(gaps.noise.begin() + std::ptrdiff_t(from), gaps.noise.begin() + std::ptrdiff_t(to),
              block.empty() ? 0.0 : noise_factor * median(block));
  }
  return all.empty() ? 0.0 : median(std::move(all));
}

}  // namespace

double GapHistory::contact_change(std::size_t i) const {
  return after[i + 1] - before[i] - 0.5 * length(i) * (acceleration[i] + acceleration[i + 1]);
}

// The trapezoidal rule is off by h^3 a'' / 12, the two rates from displacements by h^3 a'' / 24
// each, so h times a sixth of the second difference of a in all; a quarter allows for h^2 a'' being
// taken from beside the interval.
double GapHistory::uncertainty(std::size_t i) const {
  double bend = 0.0;
  for (const auto middle : {i, i + 1})
    if (middle > 0 && middle + 1 < size())
      bend = std::max(bend, std::abs(acceleration[middle - 1] - 2.0 * acceleration[middle] +
                                     acceleration[middle + 1]));
  return 0.25 * length(i) * bend + std::max(noise[i], noise[i + 1]);
}

GapHistory gap_history_from_velocities(const model::Trajectory& history, const FreeMotion& motion,
                                       const model::Contact<>& contact) {
  std::vector<std::size_t> rows(history.t.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  auto gaps = with_gaps(history, contact, std::move(rows));
  RelativeAcceleration acceleration(motion, contact);
  const VectorXd size = contact.direction.cwiseAbs();
  VectorXd v(history.dof);
  double largest = 0.0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    v = row_of(history.v, i, history.dof);
    gaps.before[i] = gaps.after[i] = contact.direction.dot(v);
    gaps.acceleration[i] = acceleration(gaps.t[i], row_of(history.u, i, history.dof), v);
    // Six digits are right to half a unit of the last, 5e-6 of the number; a difference has two.
    gaps.noise[i] = 1e-5 * size.dot(v.cwiseAbs());
    largest = std::max(largest, std::abs(gaps.before[i]));
  }
  for (double& noise : gaps.noise) noise += resting_rate * largest;
  return gaps;
}

GapHistory gap_history_from_displacements(const model::Trajectory& history,
                                          const FreeMotion& motion,
                                          const model::Contact<>& contact) {
  RelativeAcceleration acceleration(motion, contact);
  GapHistory best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t stride = 1;; stride *= 2) {
    auto gaps = with_gaps(history, contact, every(history, stride));
    const auto n = gaps.size();
    if (n < (stride == 1 ? 3u : 32u)) break;
    VectorXd v(history.dof);
    for (std::size_t i = 0; i < n; ++i) {
      // Damping is all that asks for a velocity here: the mean slope around the row is enough.
      const auto left = i == 0 ? 0 : i - 1, right = std::min(i + 1, n - 1);
      v = (row_of(history.u, gaps.row[right], history.dof) -
           row_of(history.u, gaps.row[left], history.dof)) /
          (gaps.t[right] - gaps.t[left]);
      gaps.acceleration[i] =
          acceleration(gaps.t[i], row_of(history.u, gaps.row[i], history.dof), v);
    }
    find_rates(gaps);
    const double disagreement = find_noise(gaps);
    if (disagreement > 4.0 * least) break;
    if (disagreement < least) {
      least = disagreement;
      best = std::move(gaps);
    }
  }
  return best;
}

}  // namespace clackers::measure
