#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/diagnose/ladder/located_causes.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

// Impacts at mirrored positions of a motion have one delay, so equal ones count once.
std::vector<double> distinct(std::vector<double> values, double apart) {
  std::ranges::sort(values);
  std::vector<double> kept;
  for (const double value : values)
    if (kept.empty() || value - kept.back() > apart) kept.push_back(value);
  return kept;
}

// Power of the step that a measure follows: the median of the slopes between all pairs of files at
// least a factor 1.3 apart (Theil and Sen), which single lucky steps do not move. Nothing for less
// than a factor `range` of the step.
std::optional<double> power_of_step(const std::vector<LocatedImpacts>& files, double range,
                                    const auto& measure) {
  std::vector<double> x, y, slopes;
  for (const auto& file : files) {
    const double value = measure(file);
    if (!(value > 0.0)) continue;
    x.push_back(std::log(file.step));
    y.push_back(std::log(value));
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 1; j < x.size(); ++j)
      if (x[i] - x[j] > std::log(1.3)) slopes.push_back((y[i] - y[j]) / (x[i] - x[j]));
  if (slopes.empty() || x.front() - x.back() < std::log(0.98 * range)) return {};
  return measure::median(std::move(slopes));
}

double rms_delay(const LocatedImpacts& file) { return file.rms_delay(); }

// Impacts applied at a step: delays between 0 and h, or -h and 0, spread over that range, in
// proportion to the step.
std::optional<Diagnosis> at_step(const std::vector<LocatedImpacts>& files) {
  std::vector<double> delays;  // in steps
  double sum = 0.0;
  for (const auto& file : files)
    for (const auto& impact : file.impacts) {
      delays.push_back(impact.delay / file.step);
      sum += delays.back();
    }
  const auto different = distinct(delays, 0.02);
  const double mean = sum / double(delays.size()), sign = mean > 0.0 ? 1.0 : -1.0;
  const auto beyond = [&](double least, double most) {
    return std::ranges::count_if(delays,
                                 [&](double x) { return sign * x < least || sign * x > most; });
  };
  constexpr double late_steps = 2.05;
  if (20 * beyond(-0.05, late_steps) > std::ssize(delays) || !(std::abs(mean) > 0.05)) return {};
  const bool is_later = 20 * beyond(-0.05, 1.05) > std::ssize(delays);
  const bool spread = different.size() >= 3 && different.back() - different.front() > 0.05;
  // A tolerance below half the finest step is an eighth of a step four times as long, at most.
  double largest = 0.0;
  bool has_coarse = false;
  for (const auto& file : files) {
    if (file.step < 4.0 * files.back().step) continue;
    has_coarse = true;
    for (const auto& impact : file.impacts)
      largest = std::max(largest, std::abs(impact.delay) / file.step);
  }
  const auto power = power_of_step(files, 3.0, rms_delay);
  if (has_coarse && largest < 0.2 && !(power && *power > 0.6)) return {};
  if (is_later && !power) return {};
  if (!spread && files.size() > 1) return {};
  auto found = diagnosis_of(Code("impact-at-step-end"), mean, "steps");
  found.confidence = spread && has_coarse ? 0.95 : spread ? 0.8 : 0.6;
  found.evidence = {{"files", double(files.size())}, {"step", files.back().step}};
  found.text = mean > 0.0 ? "end" : "start";
  if (is_later) found.evidence.push_back({"steps", 1.0});
  return found;
}

// Impacts that err by a lower power of the step than the flights between them, and more.
std::optional<Diagnosis> interpolated(const DiagnosisInput& question,
                                      const std::vector<LocatedImpacts>& files) {
  // Below these neither is followed any better.
  constexpr double least_impact = 1e-8, least_flight = 3e-8;
  const auto impacts = power_of_step(files, 3.0, [](const LocatedImpacts& file) {
    return file.rms_defect() > least_impact ? file.rms_defect() : 0.0;
  });
  const auto flights = power_of_step(files, 2.0, [](const LocatedImpacts& file) {
    return file.flight_defect > least_flight ? file.flight_defect : 0.0;
  });
  constexpr double least_order = 1.3, largest_order = 3.5, least_gap = 0.7, times_flights = 3.0;
  if (!impacts || *impacts < least_order || *impacts > largest_order) return {};
  const bool exact_flights = std::ranges::all_of(
      files, [](const LocatedImpacts& file) { return file.flight_defect <= least_flight; });
  if (!exact_flights && !(flights && *flights > *impacts + least_gap)) return {};
  const auto& motion = question.motion;
  const double flight = motion.end() / double(1 + motion.impact_count(motion.end()));
  const auto limiting = std::ranges::count_if(files, [&](const LocatedImpacts& file) {
    return file.rms_defect() > times_flights * file.flight_defect * flight;
  });
  if (2 * limiting < std::ssize(files)) return {};
  auto found = diagnosis_of(Code("impact-interpolated"), *impacts, "1");
  found.confidence = 0.9;
  found.evidence = {{"order", *impacts}, {"files", double(files.size())}};
  return found;
}

