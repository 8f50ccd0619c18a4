#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/base/codes.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

// The least number of levels that an order needs.
constexpr int least_levels = 4;

std::string list(const std::vector<double>& steps) {
  std::string text;
  for (std::size_t i = 0; i < steps.size(); ++i)
    text += fmt::format("{}{}",
                        i == 0                  ? ""
                        : i + 1 == steps.size() ? " and "
                                                : ", ",
                        short_number(steps[i], 3));
  return text;
}

std::string with_unit(const record::Subject& subject, const std::vector<double>& steps) {
  return subject.refined_by == record::RefinementParameter::tolerance
             ? fmt::format("tolerance{} {}", steps.size() == 1 ? "" : "s", list(steps))
             : fmt::format("h = {} s", list(steps));
}

// The next finer levels: half the step, or a tenth of the tolerance.
std::vector<double> finer(const record::Subject& subject, double finest, int count) {
  const double ratio = subject.refined_by == record::RefinementParameter::tolerance ? 10.0 : 2.0;
  std::vector<double> steps;
  for (int i = 1; i <= count; ++i) steps.push_back(finest / std::pow(ratio, i));
  return steps;
}

std::vector<const measure::RunScore*> runs_of(const record::Subject& subject) {
  std::vector<const measure::RunScore*> runs;
  for (const auto& level : subject.levels)
    for (const auto& run : level.runs) runs.push_back(&run.score);
  return runs;
}

// The size of an error in words.
std::string size_text(const measure::RunScore& run) {
  const double error = run.u_error;
  if (std::isnan(error)) return "The error in u is not known.";
  if (error <= run.rounding_floor) return "The error in u is at the rounding floor.";
  if (error >= 1.0)
    return fmt::format(
        "The largest error in u is {} times the largest envelope: larger than the motion.",
        short_number(error, 2));
  if (error >= 1e-3)
    return fmt::format("The largest error in u is {} % of the largest envelope.",
                       short_number(100.0 * error, 2));
  return fmt::format("The largest error in u is {} of the largest envelope.", scientific(error));
}

std::string one_file(const record::Subject& subject, const measure::RunScore& run) {
  auto text = size_text(run);
  if (run.impacts && run.impacts->expected > 0)
    text += fmt::format(
        " {} of {} matched{}.", run.impacts->matched, counted(run.impacts->expected, "impact"),
        run.impacts->extra > 0 ? fmt::format(", {} extra", run.impacts->extra) : "");
  return text +
         fmt::format(
             " One {} gives no order: add the same run at {}; at least four are needed.",
             subject.refined_by == record::RefinementParameter::tolerance ? "tolerance" : "step",
             with_unit(subject, finer(subject, run.step, 3)));
}

}  // namespace

std::string hint_text(const record::Subject& subject) {
  if (subject.kind != record::SubjectKind::histories) return {};
  const auto runs = runs_of(subject);
  if (runs.empty()) return {};
  if (runs.size() == 1) return runs.front()->finished ? one_file(subject, *runs.front()) : "";
  const auto& fit = subject.assessment.displacement;
  if (fit.behaviour != Behaviour::undecided) return {};
  const int levels = int(subject.levels.size());
  if (levels < least_levels)
    return fmt::format(
        "{}; at least {} are needed: add the same run at {}.", counted(levels, "level"),
        least_levels, with_unit(subject, finer(subject, runs.back()->step, least_levels - levels)));
  const bool single = std::ranges::all_of(
      subject.levels, [](const record::Level& level) { return level.runs.size() == 1; });
  const bool scatters = fit.reason == "one-sample-a-level" || fit.reason == "more-samples" ||
                        fit.reason == Code("no-convergence-yet").name();
  if (single && scatters && subject.refined_by == record::RefinementParameter::step) {
    std::vector<double> between;
    for (int i = 1; i <= 3; ++i) between.push_back(runs.front()->step * std::exp2(-0.25 * i));
    return fmt::format(
        "{}, one step each: scatter cannot be distinguished from order. Add three steps between "
        "each two, as "
        "{} between the first two.",
        counted(levels, "level"), with_unit(subject, between));
  }
  if (fit.reason == Code("too-few-levels").name() ||
      fit.reason == Code("no-convergence-yet").name())
    return fmt::format("Add finer levels: {}.",
                       with_unit(subject, finer(subject, runs.back()->step, 2)));
  return {};
}

std::string refinement_text(const record::Subject& subject) {
  if (!subject.refinement) return {};
  const auto& refinement = *subject.refinement;
  std::string text;
  const auto levels = std::ssize(subject.levels);
  if (refinement.finer_levels > 0)
    text = fmt::format("{} added ({} in all).",
                       refinement.finer_levels == 1
                           ? std::string("1 finer level was")
                           : fmt::format("{} finer levels were", refinement.finer_levels),
                       levels);
  if (refinement.coarser_levels > 0)
    text += fmt::format("{}{} added.", text.empty() ? "" : " ",
                        refinement.coarser_levels == 1
                            ? std::string("1 coarser level was")
                            : fmt::format("{} coarser levels were", refinement.coarser_levels));
  if (refinement.end == record::RefinementEnd::budget && refinement.next_seconds > 0.0)
    text += fmt::format("{}The next level takes about {} s: --budget {}s.", text.empty() ? "" : " ",
                        short_number(refinement.next_seconds, 2),
                        short_number(std::ceil(1.5 * refinement.next_seconds), 3));
  return text;
}

}  // namespace clackers::report
