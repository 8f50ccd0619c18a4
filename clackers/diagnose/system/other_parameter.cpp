#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clackers/base/number.hpp"
#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/system/measured_causes.hpp"
#include "clackers/diagnose/system/trials.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

/// Each value is a motion that is made anew: those of meshes take seconds.
constexpr int most_masses = 8;
/// Parameters whose fits leave this much of each other are as good; between that and the lead, none is believed.
constexpr double as_good = 2.0;

/// The rows that all parameters are fitted to; those that explain these are fitted to all rows.
constexpr std::size_t most_rows = 100;

/// What has another value: a parameter, or the clock, whose times are a factor too large.
struct Candidate {
  CaseParameter parameter;
  bool is_clock = false;
  /// The motion at the times of a file; empty where it is not available.
  std::function<model::Trajectory(double value, std::span<const double> t, bool with_v)> rows_of{};

  /// Of candidates that explain as much the lower one is believed.
  int rank() const { return is_clock ? 2 : parameter.is_setting ? 0 : 1; }
};

struct ParameterFit {
  const Candidate* candidate;
  double value = 0.0, uncertainty = 0.0;
  double distance = INFINITY;
  double v_distance = 0.0;  ///< of velocities, at least `distance`
};

std::vector<Candidate> candidates_of(const DiagnosisInput& question) {
  std::vector<Candidate> all;
  for (const auto& parameter : question.family.parameters)
    all.push_back({parameter, false,
                   [&family = question.family, parameter](double value, std::span<const double> t,
                                                          bool with_v) -> model::Trajectory {
                     auto changed = parameter;
                     changed.value = value;
                     const auto motion = family.motion_of(std::array{changed});
                     if (motion == nullptr || motion->end() < t.back()) return {};
                     return reference_rows(*motion, t, with_v);
                   }});
  all.push_back({{"", 1.0, "1"},
                 true,
                 [&motion = question.motion](double factor, std::span<const double> t,
                                             bool with_v) -> model::Trajectory {
                   std::vector<double> times(t.begin(), t.end());
                   for (double& time : times) time /= factor;
                   return reference_rows(motion, times, with_v);
                 }});
  return all;
}

// Relative to the value of the case, which may be 0.
double unit_of(const CaseParameter& parameter) {
  return parameter.value == 0.0 ? 1.0 : std::abs(parameter.value);
}

// From the value of the case, or from one that is near already.
ParameterFit fitted(const FitRows& rows, const Candidate& candidate,
                    std::optional<double> near = {}) {
  const auto& parameter = candidate.parameter;
  const auto residual = [&](const std::vector<double>& change,
                            std::size_t count) -> std::vector<double> {
    auto left =
        candidate.rows_of(parameter.value + change[0], std::span(rows.t).first(count), false).u;
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i] = rows.u[i] - left[i] * rows.inverse_scale[i % rows.dof()];
    return left;
  };
  constexpr double first_part = 1.0 / 64.0;
  const std::vector<double> units{unit_of(parameter)};
  const auto fit =
      near ? refine_values(rows, residual, units, {*near - parameter.value})
           : fit_values(rows, residual, units, first_part * (rows.t.back() - rows.t[0]));
  ParameterFit found{&candidate};
  if (fit.values.empty() || fit.values[0] == 0.0) return found;
  found.value = parameter.value + fit.values[0];
  found.uncertainty = fit.uncertainty[0];
  found.distance = std::max(fit.distance, rows.floor);
  return found;
}

FitRows thinned(const FitRows& rows) {
  FitRows few = rows;
  const std::size_t n = rows.dof(), stride = (rows.t.size() + most_rows - 1) / most_rows;
  few.t.clear();
  few.u.clear();
  for (std::size_t i = 0; i < rows.t.size(); i += stride) {
    few.t.push_back(rows.t[i]);
    for (std::size_t j = 0; j < n; ++j) few.u.push_back(rows.u[i * n + j]);
  }
  return few;
}

