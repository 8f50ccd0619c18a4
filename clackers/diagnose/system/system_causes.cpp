#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/system/limits.hpp"
#include "clackers/diagnose/system/measured_causes.hpp"
#include "clackers/diagnose/system/trials.hpp"

namespace clackers::diagnose {

namespace {

/// What methods do not change, as restitution, shows in one file earlier than what they do.
constexpr double least_impact_gain_alone = 50.0;
/// Where it does not, the distance from the reference must not fall with the step as a method's does.
constexpr double least_file_fall = 1.3;
/// A parameter beside a cause is named where it makes this part of the distance.
constexpr double least_part_beside = 0.03;
/// A shift this near to a whole number of half steps is one.
constexpr double whole_share = 0.03;

double largest_damping_ratio(const model::ImpactProblem<>& problem) {
  const auto& s = problem.system;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < s.dof(); ++i)
    largest =
        std::max(largest, s.damping(i, i) / (2.0 * std::sqrt(s.stiffness(i, i) * s.mass(i, i))));
  return largest;
}

// Whether a method's own error may have this effect at one step: relative errors of frequency of
// (omega h)^2/2 and of damping of omega h are beyond what second and first order methods make; a
// method that damps by omega h errs in frequency by (omega h)^2, which bounds the gain.
bool may_be_numerical(const Trial& trial, const FitFile& file, const FitQuestion& question) {
  const auto change = trial.hypothesis->parameter
                          ? std::optional(trial.hypothesis->parameter->change)
                          : std::nullopt;
  if (!change) return false;
  double turn = 0.0;
  const auto& s = question.problem.system;
  for (Eigen::Index i = 0; i < s.dof(); ++i)
    if (trial.hypothesis->parameter->mass < 0 || trial.hypothesis->parameter->mass == int(i))
      turn = std::max(turn, std::sqrt(s.stiffness(i, i) / s.mass(i, i)) * file.step);
  switch (*change) {
    case Change::frequency:
    case Change::frequency_at_ratio:
    case Change::mass:
      return std::abs(trial.d) < 0.5 * turn * turn;
    case Change::damping:
      return std::abs(trial.d) < turn && trial.gain * turn < least_system_gain;
    case Change::damping_share:
      return std::abs(trial.d) * largest_damping_ratio(question.problem) < turn &&
             trial.gain * turn < least_system_gain;
    case Change::time_scale:
      return std::abs(trial.d) < turn;
    default:
      return false;
  }
}

bool is_shift(const Trial& trial) {
  return trial.hypothesis->parameter && trial.hypothesis->parameter->change == Change::time_shift;
}

// Not to be told from what a method's error does to frequencies, damping and momentum.
bool is_smooth(const Parameter& parameter) {
  switch (parameter.change) {
    case Change::restitution:
    case Change::gap:
    case Change::damping_after_impact:
    case Change::time_shift:
      return false;
    default:
      return true;
  }
}

// The parameters fitted with a cause that have one value in two files: what the method's error makes
// of them falls with the step.
std::vector<Diagnosis> together_with(const Trial& fine, const Trial& coarse,
                                     const FitQuestion& question) {
  std::vector<Diagnosis> found;
  if (coarse.beside.values.empty()) return found;
  const double noticeable = least_part_beside * question.files.front().rows.distance;
  for (std::size_t k = 0; k < question.smooth.size(); ++k) {
    const double value = fine.beside.values[k];
    const double apart = std::abs(coarse.beside.values[k] - value);
    if (apart > same_share * std::abs(value) ||
        std::abs(value) * fine.beside.effect[k] < noticeable)
      continue;
    found.push_back(hypothesis_of(question.smooth[k])
                        .diagnosis(question.problem, value, apart + fine.beside.uncertainty[k]));
    found.back().confidence = sure;
    found.back().evidence.push_back({"files", 2.0});
  }
  return found;
}

// The cause that one hypothesis is, with the values of other files beside that of the finest, and what
// is wrong beside it.
std::vector<Diagnosis> judged(const Race& found, Try attempt, const FitQuestion& question) {
  const auto& best = found.best;
  const auto& finest = question.files.front();
  const double lead = best.gain / std::max(found.second.gain, 1.0);
  if (!(best.gain >= least_system_gain && lead >= least_race_lead)) return {};
  const auto& hypothesis = *best.hypothesis;
  double confidence = confidence_of(best.gain, least_system_gain), spread = best.uncertainty;
  int files = 1;
  const bool in_steps = is_shift(best) && !question.by_tolerance && finest.step > 0.0;
  const double steps = in_steps ? best.d / finest.step : 0.0;
  // Beside frequencies and damping the error of first-order methods looks like half a step.
  const double halves = attempt == tried ? std::round(2.0 * steps) : 2.0 * std::round(steps);
  const bool whole =
      in_steps && std::abs(halves) >= 1.0 && std::abs(steps - 0.5 * halves) <= whole_share;
  bool grows = false;
  std::vector<Diagnosis> beside;
  for (std::size_t i = 1; i < std::min<std::size_t>(question.files.size(), 3); ++i) {
    const auto& other = question.files[i];
    const auto trial = attempt(other, hypothesis, question);
    if (trial.gain < least_gain_beside) {
      if (i == 1 && other.rows.distance > least_file_fall * finest.rows.distance) return {};
      break;
    }
    if (hypothesis.parameter) {
      const double factor = other.step / finest.step;
      const bool constant = std::abs(trial.d - best.d) <= constant_change * std::abs(best.d);
      const bool with_step = whole && std::abs(trial.d / best.d - factor) <= 0.1 * factor;
      if (!constant && !with_step) {
        if (i == 1) return {};
        break;
      }
      grows = with_step;
      spread = std::max(spread, std::abs(trial.d - best.d * (with_step ? factor : 1.0)));
    }
    if (i == 1) beside = together_with(best, trial, question);
    ++files;
  }
  if (files == 1) {
    // A parameter among six fits an error that has grown as large as the motion.
    if (attempt == tried_beside && hypothesis.parameter) return {};
    const double least = hypothesis.parameter && !is_smooth(*hypothesis.parameter)
                             ? least_impact_gain_alone
                             : least_gain_alone;
    if (best.gain < least || may_be_numerical(best, finest, question)) return {};
    confidence = std::min(0.9, confidence_of(best.gain, least));
    // More of them are rather a clock that starts late.
    constexpr double most_steps = 10.0;
    grows = whole && std::abs(steps) <= most_steps;
  }
  auto diagnosis = hypothesis.diagnosis(question.problem, best.d, spread);
  diagnosis.confidence = confidence;
  if (grows) {
    diagnosis.value = steps;
    diagnosis.unit = "steps";
    diagnosis.evidence = {{"uncertainty", spread / finest.step}};
  }
  diagnosis.evidence.insert(diagnosis.evidence.begin(), {"gain", best.gain});
  diagnosis.evidence.push_back({"files", double(files)});
  if (found.second.hypothesis) {
    diagnosis.runner_up = found.second.hypothesis->code.name();
    diagnosis.evidence.push_back({"runner-up-gain", found.second.gain});
  }
  beside.insert(beside.begin(), std::move(diagnosis));
  return beside;
}

// Impacts that may be missed or doubled: about where the history leaves the reference.
std::pair<int, int> impacts_near_departure(const FitFile& file, const FitQuestion& question) {
  const auto& rows = file.rows;
  const std::size_t n = rows.dof();
  constexpr double departure = 0.02;
  const long long all =
      question.motion.impact_count(std::min(rows.t.back(), question.motion.end()));
  for (std::size_t i = 0; i < rows.u.size(); ++i)
    if (std::abs(rows.u[i] - rows.reference[i]) > departure) {
      const auto count = question.motion.impact_count(rows.t[i / n]);
      // Rows may be far apart.
      return {int(std::max<long long>(1, count - 4)), int(std::min(all, count + 1))};
    }
  return {1, 0};
}

// The gain of the second best hypothesis that has no parameter: worse ones are not fitted again.
double nearest_departure(const std::vector<Trial>& trials) {
  double first = 0.0, second = 0.0;
  for (const auto& one : trials) {
    if (one.hypothesis->parameter) continue;
    second = std::max(second, std::min(first, one.gain));
    first = std::max(first, one.gain);
  }
  return second;
}

// The hypotheses are about masses on springs of their own, at most two, that meet in one contact.
bool can_be_varied(const model::ImpactProblem<>& problem) {
  const auto& [mass, damping, stiffness, load, nonlinear] = problem.system;
  return problem.dof() <= 2 && problem.contacts.size() <= 1 && problem.frictions.empty() &&
         problem.unstated.empty() && !load && !nonlinear && mass.isDiagonal(0.0) &&
         damping.isDiagonal(0.0) && stiffness.isDiagonal(0.0);
}

// A factor of all impulses is another restitution as well.
bool is_restitution(const Diagnosis& found) {
  return found.code == Code("restitution-differs").name() ||
         found.code == Code("impact-impulse-wrong").name();
}

bool is_of_law(const Diagnosis& found) {
  return found.code == Code("restitution-threshold").name() ||
         found.code == Code("energy-gained-at-impacts").name() ||
         found.code == Code("restitution-scatters").name();
}

std::vector<Diagnosis> fitted_causes(const DiagnosisInput& asked) {
  auto question = fit_question(asked);
  if (question.files.empty()) return flight_causes(asked);
  const auto dof = question.problem.dof();
  auto& finest = question.files.front();

  auto hypotheses = parameter_hypotheses(question.problem);
  const auto [first, last] = impacts_near_departure(finest, question);
  if (last >= first && last < 3000)
    for (auto& one : impact_hypotheses(first, last)) hypotheses.push_back(std::move(one));

  const auto trials = all_tried(tried, hypotheses, question);
  if (auto causes = judged(race(trials, dof), tried, question); !causes.empty()) return causes;

  // The method's own error first.
  for (auto& file : question.files)
    file.smooth = fit_system(file.rows, Variation{question.problem}, question.smooth);
  const double nearest = nearest_departure(trials);
  std::vector<Hypothesis> remaining;
  for (const auto& one : trials) {
    const auto& parameter = one.hypothesis->parameter;
    if (parameter ? question.files.size() > 1 && !is_smooth(*parameter) : one.gain >= nearest)
      remaining.push_back(*one.hypothesis);
  }
  if (auto causes =
          judged(race(all_tried(tried_beside, remaining, question), dof), tried_beside, question);
      !causes.empty())
    return causes;
  if (!question.by_tolerance) {
    std::erase_if(remaining, [](const Hypothesis& one) {
      return !one.parameter || one.parameter->change != Change::restitution;
    });
    if (auto causes = judged(race(all_tried(tried_at_step_ends, remaining, question), dof),
                             tried_at_step_ends, question);
        !causes.empty())
      return causes;
  }
  auto limits = smooth_limits(question);
  return limits.empty() ? flight_causes(asked) : limits;
}

}  // namespace

