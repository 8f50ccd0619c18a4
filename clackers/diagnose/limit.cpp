#include "clackers/diagnose/limit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "clackers/diagnose/ladder/error_curve.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/errors/meter.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

// A method of order p leaves r^p - 1 at r times the finest step. Up to what an order of 1/3 leaves
// (0.25 at r = 2) differences must fall as well; an order of 1/35 (0.02) is none.
constexpr double largest_order = 1.0 / 3.0, largest_difference = 0.25;
constexpr double no_order = 1.0 / 35.0, small_difference = 0.02;
// Above what printing, rounding or the reference make of an error.
constexpr double above_floor = 10.0;
constexpr std::size_t most_compared = 40, least_rows = 20;

struct Difference {
  double step = 0.0;
  double ratio = 0.0;  ///< rms difference from the finest over the rms error of the finest
  double error = 0.0;  ///< rms error over that of the finest
};

Difference difference(const ErrorCurve& other, const ErrorCurve& finest, double step) {
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
  if (n < least_rows || own == 0.0) return {step, INFINITY, INFINITY};
  return {step, std::sqrt(apart / own), std::sqrt(others / own)};
}

// Whether the finest history's impacts come less than a step early or late, and that makes its
// error: grids that contain each other, and bisections that start from them, then have the same
// delay by chance, and two others may. Three files of other grids that agree with it do not.
bool may_be_chance(const Observation& finest, const Limit& limit, double scale, int other_grids,
                   const model::ImpactProblem<>& problem) {
  constexpr int enough = 3;
  constexpr double noticeable_gap = 1e-5;
  if (other_grids >= enough) return false;
  const auto located = locate_impacts(finest, problem);
  // One gap at impacts of other delays is none.
  const auto gap = common_gap({&located, 1});
  if (gap && std::abs(gap->value) > noticeable_gap * scale) return false;
  const double delay = located.rms_delay();
  if (!located.is_resolved() || delay > 1.05 * finest.facts.step) return false;
  double displaced = 0.0;
  for (const auto& impact : located.impacts) displaced += 2.0 * impact.closing * delay;
  return displaced > 0.15 * limit.distance * scale;
}

bool is_multiple(double step, double finest) {
  const double ratio = step / finest;
  return std::abs(ratio - std::round(ratio)) < 1e-3 * ratio;
}

// Errors of four histories h, 2 h, 4 h, 8 h at common times, finest first.
using Octaves = std::array<Eigen::VectorXd, 4>;

// The limit of a smooth sequence whose error still falls: extrapolated from three histories each,
// twice, with the ratio that their differences show. For C h^p + D h^(p+1) both are O(h^(p+1)) and
// differ by a factor 4 or more; a limit stays. Its largest entry, 0 where it is none.
double extrapolated_distance(const Octaves& e, double floor) {
  struct Step {
    double ratio = 0.0, off = INFINITY;  ///< of differences; their part that is not in proportion
    Eigen::VectorXd limit;
  };
  const auto extrapolated = [&](std::size_t i) {
    const Eigen::VectorXd fine = e[i + 1] - e[i], coarse = e[i + 2] - e[i + 1];
    Step one;
    one.ratio = coarse.dot(fine) / fine.squaredNorm();
    one.off = (coarse - one.ratio * fine).norm() / coarse.norm();
    one.limit = e[i] - fine / (one.ratio - 1.0);
    return one;
  };
  const auto fine = extrapolated(0), coarse = extrapolated(1);
  constexpr double least_ratio = 1.4, largest_off = 0.1, largest_change = 0.2, least_share = 0.1;
  const double distance = fine.limit.lpNorm<Eigen::Infinity>();
  const bool stays = fine.ratio > least_ratio && coarse.ratio > least_ratio &&
                     fine.off < largest_off && coarse.off < largest_off &&
                     (fine.limit - coarse.limit).norm() < largest_change * fine.limit.norm() &&
                     fine.limit.norm() > least_share * e[0].norm() &&
                     distance > above_floor * floor;
  return stays ? distance : 0.0;
}

