#include "clackers/diagnose/ladder/limit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/diagnose/ladder/error_curve.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

// A method of order p leaves r^p - 1 at r times the finest step. Up to what an order of 1/3 leaves
// (0.25 at r = 2) differences must fall as well; an order of 1/35 (0.02) is none.
constexpr double largest_order = 1.0 / 3.0, largest_difference = 0.25;
constexpr double no_order = 1.0 / 35.0, small_difference = 0.02;
// Above what printing, rounding or the reference make of an error.
constexpr double above_floor = 10.0;
constexpr std::size_t most_compared = 40;

struct Difference {
  double step = 0.0;
  double ratio = 0.0;  ///< rms difference from the finest over the rms error of the finest
  double error = 0.0;  ///< rms error over that of the finest
};

Difference difference(const ErrorCurve& other, const ErrorCurve& finest) {
  double apart = 0.0, own = 0.0, others = 0.0;
  std::size_t n = 0;
  for (std::size_t row = 0; row < other.size(); ++row) {
    const auto fine = finest.at(other.time(row));
    if (!fine) continue;
    const auto coarse = other.at_row(row);
    for (Eigen::Index mass = 0; mass < coarse.size(); ++mass) {
      if (!std::isfinite(coarse[mass]) || !std::isfinite((*fine)[mass])) continue;
      apart += (coarse[mass] - (*fine)[mass]) * (coarse[mass] - (*fine)[mass]);
      own += (*fine)[mass] * (*fine)[mass];
      others += coarse[mass] * coarse[mass];
      ++n;
    }
  }
  constexpr std::size_t least_rows = 20;
  if (n < least_rows || own == 0.0) return {0.0, INFINITY, INFINITY};
  return {0.0, std::sqrt(apart / own), std::sqrt(others / own)};
}

// Impacts applied at the end of a step fall on the same row of two grids, one of which contains the
// other, in half of all cases; many such impacts in many files do not.
bool may_be_luck(const Observation& finest, const model::ImpactProblem<>& problem, int files) {
  const auto located = locate_impacts(finest, problem);
  if (!located.is_resolved() || located.rms_delay() > 1.05 * finest.facts.step) return false;
  constexpr int enough = 10;  // 2^-10
  return std::ssize(located.impacts) * (files - 1) < enough;
}

double order_of(const std::vector<Difference>& differences, double finest) {
  // C (h^p - h0^p) for the p of the least squares line through log d against log h; the finest
  // step's own part is left out by taking only files of at least twice its step.
  std::vector<double> x, y;
  for (const auto& one : differences)
    if (one.step > 1.9 * finest && one.ratio > 1e-6 && std::isfinite(one.ratio)) {
      x.push_back(std::log(one.step));
      y.push_back(std::log(one.ratio));
    }
  if (x.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double p = numerics::fit_line(x, y).slope;
  for (int i = 0; i < 20 && p > 0.0; ++i) {  // divide by 1 - (h0 / h)^p
    auto z = y;
    for (std::size_t k = 0; k < x.size(); ++k)
      z[k] -= std::log1p(-std::pow(finest / std::exp(x[k]), p));
    p = numerics::fit_line(x, z).slope;
  }
  return p;
}

}  // namespace

Limit limit_of(std::span<const Observation> histories, const model::ImpactProblem<>& problem,
               const model::Motion& motion) {
  Limit limit;
  if (histories.size() < 2) return limit;
  const auto scale = assess::reference_scale(motion);
  const auto& finest = histories.back();
  const double h = finest.facts.step;
  const ErrorCurve own(finest, motion, scale.u);
  limit.distance = own.largest();
  std::vector<Difference> differences;
  limit.files = 1;
  for (auto i = histories.size() - 1; i-- > 0 && differences.size() < most_compared;) {
    const auto& other = histories[i];
    if (!(other.facts.step > 1.001 * h)) continue;
    differences.push_back(difference(ErrorCurve(other, motion, scale.u), own));
    differences.back().step = other.facts.step;
    limit.files += other.facts.step <= 8.5 * h;
  }
  if (differences.empty()) return limit;
  // The files of the finest octave; the next one where that has none.
  double octave = 0.0, next_octave = 0.0, reach = 1.0;
  bool keeps_error = true;
  int within = 0;
  for (const auto& one : differences) {
    const bool first = one.step <= 2.1 * h || within == 0;
    if (first) {
      octave = std::max(octave, one.ratio);
      reach = std::max(reach, one.step / h);
      ++within;
    } else if (one.step <= 8.5 * h) {
      next_octave = std::max(next_octave, one.ratio);
    }
    if (one.step <= 8.5 * h) keeps_error = keeps_error && std::abs(one.error - 1.0) < 0.6;
  }
  limit.difference = octave;
  limit.order = order_of(differences, h);
  const double rounding = std::numeric_limits<double>::epsilon() * double(finest.rows);
  const double bound = assess::relative_bound(motion, scale, finest.last);
  const double floor = std::max({finest.facts.floor, rounding, bound});
  const bool falls = limit.files >= 3 && keeps_error && next_octave > 1.5 * octave;
  const auto most = [&](double order, double cap) {
    return std::min(cap, std::pow(reach, order) - 1.0);
  };
  limit.wrong = limit.distance > above_floor * floor &&
                (octave <= most(no_order, small_difference) ||
                 (octave <= most(largest_order, largest_difference) && falls)) &&
                !may_be_luck(finest, problem, limit.files);
  return limit;
}

}  // namespace clackers::diagnose