std::vector<Diagnosis> system_causes(const DiagnosisInput& asked) {
  if (asked.histories.empty()) return {};
  if (!can_be_varied(asked.problem)) {
    if (auto shift = shifted_time(asked)) return {*shift};
    auto measured = measured_causes(asked);
    // Momentum that is not kept may be that of another friction.
    const auto is_explained = [](const Diagnosis& found) {
      return found.confidence >= sure && found.code != Code("momentum-not-kept").name();
    };
    if (std::ranges::any_of(measured, is_explained)) return measured;
    if (auto other = other_parameter(asked)) return {*other};
    return measured;
  }
  // What is measured at impacts stands before fits that are less sure. A restitution that is no one
  // number is not fitted.
  auto measured = impact_causes(asked);
  if (std::ranges::any_of(measured, is_of_law)) return measured;
  auto fitted = fitted_causes(asked);
  const auto restitution = std::ranges::find_if(measured, is_restitution);
  if (fitted.empty()) return measured;
  if (restitution == measured.end()) return fitted;
  auto& best = fitted.front();
  if (is_restitution(best)) best.confidence = std::max(best.confidence, restitution->confidence);
  // A missing impact does not make restitution another one.
  const bool is_of_impacts = find_cause(best.code)->group == CauseGroup::impacts;
  return best.confidence >= sure || is_of_impacts ? fitted : measured;
}

}  // namespace clackers::diagnose