// The last impact of the reference before which the error is no more than a small part of its largest.
std::optional<Departure> departure_of(const ErrorCurve& finest, const model::Motion& motion) {
  constexpr double small_part = 0.02;
  constexpr long long most_impacts = 2000;
  const double small = small_part * finest.largest();
  for (std::size_t row = 0; row < finest.size(); ++row) {
    const auto error = finest.at_row(row);
    for (const double one : error)
      if (std::abs(one) > small) {
        const auto count = std::min(motion.impact_count(finest.time(row)), most_impacts);
        return Departure{count, count > 0 ? motion.impact(count).t : finest.time(row)};
      }
  }
  return {};
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

// Histories of 1, 2, 4 and 8 times the step of number `finest`; nothing where one is missing.
std::optional<Octaves> octaves_from(const std::vector<ErrorCurve>& curves,
                                    const std::vector<double>& steps, std::size_t finest) {
  std::array<const ErrorCurve*, 4> four{&curves[finest]};
  for (std::size_t k = 1; k < four.size(); ++k)
    for (std::size_t i = 0; i < curves.size(); ++i)
      if (std::abs(steps[i] / (steps[finest] * std::exp2(double(k))) - 1.0) < 0.02)
        four[k] = &curves[i];
  if (std::ranges::find(four, nullptr) != four.end()) return {};
  const auto& coarsest = *four.back();
  std::array<std::vector<double>, 4> values;
  for (std::size_t row = 0; row < coarsest.size(); ++row) {
    std::array<Eigen::VectorXd, 4> e;
    e[3] = coarsest.at_row(row);
    bool known = e[3].allFinite();
    for (std::size_t k = 0; k < 3 && known; ++k) {
      const auto one = four[k]->at(coarsest.time(row));
      known = one && one->allFinite();
      if (known) e[k] = *one;
    }
    if (!known) continue;
    for (std::size_t k = 0; k < 4; ++k) values[k].insert(values[k].end(), e[k].begin(), e[k].end());
  }
  if (values[0].size() < least_rows) return {};
  Octaves found;
  for (std::size_t k = 0; k < 4; ++k)
    found[k] = Eigen::Map<const Eigen::VectorXd>(values[k].data(), Eigen::Index(values[k].size()));
  return found;
}

}  // namespace

Limit limit_of(std::span<const Observation> histories, const model::ImpactProblem<>& problem,
               const model::Motion& motion) {
  Limit limit;
  if (histories.empty()) return limit;
  const auto scale = motion.peak();
  std::vector<ErrorCurve> curves;  // finest first
  std::vector<double> steps;
  for (auto i = histories.size(); i-- > 0 && curves.size() < most_compared;) {
    const double step = histories[i].facts.step;
    if (!steps.empty() && !(step > 1.001 * steps.back())) continue;
    curves.emplace_back(histories[i], motion, scale.u);
    steps.push_back(step);
  }
  limit.departure = departure_of(curves.front(), motion);
  if (histories.size() < 2) return limit;
  const auto& finest = histories.back();
  const double h = steps.front();
  limit.distance = curves.front().largest();
  limit.files = 1;
  // The files of the finest octave, or the next one where that has none, and of the two before it.
  std::vector<Difference> differences;
  double octave = 0.0, earlier = 0.0, reach = 1.0;
  bool keeps_error = true;
  int other_grids = 0;
  for (std::size_t i = 1; i < curves.size(); ++i) {
    differences.push_back(difference(curves[i], curves.front(), steps[i]));
    const auto& one = differences.back();
    if (i == 1 || one.step <= 2.1 * h) {
      octave = std::max(octave, one.ratio);
      reach = std::max(reach, one.step / h);
    } else if (one.step <= 8.5 * h) {
      earlier = std::max(earlier, one.ratio);
    }
    if (one.step > 8.5 * h) continue;
    ++limit.files;
    keeps_error = keeps_error && std::abs(one.error - 1.0) < 0.6;
    other_grids += !is_multiple(one.step, h) && one.ratio <= largest_difference;
  }
  if (differences.empty()) return limit;
  limit.difference = octave;
  limit.order = order_of(differences, h);
  const double floor =
      std::max({finest.facts.floor, std::numeric_limits<double>::epsilon() * double(finest.rows),
                measure::relative_bound(motion, scale, finest.last)});
  if (!(limit.distance > above_floor * floor)) return limit;
  if (may_be_chance(finest, limit, scale.u.maxCoeff(), other_grids, problem)) return limit;
  const auto most = [&](double order, double cap) {
    return std::min(cap, std::pow(reach, order) - 1.0);
  };
  const bool falls = limit.files >= 3 && keeps_error && earlier > 1.5 * octave;
  limit.wrong = octave <= most(no_order, small_difference) ||
                (octave <= most(largest_order, largest_difference) && falls);
  if (limit.wrong) return limit;
  // Every history of the finest octave that has its three coarser ones must say the same.
  int elsewhere = 0, chains = 0;
  for (std::size_t i = 0; i < curves.size() && steps[i] < 1.9 * h; ++i)
    if (const auto four = octaves_from(curves, steps, i)) {
      ++chains;
      const double distance = extrapolated_distance(*four, floor);
      elsewhere += distance > 0.0;
      if (i == 0 && distance > 0.0) limit.distance = distance;
    }
  limit.wrong = chains > 0 && elsewhere == chains;
  return limit;
}

}  // namespace clackers::diagnose
