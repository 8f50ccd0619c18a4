#include "clackers/diagnose/ladder/sanity.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/constants.hpp"
#include "clackers/diagnose/ladder/error_curve.hpp"
#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/meter.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

/// Roundings that two evaluations of one interpolant may differ by, relative to the envelope.
/// Integrators of other steps differ by more, even where their formula is exact.
constexpr double same_roundings = 8.0;
constexpr std::size_t least_common_rows = 10;
constexpr double above_rounding = 10.0;

// At how many times two histories agree to rounding; nothing where they do not at one that they have in
// common. The first row is the start of both.
std::optional<std::size_t> agree(const Observation& one, const Observation& other,
                                 const model::Kinematics& scale) {
  const auto &a = one.sample, &b = other.sample;
  const auto dof = std::size_t(a.dof);
  const double same_time = 1e-9 * std::min(one.facts.spacing, other.facts.spacing);
  std::size_t common = 0;
  for (std::size_t i = 1, j = 1; i < a.t.size() && j < b.t.size();) {
    if (std::abs(a.t[i] - b.t[j]) > same_time) {
      ++(a.t[i] < b.t[j] ? i : j);
      continue;
    }
    for (std::size_t mass = 0; mass < dof; ++mass) {
      const auto of = Eigen::Index(mass);
      const double allowed =
          same_roundings * epsilon * scale.u[of] + 2.0 * std::abs(a.t[i] - b.t[j]) * scale.v[of];
      if (std::abs(a.u[i * dof + mass] - b.u[j * dof + mass]) > allowed) return false;
    }
    ++common, ++i, ++j;
  }
  return common;
}

// The coarsest and the finest history agree with all others, at enough times in all: what agrees there
// agrees between. Grids of other steps may have only their end in common.
bool step_has_no_effect(const DiagnosisInput& question) {
  const auto& files = question.histories;
  const auto scale = question.motion.peak();
  const auto& finest = files.back();
  const double floor = std::max({finest.facts.floor, epsilon * double(finest.rows),
                                 measure::relative_bound(question.motion, scale, finest.last)});
  if (!(ErrorCurve(finest, question.motion, scale.u).largest() > above_rounding * floor))
    return false;
  for (const auto* end : {&files.front(), &finest}) {
    std::size_t common = 0;
    for (const auto& other : files) {
      if (&other == end) continue;
      const auto same = agree(*end, other, scale);
      if (!same) return false;
      common += *same;
    }
    if (common < least_common_rows) return false;
  }
  return true;
}

// Whether rows stand the farther apart the smaller the step that was given for them.
bool labels_are_reversed(std::span<const Observation> files) {
  constexpr std::size_t least_files = 3;
  constexpr double least_change = 1.05, same_product = 0.02;
  if (files.size() < least_files) return false;
  const double product = files[0].facts.step * files[0].facts.spacing;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& facts = files[i].facts;
    if (std::abs(facts.step * facts.spacing / product - 1.0) > same_product) return false;
    if (i > 0 && !(facts.spacing > least_change * files[i - 1].facts.spacing)) return false;
  }
  return true;
}

// The time between the states of a history whose rows repeat most of them, or their velocities, which
// stay where positions are moved on with them; 0 for none.
double repeated_step(const Observation& seen) {
  constexpr std::size_t least_states = 10;
  const auto& rows = seen.opening;
  const auto dof = std::size_t(rows.dof);
  const auto& values = rows.v.empty() ? rows.u : rows.v;
  std::size_t states = 0, last = 0, first = 0;
  for (std::size_t i = 1; i < rows.t.size(); ++i) {
    const auto at = values.begin() + std::ptrdiff_t(i * dof), before = at - std::ptrdiff_t(dof);
    if (std::equal(at, at + std::ptrdiff_t(dof), before)) continue;
    if (states++ == 0) first = i;
    last = i;
  }
  if (states < least_states || 3 * states > 2 * rows.t.size()) return 0.0;
  return (rows.t[last] - rows.t[first]) / double(states - 1);
}

Diagnosis sure_cause(Code code, const DiagnosisInput& question) {
  auto found = diagnosis_of(code, NAN, "");
  found.confidence = 1.0;
  found.text = question.by_tolerance ? "tolerance" : "step";
  found.evidence = {{"files", double(question.histories.size())}};
  return found;
}

// A step that histories of other steps have in common.
std::optional<Diagnosis> internal_step(const DiagnosisInput& question) {
  constexpr double other_step = 1.2, same = 0.03;
  if (question.by_tolerance) return {};
  auto found = sure_cause(Code("fixed-internal-step"), question);
  found.unit = "s";
  double coarsest = 0.0, finest = 0.0, files = 0.0;
  for (const auto& seen : question.histories) {
    const double step = repeated_step(seen);
    if (step == 0.0) continue;
    if (files++ == 0.0) {
      found.value = step;
      coarsest = seen.facts.step;
    }
    if (std::abs(step - found.value) > same * step) return {};
    finest = seen.facts.step;
  }
  if (files < 2.0 || coarsest < other_step * finest) return {};
  found.evidence = {{"files", files}};
  return found;
}

}  // namespace

std::optional<Diagnosis> no_ladder(const DiagnosisInput& question) {
  if (question.is_this_system || question.histories.size() < 2) return {};
  if (!question.by_tolerance && labels_are_reversed(question.histories))
    return sure_cause("steps-contradict-rows", question);
  if (auto found = internal_step(question)) return found;
  if (step_has_no_effect(question)) return sure_cause("step-without-effect", question);
  return {};
}

std::optional<OddRun> odd_run(const measure::Ladder& ladder, bool by_tolerance) {
  constexpr std::size_t least_runs = 6;
  // In natural logarithms: how far the others scatter, and how far above them the odd one lies.
  constexpr double largest_scatter = 0.35, least_distance = 1.6, least_lead = 8.0;
  std::vector<double> x, y;
  std::vector<OddRun> runs;
  for (std::size_t level = 0; level < ladder.size(); ++level)
    for (std::size_t i = 0; i < ladder[level].runs.size(); ++i) {
      const auto& run = ladder[level].runs[i];
      if (!run.finished || !(run.u_error > above_rounding * run.rounding_floor)) continue;
      x.push_back(std::log(run.step));
      y.push_back(std::log(run.u_error));
      runs.push_back({level, i, {}});
    }
  if (runs.size() < least_runs) return {};
  // The one whose absence leaves the others nearest to a line.
  std::size_t odd = 0;
  double least = infinity, distance = 0.0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    auto others_x = x, others_y = y;
    others_x.erase(others_x.begin() + std::ptrdiff_t(k));
    others_y.erase(others_y.begin() + std::ptrdiff_t(k));
    const auto line = numerics::fit_line(others_x, others_y);
    const double scatter = std::max(line.largest_above, line.largest_below);
    if (!(scatter < least)) continue;
    least = scatter;
    odd = k;
    distance = y[k] - line.at(x[k]);
  }
  if (!(least < largest_scatter && distance > least_distance && distance > least_lead * least))
    return {};
  // The coarsest steps and tolerances come before the line begins.
  if (x[odd] == std::ranges::max(x)) return {};
  auto& found = runs[odd];
  found.found = diagnosis_of("odd-file", std::exp(distance), "1");
  found.found.confidence = 1.0;
  found.found.text = by_tolerance ? "tolerance" : "h";
  found.found.evidence = {{"step", ladder[found.level].runs[found.run].step},
                          {"files", double(runs.size())}};
  return found;
}

}  // namespace clackers::diagnose