// Those that explain the rows, and the next best, the best first.
std::vector<ParameterFit> fitted_to_all(const FitRows& rows,
                                        const std::vector<Candidate>& candidates) {
  constexpr double apart = least_race_lead * least_race_lead;
  const auto few = thinned(rows);
  std::vector<ParameterFit> fits;
  for (const auto& candidate : candidates) fits.push_back(fitted(few, candidate));
  const double best = std::ranges::min(fits, {}, &ParameterFit::distance).distance;
  if (!(rows.distance > best * 0.5 * least_system_gain)) return {};
  for (auto& fit : fits)
    if (fit.distance < apart * best) fit = fitted(rows, *fit.candidate, fit.value);
  std::ranges::stable_sort(fits, {}, &ParameterFit::distance);
  return fits;
}

// Of fits that displacements do not tell apart, those that velocities do not either, and of these the
// first to be believed.
void keep_likeliest(std::vector<ParameterFit>& fits, const Observation& seen,
                    const model::Motion& motion) {
  const FileSample sample(seen, motion);
  if (sample.has_v()) {
    for (auto& fit : fits) {
      const auto rows = fit.candidate->rows_of(fit.value, sample.rows().t, true);
      fit.v_distance = rows.t.empty() ? INFINITY : sample.distance_between(sample.rows(), rows).v;
      fit.v_distance = std::max(fit.v_distance, fit.distance);
    }
    const double most = as_good * std::ranges::min(fits, {}, &ParameterFit::v_distance).v_distance;
    std::erase_if(fits, [&](const ParameterFit& fit) { return fit.v_distance > most; });
  }
  const auto rank = [](const ParameterFit& fit) { return fit.candidate->rank(); };
  const int first = rank(std::ranges::min(fits, {}, rank));
  std::erase_if(fits, [&](const ParameterFit& fit) { return rank(fit) > first; });
}

// Whether a motion obeys the equations of the case between impacts, so that only impacts differ: at nine
// in ten of the times at which the case moves freely, which must be most of the run.
bool has_flights_of_case(const model::Motion& motion, const DiagnosisInput& question,
                         const std::vector<double>& times) {
  constexpr double rounding = 1e-9, exceptions = 0.1;
  const measure::FreeMotion free(question.problem.system);
  const double largest = rounding * question.motion.peak().a.maxCoeff();
  const auto is_free = [&](const model::Motion& any, double t) {
    const auto now = any.at(t, model::Side::right);
    return (now.a - free.acceleration(t, now.u, now.v)).cwiseAbs().maxCoeff() <= largest;
  };
  std::size_t known = 0, others = 0;
  for (const double t : times) {
    if (!is_free(question.motion, t)) continue;
    ++known;
    if (!is_free(motion, t)) ++others;
  }
  return 2 * known >= times.size() && double(others) <= exceptions * double(known);
}

// Whether a method's own error may be this: of flights those of the period grow as (w h)^2/2 w t, those
// of damping as w h w t/2 and are no other parameter to more than the next power of w h.
bool may_be_numerical(const ParameterFit& fit, const FitRows& rows,
                      const DiagnosisInput& question) {
  if (!fit.candidate->is_clock) {
    auto changed = fit.candidate->parameter;
    changed.value = fit.value;
    const auto motion = question.family.motion_of(std::array{changed});
    if (has_flights_of_case(*motion, question, thinned(rows).t)) return false;
  }
  const double distance = rows.distance, gain = distance / fit.distance,
               step = question.histories.back().facts.step;
  const auto peak = question.motion.peak();
  double omega = 0.0;
  for (Eigen::Index i = 0; i < peak.u.size(); ++i)
    if (peak.u[i] > 0.0)
      omega = std::max({omega, peak.v[i] / peak.u[i], std::sqrt(peak.a[i] / peak.u[i])});
  const double turn = omega * step, turns = omega * question.motion.end();
  return distance < 0.5 * turn * turn * turns ||
         (distance < 0.5 * turn * turns && gain * turn < least_system_gain);
}

bool has_impacts_of(int contact, const model::Motion& motion) {
  constexpr long long most = 2000;
  const auto count = std::min(motion.impact_count(motion.end()), most);
  for (long long index = 1; index <= count; ++index)
    if (motion.impact(index).contact == contact) return true;
  return false;
}

