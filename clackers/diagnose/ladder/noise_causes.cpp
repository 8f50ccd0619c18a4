#include <algorithm>
#include <cmath>
#include <optional>

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

}  // namespace

std::vector<Diagnosis> noise_causes(const DiagnosisInput& question) {
  if (question.histories.empty() || question.ladder.empty()) return {};
  if (auto found = in_rows(question)) return {*found};
  return {};
}

}  // namespace clackers::diagnose
