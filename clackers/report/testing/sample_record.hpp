#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "clackers/record/notes.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/testing/sample_record.hpp"

// Made-up numbers in the shape of real records, for tests of what shows records.
namespace clackers::report {

struct SampleMethod {
  std::string name;
  Claim claim;
  Behaviour behaviour = Behaviour::proper;
  Verdict verdict = Verdict::agrees;
  double constant = 1.0, order = 2.0, floor = 1e-14, scatter = 1.0;
  long long forces_per_step = 1;
};

/// How much of everything a sample has.
struct SampleSize {
  int levels = 8, samples = 8;
  std::size_t points = 900;  ///< of a curve
};

inline record::CaseSummary sample_case() {
  record::CaseSummary problem;
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
  problem.impact_contacts.assign(6, 0);
  problem.drawing = {{{1, 1.0}, {0, 1.0}}, {{0, -1}, {1, -1}}, {{1, 0, 0.0}}};
  return problem;
}

inline record::Curve sample_response(std::size_t points) {
  record::Curve curve;
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

inline measure::RunScore sample_run(const SampleMethod& method, double step, int seed) {
  measure::RunScore run;
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
  run.impacts = measure::ImpactScore{6, 6, 6, 0, 0, run.u_error / 3.0};
  run.work.steps = std::llround(20.0 / step);
  run.work.force_evaluations = method.forces_per_step * run.work.steps;
  run.work.event_searches = 6;
  run.seconds = 2e-8 * double(run.work.force_evaluations);
  return run;
}

inline record::SelfResult sample_self(const SampleMethod& method) {
  record::SelfResult result;
  result.order = method.order;
  auto& seen = result.self.differences;
  seen.behaviour = Behaviour::proper;
  seen.has_line = result.self.proper = true;
  seen.order = method.order + 0.0042;
  seen.spread = 0.011;
  result.self.estimate = 1.5e-7;
  result.errors = seen;
  result.against_reference = {false, "", 1.02};
  result.extrapolation = {true, "", {0.25, -0.125}, 1.5e-7, {}, 7};
  result.extrapolation_error = 3.5e-9;
  if (method.behaviour != Behaviour::stagnating) return result;
  result.errors = {};
  result.errors.behaviour = Behaviour::stagnating;
  result.errors.floor = 0.0031;
  result.against_reference = {true, "wrong-limit", 2.1e4};
  result.extrapolation_error = 0.0031;
  return result;
}

inline std::vector<record::MetricResult> sample_metrics() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {{"u-max", "m", 1e-6, {1e-6, 5e-7}, "", true},
          {"v-max", "m/s", 2.0, {2.0, 1.0}, "", false},
          {"energy-max-relative", "1", 2.0, {}, "", false},
          {"period-fit-relative", "1", nan, {}, "There are no impacts.", true},
          {"impact-spacing-max-relative", "1", nan, {}, "There are no impacts.", true}};
}

inline record::Curve sample_error_history(const SampleMethod& method, double step,
                                          std::size_t points) {
  auto curve = sample_response(points);
  const double size = 1e-16 + method.floor + method.constant * std::pow(step, method.order);
  for (auto& y : curve.y)
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] = size * std::abs(y[i]) * (0.1 + curve.t[i] / 20);
  return curve;
}

inline record::Subject sample_method(const SampleMethod& method, const SampleSize& size) {
  record::Subject subject;
  record::name_method(subject, method.name);
  subject.claim = method.claim;
  auto& fit = subject.assessment.displacement;
  for (int level = 0; level < size.levels; ++level) {
    record::Level row;
    row.step = 0.05 / double(1 << level);
    double worst = 0.0;
    for (int k = 0; k < size.samples; ++k) {
      record::Run run;
      run.score = sample_run(method, row.step * std::exp2(-double(k) / size.samples),
                             size.samples * level + k);
      worst = std::max(worst, run.score.u_error);
      row.runs.push_back(std::move(run));
    }
    fit.steps.push_back(row.step);
    fit.errors.push_back(worst);
    subject.levels.push_back(std::move(row));
  }
  fit.behaviour = method.behaviour;
  fit.reason = method.claim.reason;
  fit.has_line = method.behaviour != Behaviour::stagnating;
  fit.on_envelope = method.behaviour == Behaviour::irregular;
  fit.order = method.order + 0.0123;
  fit.spread = method.scatter > 1.0 ? 0.14 : 0.012;
  fit.scatter = method.scatter;
  fit.constant = method.constant;
  fit.floor = fit.has_line ? 0.0 : method.floor;
  fit.last_level = size.levels - 1;
  subject.assessment.verdict = method.verdict;
  subject.assessment.reason = fit.reason;
  subject.self_convergence = sample_self(method);
  auto& shown = subject.levels.back().runs.front();
  shown.metrics = sample_metrics();
  shown.error_history = sample_error_history(method, shown.score.step, size.points);
  return subject;
}

inline record::Subject sample_refusal() {
  record::Subject refused;
  record::name_method(refused, "newmark+penalty:stiffness=1e6");
  refused.claim = {Behaviour::stagnating, 0, "contact-stiffness"};
  refused.refusal =
      "with eta = 0.5: a linear penalty spring is elastic, so it models only eta = 1.";
  refused.refusal_code = "penalty-needs-elastic";
  return refused;
}

inline record::Provenance sample_provenance(const std::string& command) {
  return {command,
          "0.1.0",
          "GCC 12.2.0, -O3",
          "Linux x86_64",
          "a processor of two cores",
          "2025-11-21T09:43:00Z"};
}

