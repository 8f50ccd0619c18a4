#include "clackers/diagnose/system/least_squares.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::diagnose {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int most_iterations = 8;
constexpr std::size_t least_window_rows = 8;
/// Parameters that have no effect on a window stay as they are.
constexpr double least_effect = 1e-9;
/// A history that is nearer than this to the reference, in envelopes, has the phases of the case.
constexpr double small_distance = 0.01;

double fastest(const model::ImpactProblem<>& problem) {
  double square = 0.0;
  for (Index i = 0; i < problem.dof(); ++i)
    square = std::max(square, problem.system.stiffness(i, i) / problem.system.mass(i, i));
  return std::sqrt(square);
}

// A shift counts in radians of the fastest frequency, a gap in the smallest envelope.
std::vector<double> units_of(const FitRows& rows, const Variation& base,
                             std::span<const Parameter> parameters) {
  std::vector<double> units(parameters.size(), 1.0);
  const double omega = fastest(base.problem);
  const double largest = std::ranges::max(rows.inverse_scale);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].change == Change::time_shift && omega > 0.0) units[k] = 1.0 / omega;
    if (parameters[k].change == Change::gap && largest > 0.0) units[k] = 1.0 / largest;
  }
  return units;
}

Residual residual_of(const FitRows& rows, const Variation& base,
                     std::span<const Parameter> parameters) {
  return [&rows, &base, parameters](const std::vector<double>& values, std::size_t count) {
    Variation now = base;
    for (std::size_t k = 0; k < values.size(); ++k) now.apply(parameters[k], values[k]);
    return rows.residual(now, count);
  };
}

class Solver {
 public:
  Solver(const FitRows& rows, const Residual& residual, std::vector<double> units)
      : rows_(rows), residual_(residual), unit_(std::move(units)), values_(unit_.size(), 0.0) {}

  std::vector<double> residual(std::vector<double> values, std::size_t rows) const {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] *= unit_[k];
    return residual_(values, rows);
  }

  // The distance reached over the first rows, infinite where nothing is available.
  double improve(std::size_t rows, int iterations) {
    auto left = residual(values_, rows);
    double distance = rms(left);
    for (int iteration = 0; iteration < iterations && distance > rows_.floor; ++iteration) {
      if (left.empty() || !linearize(left, rows)) break;
      bool helped = false;
      for (double share = 1.0; share > 0.01 && !helped; share *= 0.35) {
        auto next = values_;
        for (std::size_t k = 0; k < next.size(); ++k) next[k] += share * step_[Index(k)];
        auto trial = residual(next, rows);
        const double reached = rms(trial);
        if (!(reached < distance)) continue;
        helped = true;
        const bool done = reached > 0.99 * distance;
        values_ = next;
        left = std::move(trial);
        distance = reached;
        if (done) return distance;
      }
      if (!helped) break;
    }
    return distance;
  }

  SystemFit result(double distance) {
    SystemFit fit;
    fit.distance = distance;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      fit.values.push_back(values_[k] * unit_[k]);
      const double spread = spread_.size() ? spread_[Index(k)] * unit_[k] : 0.0;
      fit.uncertainty.push_back(spread * distance);
      fit.effect.push_back(spread > 0.0 ? 2.0 / spread / std::sqrt(double(rows_.u.size())) : 0.0);
    }
    return fit;
  }
  std::vector<double>& values() { return values_; }
  void start(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) values_[k] = values[k] / unit_[k];
  }

 private:
  // The Gauss-Newton step from the present values.
  bool linearize(const std::vector<double>& left, std::size_t rows) {
    const Index size = Index(left.size()), count = Index(values_.size());
    MatrixXd slopes(size, count);
    VectorXd norms(count);
    for (Index k = 0; k < count; ++k) {
      double small = 1e-6;
      auto moved = values_;
      moved[std::size_t(k)] += small;
      auto other = residual(moved, rows);
      if (other.empty()) {  // beyond the largest value
        small = -small;
        moved[std::size_t(k)] = values_[std::size_t(k)] + small;
        other = residual(moved, rows);
      }
      if (other.size() != left.size()) return false;
      for (Index i = 0; i < size; ++i)
        slopes(i, k) = (left[std::size_t(i)] - other[std::size_t(i)]) / small;
      norms[k] = slopes.col(k).norm();
      if (norms[k] > least_effect)
        slopes.col(k) /= norms[k];
      else
        slopes.col(k).setZero();
    }
    step_ = numerics::least_squares(slopes, Eigen::Map<const VectorXd>(left.data(), size), 1e-7);
    spread_ = VectorXd::Zero(count);
    for (Index k = 0; k < count; ++k) {
      step_[k] = norms[k] > least_effect ? step_[k] / norms[k] : 0.0;
      step_[k] = std::clamp(step_[k], -0.3, 0.3);
      spread_[k] = norms[k] > least_effect ? 2.0 / norms[k] : 0.0;
    }
    return step_.allFinite();
  }

  const FitRows& rows_;
  const Residual& residual_;
  std::vector<double> unit_, values_;
  VectorXd step_, spread_;
};

}  // namespace

SystemFit fit_values(const FitRows& rows, const Residual& residual, std::vector<double> units,
                     double first_span) {
  Solver solver(rows, residual, std::move(units));
  const std::size_t all = rows.t.size();
  double best = solver.improve(all, most_iterations);
  const auto direct = solver.values();
  if (rows.distance > small_distance && !(best < 0.02 * rows.distance)) {
    std::fill(solver.values().begin(), solver.values().end(), 0.0);
    for (double span = first_span;; span *= 2.0) {
      const auto count = std::size_t(
          std::upper_bound(rows.t.begin(), rows.t.end(), rows.t.front() + span) - rows.t.begin());
      if (count >= all) break;
      if (count >= least_window_rows) solver.improve(count, 3);
    }
    const double progressive = solver.improve(all, most_iterations);
    if (progressive < best)
      best = progressive;
    else
      solver.values() = direct;
  }
  if (!std::isfinite(best)) return {};
  return solver.result(best);
}

SystemFit refine_values(const FitRows& rows, const Residual& residual, std::vector<double> units,
                        const std::vector<double>& start) {
  Solver solver(rows, residual, std::move(units));
  solver.start(start);
  const double distance = solver.improve(rows.t.size(), most_iterations);
  if (!std::isfinite(distance)) return {};
  return solver.result(distance);
}

SystemFit fit_system(const FitRows& rows, const Variation& base,
                     std::span<const Parameter> parameters) {
  return fit_values(rows, residual_of(rows, base, parameters), units_of(rows, base, parameters),
                    3.0 / std::max(fastest(base.problem), 1e-300));
}

SystemFit refine_system(const FitRows& rows, const Variation& base,
                        std::span<const Parameter> parameters, std::vector<double> start) {
  return refine_values(rows, residual_of(rows, base, parameters), units_of(rows, base, parameters),
                       start);
}

}  // namespace clackers::diagnose