// Largest displacement error of the runs of that step or tolerance; NaN without one.
double error_at(const measure::Ladder& ladder, double step) {
  for (const auto& level : ladder)
    for (const auto& run : level.runs)
      if (run.finished && std::abs(run.step - step) <= 1e-9 * step) return run.u_error;
  return std::numeric_limits<double>::quiet_NaN();
}

// What late and early impacts displace, over the error of their history.
double part_of_error(const DiagnosisInput& question, const LocatedImpacts& file) {
  double displaced = 0.0;
  for (const auto& impact : file.impacts)
    displaced += 2.0 * impact.closing * std::abs(impact.delay);
  return displaced / (error_at(question.ladder, file.step) * question.motion.peak().u.minCoeff());
}

// Of the error; late impacts cancel early ones and decay, but not to next to nothing.
constexpr double least_part = 0.2, most_part = 50.0;

// Another gap than the case's, where it makes much of the finest error and is more than what solvers
// add to find contacts again.
std::optional<Diagnosis> other_gap(const DiagnosisInput& question,
                                   const std::vector<LocatedImpacts>& files, const CommonGap& gap) {
  constexpr double noticeable = 1e-5, precise = 0.02;
  const double part = part_of_error(question, files.back());
  if (!gap.is_told || !(part > least_part && part < most_part) ||
      std::abs(gap.value) < noticeable * question.motion.peak().u.maxCoeff())
    return {};
  auto found = diagnosis_of(Code("gap-differs"), gap.value, "m");
  // In a single history an error of the method may shift all rows.
  const bool is_sure = gap.spread < precise * std::abs(gap.value) && files.size() > 1;
  found.confidence = is_sure ? 0.95 : 0.75;
  found.evidence = {{"uncertainty", gap.spread}, {"files", double(files.size())}};
  return found;
}

// Delays far below a step, or the spacing of an adaptive solver's rows, that do not depend on the
// step or tolerance and make much of the finest errors.
std::optional<Diagnosis> tolerance(const DiagnosisInput& question,
                                   const std::vector<LocatedImpacts>& files) {
  constexpr std::size_t least_files = 3, most_compared = 4;
  // A delay anywhere below the tolerance scatters by a factor 3 in its logarithm, so that the slope
  // of five files is known to 1, that over five decades to 0.1.
  const double range = question.by_tolerance ? 1e3 : 3.0;
  const double largest_slope = question.by_tolerance ? 0.15 : 1.3;
  const auto power = power_of_step(files, range, rms_delay);
  if (!power || files.size() < least_files || std::abs(*power) > largest_slope) return {};
  double largest = 0.0;
  for (const auto& file : files)
    for (const auto& impact : file.impacts) largest = std::max(largest, std::abs(impact.delay));
  // Impacts of the finest file may be located well by chance.
  std::vector<double> parts;
  for (auto file = files.rbegin(); file != files.rend() && parts.size() < most_compared; ++file)
    parts.push_back(part_of_error(question, *file));
  constexpr double most_steps = 0.5;
  const double part = std::max(parts.front(), measure::median(parts));
  const double spacing =
      question.by_tolerance ? question.histories.back().facts.spacing : files.back().step;
  if (!(part > least_part && part < most_part) || largest > most_steps * spacing) return {};
  auto found = diagnosis_of(Code("impact-tolerance"), largest, "s");
  found.confidence = files.size() >= 5 ? 0.9 : 0.75;
  if (!question.by_tolerance) found.evidence = {{"steps", largest / spacing}};
  found.evidence.push_back({"files", double(files.size())});
  return found;
}

}  // namespace

std::vector<Diagnosis> delay_causes(const DiagnosisInput& question,
                                    std::vector<LocatedImpacts> all) {
  std::vector<LocatedImpacts> delayed;
  for (auto located : all) {
    // Several impacts between two rows look like one of no known restitution.
    std::erase_if(located.impacts,
                  [](const LocatedImpact& impact) { return impact.restitution_error > 1.0; });
    if (located.is_resolved() && located.step > 0.0) delayed.push_back(std::move(located));
  }
  // Of coarse files the flights may hide what fine ones show.
  constexpr std::size_t enough = 5;
  // Rows much farther apart than the steps show chords, not impacts.
  constexpr double most_steps_a_row = 8.0;
  const bool has_rows_of_steps = std::ranges::all_of(question.histories, [](const auto& file) {
    return file.facts.spacing < most_steps_a_row * file.facts.step;
  });
  const bool are_half = 2 * delayed.size() >= all.size();
  const bool are_late = !delayed.empty() && (are_half || delayed.size() >= enough);
  const auto gap = are_late ? common_gap(delayed) : std::nullopt;
  std::optional<Diagnosis> found;
  if (gap) found = other_gap(question, delayed, *gap);
  // Delays of a tolerance ladder have no step to be measured in.
  if (!gap && are_half && are_late && has_rows_of_steps && !question.by_tolerance)
    found = at_step(delayed);
  if (!found) found = not_renewed(all);
  if (!found && are_late && !gap) found = tolerance(question, delayed);
  std::erase_if(all, [](const auto& file) { return file.impacts.empty(); });
  if (!found && !question.by_tolerance) found = interpolated(question, all);
  if (found) return {*std::move(found)};
  return {};
}

}  // namespace clackers::diagnose