/// One case with eight methods: one disagrees, one was interrupted and one refused the case.
inline record::Record sample_record(const SampleSize& size = {}) {
  using enum Behaviour;
  const std::vector<SampleMethod> methods{
      {"newmark", {proper, 2, ""}, proper, Verdict::agrees, 0.8, 2, 1e-14, 1, 1},
      {"central-difference", {proper, 2, ""}, proper, Verdict::agrees, 0.35, 2, 1e-14, 1, 1},
      {"rk4", {proper, 4, ""}, proper, Verdict::agrees, 2, 4, 2e-14, 1, 4},
      {"generalized-alpha:rho=0.8",
       {proper, 2, ""},
       reduced,
       Verdict::disagrees,
       1.6,
       1.6,
       1e-14,
       1,
       1},
      {"newmark+reversal", {irregular, 1, ""}, irregular, Verdict::agrees, 0.9, 1, 1e-14, 2.5, 1},
      {"newmark+penalty",
       {stagnating, 0, "contact-stiffness"},
       stagnating,
       Verdict::agrees,
       0.7,
       2,
       3.1e-3,
       1,
       2},
      {"moreau-jean", {irregular, 1, ""}, undecided, Verdict::undecided, 1.4, 1, 1e-14, 1.8, 1}};
  record::Record record;
  record.provenance = sample_provenance("clackers verify --report report.html");
  record.interrupted = true;
  auto& problem = record.cases.emplace_back();
  problem.problem = sample_case();
  problem.plan = {0.05, size.levels, size.samples};
  problem.response = sample_response(size.points);
  for (const auto& method : methods) {
    auto of_method = size;
    if (method.name == "moreau-jean") of_method.levels = std::min(3, size.levels);
    problem.subjects.push_back(sample_method(method, of_method));
  }
  problem.subjects.push_back(sample_refusal());
  for (auto& run : problem.subjects.front().levels.back().runs)
    run.motion = sample_response(size.points);
  problem.profiles = record::profiles_of({&problem, 1});
  problem.subjects[6].complete = false;
  return record;
}

inline record::Run sample_history_run(const std::string& name, double step) {
  record::Run run;
  auto& score = run.score;
  score.step = step;
  score.finished = true;
  score.u_error = 0.1 * step;
  score.v_error = score.energy_error = score.energy_ratio = std::nan("");
  score.impacts = measure::ImpactScore{6, 5, 4, 2, 1, 0.125, 0.0};
  auto& file = run.file.emplace();
  file.file = name;
  file.rows = 2001;
  file.spacing = step;
  file.last = 20.0;
  file.columns = {{"t", 17, false, 0.0}, {"u1", 6, false, 5e-6}};
  file.printed_floor = 5e-6;
  file.printed_by = "u1";
  file.has_u = {true, true};
  file.impact_source = record::ImpactSource::history;
  file.notes = {record::note("impacts-from-history", {step, 1.0, 5.0, 6.0, 0.0})};
  file.history = run.error_history = sample_response(201);
  for (auto& y : run.error_history.y)
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = 1e-3 * run.error_history.t[i];
  run.metrics = sample_metrics();
  return run;
}

/// Two histories of one method that disagree.
inline record::Record sample_check() {
  record::Record record;
  record.command = "check";
  record.provenance = sample_provenance("clackers check coarse.csv fine.csv");
  auto& problem = record.cases.emplace_back();
  problem.problem = sample_case();
  problem.plan = {0.0, 0, 0};
  problem.response = sample_response(801);
  auto& subject = problem.subjects.emplace_back();
  subject.kind = record::SubjectKind::histories;
  subject.name = "histories";
  subject.levels = {{0.02, {sample_history_run("/a/long/way/to/coarse.csv", 0.02)}},
                    {0.01, {sample_history_run("fine.csv", 0.01)}}};
  subject.levels[0].runs[0].file->notes.push_back(record::note("starts-late", {0.02}));
  subject.impacts = {{.t = 1.5707,
                      .contact = 0,
                      .closing = 0.8,
                      .opening = 0.72,
                      .restitution = 0.9,
                      .restitution_error = 1e-3,
                      .momentum_defect = 0.02,
                      .delay_steps = 0.25},
                     {.t = 4.7124,
                      .contact = 1,
                      .closing = 0.5,
                      .opening = 0.475,
                      .restitution = 0.95,
                      .delay_steps = 0.75}};
  auto& assessment = subject.assessment;
  assessment.displacement.behaviour = Behaviour::undecided;
  assessment.displacement.reason = "too-few-levels";
  assessment.displacement.steps = {0.02, 0.01};
  assessment.displacement.errors = {0.002, 0.001};
  assessment.verdict = Verdict::disagrees;
  assessment.evidence = {{"other-impacts", Verdict::disagrees, {4, 6, 1}}};
  return record;
}

/// Two cases: methods, one with a run that failed and one that refused, and histories.
inline record::Record sample_of_all() {
  auto record = sample_record({.levels = 4, .samples = 2, .points = 9});
  record.interrupted = false;
  auto& methods = record.cases.front().subjects;
  methods.erase(methods.begin() + 6);  // the one that was interrupted
  methods.erase(methods.begin() + 1);  // central-difference
  auto& failed = methods[1].levels[0].runs[0].score;
  failed = {.step = failed.step,
            .failure_code = "diverged",
            .failure = "left the finite numbers at t = 3 s.",
            .impacts = {},
            .work = failed.work,
            .seconds = failed.seconds};
  record.cases.front().profiles.clear();
  record.cases.push_back(sample_check().cases.front());
  record.cases.back().problem.name = "stop";
  record.cases.back().response = sample_response(9);
  for (auto& level : record.cases.back().subjects.front().levels)
    for (auto& run : level.runs) run.error_history = run.file->history = sample_response(9);
  return record;
}

}  // namespace clackers::report
