#include "clackers/diagnose/system/trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clackers::diagnose {

namespace {

// Largest and smallest closing speed of the first impacts of the reference [m/s].
std::pair<double, double> closing_speeds(const FitQuestion& question) {
  constexpr long long most = 50;
  const auto& motion = question.motion;
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  const auto count = std::min(most, motion.impact_count(motion.end()));
  for (long long k = 1; k <= count; ++k) {
    const auto impact = motion.impact(k);
    const auto& contact = question.problem.contacts[std::size_t(impact.contact)];
    const double speed = std::abs(contact.gap_rate(motion.at(impact.t, model::Side::left).v));
    least = std::min(least, speed);
    largest = std::max(largest, speed);
  }
  return {least, largest};
}

// Whether the gap keeps its contact, is where the rows turn back, and is no delay: where all impacts are
// as fast, late ones look like another gap, so that it must be more than a step away.
bool is_possible_gap(double d, const FitFile& file, const FitQuestion& question) {
  const auto& direction = question.problem.contacts.front().direction;
  double reach = 0.0;
  for (std::size_t i = 0; i < file.rows.dof(); ++i)
    if (file.rows.inverse_scale[i] > 0.0)
      reach += std::abs(direction[Eigen::Index(i)]) / file.rows.inverse_scale[i];
  if (!(std::abs(d) < 0.5 * reach)) return false;
  constexpr double as_fast = 1.05, most_steps = 1.05, most_spacings = 1.5;
  const auto [least, largest] = closing_speeds(question);
  if (std::abs(d - file.least_gap) > most_spacings * file.gap_spacing * largest) return false;
  return largest > as_fast * least || std::abs(d) > most_steps * file.step * largest;
}

// A restitution below 0 lets masses pass through each other, as a gap beyond all motion does: a
// contact that is missing.
bool is_possible(const Trial& trial, const FitQuestion& question) {
  const auto& parameter = trial.hypothesis->parameter;
  if (parameter && parameter->change == Change::gap)
    return is_possible_gap(trial.d, question.files.front(), question);
  if (!parameter || parameter->change != Change::restitution) return true;
  return question.problem.contacts.front().restitution + trial.d > -1e-3;
}

bool scales_time(const Trial& trial) {
  return trial.hypothesis->parameter && trial.hypothesis->parameter->change == Change::time_scale;
}

}  // namespace

Trial tried(const FitFile& file, const Hypothesis& hypothesis, const FitQuestion& question) {
  const auto base = hypothesis.base(question.problem);
  Trial trial{&hypothesis};
  if (!hypothesis.parameter) {
    trial.gain = file.rows.distance / rms(file.rows.residual(base, file.rows.t.size()));
    return trial;
  }
  const std::span parameters(&*hypothesis.parameter, 1);
  const bool is_late = parameters[0].change == Change::time_shift && file.late_start > 0.0;
  const auto fit = is_late ? refine_system(file.rows, base, parameters, {file.late_start})
                           : fit_system(file.rows, base, parameters);
  if (fit.values.empty()) return trial;
  trial.d = fit.values[0];
  trial.uncertainty = fit.uncertainty[0];
  trial.gain = file.rows.distance / std::max(fit.distance, 1e-300);
  return trial;
}

Trial tried_beside(const FitFile& file, const Hypothesis& hypothesis, const FitQuestion& question) {
  Trial trial{&hypothesis};
  if (file.smooth.values.empty()) return trial;
  auto parameters = question.smooth;
  const auto base = hypothesis.base(question.problem);
  SystemFit fit;
  if (hypothesis.parameter) {
    parameters.push_back(*hypothesis.parameter);
    // From the cause alone: the method's error is the smaller part where the cause is true.
    std::vector<double> start(parameters.size(), 0.0);
    start.back() = tried(file, hypothesis, question).d;
    fit = refine_system(file.rows, base, parameters, start);
  } else {
    fit = fit_system(file.rows, base, parameters);
  }
  if (fit.values.empty()) return trial;
  if (hypothesis.parameter) {
    trial.d = fit.values.back();
    trial.uncertainty = fit.uncertainty.back();
  }
  trial.gain = file.smooth.distance / std::max({fit.distance, file.rows.floor, 1e-300});
  trial.beside = std::move(fit);
  return trial;
}

Trial tried_at_step_ends(const FitFile& file, const Hypothesis& hypothesis,
                         const FitQuestion& question) {
  auto base = hypothesis.base(question.problem);
  base.law.grid = file.step;
  Trial trial{&hypothesis};
  const double late = rms(file.rows.residual(base, file.rows.t.size()));
  const auto fit = fit_system(file.rows, base, {&*hypothesis.parameter, 1});
  if (fit.values.empty()) return trial;
  trial.d = fit.values[0];
  trial.uncertainty = fit.uncertainty[0];
  trial.gain = std::min(file.rows.distance, late) / std::max(fit.distance, 1e-300);
  return trial;
}

std::vector<Trial> all_tried(Try attempt, const std::vector<Hypothesis>& hypotheses,
                             const FitQuestion& question) {
  std::vector<Trial> trials;
  for (const auto& one : hypotheses)
    trials.push_back(attempt(question.files.front(), one, question));
  for (auto& one : trials)
    if (!is_possible(one, question)) one.gain = 0.0;
  return trials;
}

Race race(const std::vector<Trial>& trials, Eigen::Index dof) {
  Race result;
  for (const auto& one : trials)
    if (one.gain > result.best.gain) result.best = one;
  if (!result.best.hypothesis) return result;
  // Without damping a wrong frequency of one mass is a wrong time as well, and likelier.
  if (scales_time(result.best))
    for (const auto& one : trials)
      if (one.gain * least_race_lead > result.best.gain && !scales_time(one) &&
          equivalent(*one.hypothesis, *result.best.hypothesis, dof)) {
        result.best = one;
        break;
      }
  for (const auto& one : trials)
    if (one.gain > result.second.gain && !equivalent(*one.hypothesis, *result.best.hypothesis, dof))
      result.second = one;
  return result;
}

}  // namespace clackers::diagnose