// Whether the case has impacts at the contact whose gap this is, and none with the gap that was found.
bool is_never_closed(const ParameterFit& fit, const DiagnosisInput& question) {
  auto changed = fit.candidate->parameter;
  if (changed.gap_of < 0) return false;
  changed.value = fit.value;
  return has_impacts_of(changed.gap_of, question.motion) &&
         !has_impacts_of(changed.gap_of, *question.family.motion_of(std::array{changed}));
}

Diagnosis diagnosis_of_all(const std::vector<ParameterFit>& found, const DiagnosisInput& question) {
  const auto& best = found.front();
  const auto& parameter = best.candidate->parameter;
  if (is_never_closed(best, question)) {
    auto one = diagnosis_of(Code("impact-missed"), NAN, "1");
    one.evidence = {{"contact", parameter.gap_of + 1.0}, {"share", 1.0}};
    return one;
  }
  if (best.candidate->is_clock) {
    auto one = diagnosis_of(Code("time-unit"), best.value, parameter.unit);
    one.evidence = {{"uncertainty", best.uncertainty}};
    return one;
  }
  if (found.size() == 1) {
    auto one = diagnosis_of(Code("parameter-differs"), best.value, parameter.unit);
    one.text = parameter.name;
    one.evidence = {{"uncertainty", best.uncertainty}, {"expected", parameter.value}};
    return one;
  }
  auto one = diagnosis_of(Code("parameter-differs"), NAN, "");
  for (const auto& fit : found)
    one.text += fmt::format("{}{} = {}", one.text.empty() ? "" : " or ",
                            fit.candidate->parameter.name, short_number(fit.value, 6));
  return one;
}

}  // namespace

std::optional<Diagnosis> other_parameter(const DiagnosisInput& question) {
  if (question.motion.dof() > most_masses || question.family.parameters.empty()) return {};
  const auto& finest = question.histories.back();
  const auto rows = fit_rows(finest, question.motion);
  if (!rows.is_far()) return {};
  const auto candidates = candidates_of(question);
  auto fits = fitted_to_all(rows, candidates);
  if (fits.empty()) return {};
  const double left = fits.front().distance, gain = rows.distance / left;
  const auto last = std::ranges::find_if(
      fits, [&](const ParameterFit& fit) { return fit.distance > as_good * left; });
  if (!(gain >= least_system_gain) ||
      (last != fits.end() && last->distance < least_race_lead * left))
    return {};
  const double second = last == fits.end() ? 0.0 : rows.distance / last->distance;
  const bool is_second_clock = last != fits.end() && last->candidate->is_clock;
  fits.erase(last, fits.end());
  keep_likeliest(fits, finest, question.motion);

  const auto coarser = std::ranges::find_if(
      question.histories.rbegin(), question.histories.rend(), [&](const Observation& one) {
        return one.facts.step >= least_other_step * finest.facts.step;
      });
  const double files = coarser == question.histories.rend() ? 1.0 : 2.0;
  if (files > 1.0) {
    const auto other = fit_rows(*coarser, question.motion);
    if (!other.is_far()) return {};
    std::erase_if(fits, [&](ParameterFit& fit) {
      const auto again = fitted(other, *fit.candidate, fit.value);
      const double apart = std::abs(again.value - fit.value);
      fit.uncertainty = std::max(fit.uncertainty, apart);
      return other.distance < least_gain_beside * again.distance ||
             apart > constant_change * std::abs(fit.value - fit.candidate->parameter.value);
    });
  } else if (gain < least_gain_alone || std::ranges::any_of(fits, [&](const ParameterFit& fit) {
               return may_be_numerical(fit, rows, question);
             })) {
    return {};
  }
  if (fits.empty()) return {};
  auto cause = diagnosis_of_all(fits, question);
  const double least = files > 1.0 ? least_system_gain : least_gain_alone;
  cause.confidence = std::min(files > 1.0 ? 1.0 : 0.9, confidence_of(gain, least));
  cause.evidence.insert(cause.evidence.begin(), {"gain", gain});
  cause.evidence.push_back({"files", files});
  if (second >= 1.0) {
    cause.runner_up = (is_second_clock ? Code("time-unit") : Code("parameter-differs")).name();
    cause.evidence.push_back({"runner-up-gain", second});
  }
  return cause;
}

}  // namespace clackers::diagnose
