#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "clackers/assess/metrics/metric.hpp"
#include "clackers/study/record.hpp"

namespace clackers::report {

/// Made-up numbers in the shape of a real record, for tests of what shows records: seven methods,
/// of which one was interrupted and one refused the case; 8 levels of 8 neighbouring steps.
struct SampleMethod {
  std::string name;
  Claim claim;
  Behaviour behaviour = Behaviour::proper;
  Verdict verdict = Verdict::agrees;
  double constant = 1.0, order = 2.0, floor = 1e-14, scatter = 1.0;
  long long forces_per_step = 1;
  std::string sentence;
};

inline study::CaseSummary sample_case() {
  study::CaseSummary problem;
  problem.name = "three-parameter";
  problem.summary = "Two masses that collide at equilibrium, given by N, damping and amplitude.";
  problem.equations = "Eq. (25)-(26)";
  problem.parameters = {{"N", 2, "", "half of X - 1"},
                        {"xi1", 0.05, "", "damping ratio of mass 1"},
                        {"a_t", 1, "m", "initial displacement"}};
  problem.constants = {{"m2", 0.01, "kg", "mass 2"},
                       {"k2", 0.2506, "N/m", "stiffness 2"},
                       {"omega_D1", 0.99875, "rad/s", "damped frequency of mass 1"},
                       {"r*", 0.2113, "", "largest admissible mass ratio"}};
  problem.end = 20.0;
  problem.fast_period = 1.2582;
  for (int k = 0; k < 6; ++k) problem.impact_times.push_back(std::numbers::pi * (k + 0.5));
  problem.impact_count = 6;
  return problem;
}

inline study::Curve sample_response(std::size_t points) {
  study::Curve curve;
  curve.y.resize(2);
  for (std::size_t i = 0; i < points; ++i) {
    const double t = 20.0 * double(i) / double(points - 1), fade = std::exp(-0.05 * t);
    curve.t.push_back(t);
    curve.y[0].push_back(fade * std::abs(std::cos(t)));
    curve.y[1].push_back(-0.3 * fade * std::abs(std::cos(5 * t)));
  }
  return curve;
}

// A number in [-1, 1] that looks random and is the same everywhere.
inline double sample_noise(int i) { return std::sin(12.9898 * i + 78.233 * i * i); }

inline assess::RunScore sample_run(const SampleMethod& method, double step, int seed) {
  assess::RunScore run;
  run.step = step;
  run.finished = true;
  run.u_error = method.constant * std::pow(step, method.order) *
                    std::pow(method.scatter, sample_noise(seed)) +
                method.floor;
  run.u_error_absolute = run.u_error * 0.7;
  run.v_error = 2.0 * run.u_error;
  run.energy_error = 3.0 * run.u_error;
  run.energy_ratio = 1.0 + run.energy_error;
  run.rounding_floor = 1e-14;
  run.impacts = assess::ImpactScore{6, 6, 6, 0, 0, run.u_error / 3.0};
  run.work.steps = std::llround(20.0 / step);
  run.work.force_evaluations = method.forces_per_step * run.work.steps;
  run.work.event_searches = 6;
  run.seconds = 2e-8 * double(run.work.force_evaluations);
  return run;
}

inline study::SelfResult sample_self(const SampleMethod& method) {
  study::SelfResult result;
  result.order = method.order;
  auto& seen = result.self.differences;
  seen.behaviour = Behaviour::proper;
  seen.has_line = result.self.proper = true;
  seen.order = method.order + 0.0042;
  seen.spread = 0.011;
  result.self.estimate = 1.5e-7;
  result.self.sentence = "The runs converge properly.";
  result.errors = seen;
  result.against_reference = {false, "", 1.02, "Without the true motion: proper. With it: proper."};
  result.extrapolation = {true, "", "Extrapolated.", {0.25, -0.125}, 1.5e-7, {}, 7};
  result.extrapolation_error = 3.5e-9;
  if (method.behaviour != Behaviour::stagnating) return result;
  result.errors = {};
  result.errors.behaviour = Behaviour::stagnating;
  result.against_reference = {
      true, "wrong-limit", 2.1e4,
      "Without the true motion: proper. With it: a floor. Self-convergence would "
      "have lied: the runs converge to a limit 0.0031 away from the true motion."};
  result.extrapolation_error = 0.0031;
  return result;
}

inline std::vector<study::MetricResult> sample_metrics() {
  std::vector<study::MetricResult> list;
  for (const auto& metric : assess::metrics()) {
    const double value = 1e-6 * double(list.size() + 1);
    list.push_back({std::string(metric.name),
                    std::string(metric.unit),
                    value,
                    {value, value / 2},
                    "",
                    metric.across_jumps});
  }
  for (auto last = list.end() - 2; last != list.end(); ++last) {
    last->reason = "There are no collisions.";
    last->value = std::numeric_limits<double>::quiet_NaN();
  }
  return list;
}

inline study::MethodResult sample_method(const SampleMethod& method, int levels) {
  study::MethodResult result;
  result.name = method.name;
  result.claim = method.claim;
  auto& fit = result.assessment.displacement;
  for (int level = 0; level < levels; ++level) {
    assess::Level row;
    row.step = 0.05 / double(1 << level);
    double worst = 0.0;
    for (int k = 0; k < 8; ++k) {
      row.runs.push_back(sample_run(method, row.step * std::exp2(-k / 8.0), 8 * level + k));
      worst = std::max(worst, row.runs.back().u_error);
    }
    fit.steps.push_back(row.step);
    fit.errors.push_back(worst);
    result.ladder.push_back(std::move(row));
  }
  fit.behaviour = method.behaviour;
  fit.reason = method.claim.reason;
  fit.has_line = method.behaviour != Behaviour::stagnating;
  fit.on_envelope = method.behaviour == Behaviour::irregular;
  fit.order = method.order + 0.0123;
  fit.spread = method.scatter > 1.0 ? 0.14 : 0.012;
  fit.constant = method.constant;
  fit.last_level = levels - 1;
  result.assessment.verdict = method.verdict;
  result.assessment.sentence = method.sentence;
  result.self_convergence = sample_self(method);
  result.metrics = sample_metrics();
  result.metrics_step = 0.05 / double(1 << (levels - 1));
  result.history_step = 0.05 / 16;
  const auto shape = sample_response(900);
  result.error_history.t = shape.t;
  result.error_history.y.resize(2);
  for (std::size_t i = 0; i < shape.t.size(); ++i)
    for (std::size_t mass = 0; mass < 2; ++mass)
      result.error_history.y[mass].push_back(
          (1e-16 + method.floor + method.constant * std::pow(result.history_step, method.order)) *
          std::abs(shape.y[mass][i]) * (0.1 + shape.t[i] / 20));
  return result;
}

inline study::Record sample_record() {
  study::Record record;
  record.provenance = {"clackers verify --report report.html",
                       "0.1.0",
                       "GCC 12.2.0, -O3",
                       "Linux x86_64",
                       "a processor of two cores",
                       "2025-11-21T09:43:00Z"};
  record.problem = sample_case();
  record.response = sample_response(900);
  using enum Behaviour;
  const std::vector<SampleMethod> methods{
      {"newmark",
       {proper, 2, ""},
       proper,
       Verdict::agrees,
       0.8,
       2,
       1e-14,
       1,
       1,
       "proper of order 2.01 as claimed"},
      {"central-difference",
       {proper, 2, ""},
       proper,
       Verdict::agrees,
       0.35,
       2,
       1e-14,
       1,
       1,
       "proper of order 2.01 as claimed"},
      {"rk4",
       {proper, 4, ""},
       proper,
       Verdict::agrees,
       2,
       4,
       2e-14,
       1,
       4,
       "proper of order 4.01 as claimed"},
      {"generalized-alpha:rho=0.8",
       {proper, 2, ""},
       reduced,
       Verdict::disagrees,
       1.6,
       1.6,
       1e-14,
       1,
       1,
       "reduced: the line is straight with slope 1.6, the method claims order 2"},
      {"newmark+reversal",
       {irregular, 1, ""},
       irregular,
       Verdict::agrees,
       0.9,
       1,
       1e-14,
       2.5,
       1,
       "irregular as claimed: neighbouring steps scatter by a factor 6.2, the envelope has order "
       "1.01"},
      {"newmark+penalty",
       {stagnating, 0, "contact-stiffness"},
       stagnating,
       Verdict::agrees,
       0.7,
       2,
       3.1e-3,
       1,
       2,
       "stagnating at 3.1e-3 as claimed: each contact lasts 0.0157 s instead of an instant"},
      {"moreau-jean",
       {irregular, 1, ""},
       undecided,
       Verdict::undecided,
       1.4,
       1,
       1e-14,
       1.8,
       1,
       "fewer than four levels were finished"}};
  for (const auto& method : methods)
    record.methods.push_back(sample_method(method, method.name == "moreau-jean" ? 3 : 8));
  record.methods.back().complete = false;

  study::MethodResult refused;
  refused.name = "newmark+penalty:stiffness=1e6";
  refused.claim = {stagnating, 0, "contact-stiffness"};
  refused.refusal =
      "newmark+penalty with eta = 0.5: a linear penalty spring gives back what it takes, "
      "so it can only stand for eta = 1.";
  refused.refusal_code = "penalty-needs-elastic";
  refused.ladder.clear();
  record.methods.push_back(refused);
  record.profiles = study::profiles_of({&record, 1});
  record.interrupted = true;
  return record;
}

}  // namespace clackers::report
