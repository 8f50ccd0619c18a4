#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

// The median of |x| over the standard deviation of a normal x.
constexpr double normal_median = 0.6745;
// Standard deviations of second and fourth differences of white noise of deviation 1: the root of
// 1 + 4 + 1 and of 1 + 16 + 36 + 16 + 1.
constexpr double second_gain = 2.449, fourth_gain = 8.367;

// Standard deviation of the white noise in the first rows' displacements over their scale, 0 where
// their error is no white noise: of a smooth error fourth differences are far below second ones.
double white_noise(const Observation& seen, const model::Motion& motion,
                   const Eigen::VectorXd& scale) {
  const auto& rows = seen.opening;
  const auto dof = std::size_t(motion.dof());
  constexpr std::size_t least = 50;
  std::size_t n = 0;
  while (n < rows.t.size() && rows.t[n] <= motion.end()) ++n;
  if (n < least) return 0.0;
  std::vector<double> u(n * dof), v(u.size());
  motion.sample(std::span(rows.t).first(n), model::Side::right, {u, v, {}});
  double largest = 0.0;
  for (std::size_t mass = 0; mass < dof; ++mass) {
    std::vector<double> e(n), second, fourth;
    for (std::size_t i = 0; i < n; ++i)
      e[i] = (rows.u[i * dof + mass] - u[i * dof + mass]) / scale[Eigen::Index(mass)];
    for (std::size_t i = 2; i + 2 < n; ++i) {
      second.push_back(std::abs(e[i - 1] - 2.0 * e[i] + e[i + 1]));
      fourth.push_back(
          std::abs(e[i - 2] - 4.0 * e[i - 1] + 6.0 * e[i] - 4.0 * e[i + 1] + e[i + 2]));
    }
    const double from_second = measure::median(second) / second_gain / normal_median;
    const double from_fourth = measure::median(fourth) / fourth_gain / normal_median;
    if (from_fourth > 0.7 * from_second && std::isfinite(from_fourth))
      largest = std::max(largest, from_fourth);
  }
  return largest;
}

// What printing makes of a displacement.
double printing_of(const Observation& seen) {
  const double unit = std::numeric_limits<double>::epsilon();
  return std::max(seen.facts.floor, 100.0 * unit);
}

// The same white noise in files of different steps, and much of the finest one's error.
std::optional<Diagnosis> in_rows(const DiagnosisInput& question) {
  const auto scale = question.motion.peak().u;
  const auto& finest = question.histories.back();
  const double noise = white_noise(finest, question.motion, scale);
  if (!(noise > 2.0 * printing_of(finest))) return {};
  const auto& run = question.ladder.back().runs.back();
  // The largest of a thousand normal numbers lies at 3.3 deviations.
  if (!(4.0 * noise > 0.5 * run.u_error)) return {};
  int alike = 0;
  for (const auto& seen : question.histories) {
    const double other = white_noise(seen, question.motion, scale);
    alike += other > noise / 3.0 && other < 3.0 * noise;
  }
  // One file alone may have an alternating error of the method.
  if (alike < 2) return {};
  auto found = diagnosis_of(Code("noise-floor"), run.u_error, "1");
  found.confidence = 0.95;
  found.evidence = {{"floor", run.u_error}, {"files", double(alike)}};
  return found;
}

// Errors that go up and down without falling over the finest three octaves, where impacts are
// located well: a limit would settle, a method of order 1/2 would fall by 2.8. Two of three values
// of a random sequence are turning points, at most two of one that passes zero once.
std::optional<Diagnosis> in_ladder(const DiagnosisInput& question) {
  constexpr double saturated = 0.3, above_floor = 30.0, most_factor = 2.5;
  std::vector<const measure::RunScore*> runs;  // finest first
  for (auto level = question.ladder.rbegin(); level != question.ladder.rend(); ++level)
    for (auto run = level->runs.rbegin(); run != level->runs.rend(); ++run)
      if (run->finished) runs.push_back(&*run);
  constexpr std::size_t least_runs = 8;
  if (runs.size() < least_runs || question.histories.size() < least_runs) return {};
  double least = INFINITY, largest = 0.0, sum = 0.0;
  std::vector<double> within;
  bool spans = false;
  for (const auto* run : runs) {
    if (run->step > 8.5 * runs.front()->step) break;
    spans = run->step > 7.0 * runs.front()->step;
    least = std::min(least, run->u_error);
    largest = std::max(largest, run->u_error);
    sum += std::log(run->u_error);
    within.push_back(run->u_error);
  }
  std::size_t turns = 0;
  for (std::size_t i = 1; i + 1 < within.size(); ++i)
    turns += (within[i] - within[i - 1]) * (within[i + 1] - within[i]) < 0.0;
  if (within.size() < least_runs || 3 * turns < within.size()) return {};
  const auto& finest = question.histories.back();
  const double floor = std::max(printing_of(finest), runs.front()->rounding_floor);
  if (!spans || !(least > above_floor * floor) || largest > saturated ||
      largest > most_factor * most_factor * least)
    return {};
  const double mean = std::exp(sum / double(within.size()));
  if (largest > most_factor * mean || least < mean / most_factor) return {};
  const auto located = locate_impacts(finest, question.problem);
  if (located.is_resolved()) return {};
  if (question.limit.wrong || question.limit.difference < 0.5) return {};
  auto found = diagnosis_of(Code("noise-floor"), mean, "1");
  found.confidence = 0.85;
  found.evidence = {{"floor", mean}, {"files", double(within.size())}};
  return found;
}

}  // namespace

std::vector<Diagnosis> noise_causes(const DiagnosisInput& question) {
  if (question.histories.empty() || question.ladder.empty()) return {};
  if (auto found = in_rows(question)) return {*found};
  if (auto found = in_ladder(question)) return {*found};
  return {};
}

}  // namespace clackers::diagnose
