#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// For tests: names a method as a study does. All but moreau-jean join an integrator and a treatment.
inline void name_method(Subject& subject, const std::string& name) {
  subject.name = name;
  if (name == "moreau-jean") return;
  const auto plus = name.find('+');
  subject.integrator = name.substr(0, plus);
  subject.treatment = plus == std::string::npos ? "event-driven" : name.substr(plus + 1);
}

/// For tests: a record in which every member differs from its default and from its neighbours,
/// with doubles that a careless printer would change.
inline Record sample_record() {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double huge = std::numeric_limits<double>::max();
  measure::RunScore run;
  run.step = 0.1;
  run.finished = true;
  run.failure_code = "diverged";
  run.failure = "said \"no\" at t = 3 s\n\xC3\xBC";
  run.u_error = 1.0 / 3.0;
  run.u_error_absolute = tiny;
  run.v_error = huge;
  run.energy_error = 5e-324;
  run.energy_ratio = -0.0;
  run.rounding_floor = 2.2250738585072011e-308;
  run.impacts = measure::ImpactScore{6, 7, 5, 1, 2, 0.1 + 0.2, 3e-14};
  run.work = {1'000'000'007, 2, 3, 4, 5};
  run.seconds = 1e23;
  auto silent = run;
  silent.impacts.reset();
  silent.finished = false;
  judge::LadderFit fit;
  fit.behaviour = Behaviour::irregular;
  fit.reason = "energy-growth";
  fit.has_line = fit.on_envelope = true;
  fit.order = 1.03;
  fit.spread = 0.07;
  fit.scatter = 17.5;
  fit.constant = 0.123456789012345678;
  fit.first_level = 2;
  fit.last_level = 7;
  fit.largest_step = 0.0125;
  fit.smallest_step = 4e-4;
  fit.floor = 1e-15;
  fit.floor_step = 2e-4;
  fit.floor_scatter = 3.5;
  fit.cancel_step = 0.0031;
  fit.coincident_share = 0.25;
  fit.stable_step = 0.011;
  fit.steps = {0.05, 0.025};
  fit.errors = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  auto second = fit, third = fit;
  second.behaviour = Behaviour::proper;
  third.behaviour = Behaviour::divergent;
  Subject method;
  method.name = "newmark";
  method.integrator = "newmark:beta=0.25";
  method.treatment = "event-driven:tolerance=1e-9";
  method.claim = {Behaviour::proper, 2.0, "why"};
  method.tolerance = 1e-3;
  method.contact_time = 0.0157;
  method.refusal = "cannot";
  method.refusal_code = "redundant-contacts";
  method.complete = false;
  const std::vector<MetricResult> metrics = {{"u-max", "m", 0.1 + 0.7, {tiny, huge}, "", true},
                                             {"v-max", "m/s", -0.0, {}, "no velocities", false}};
  HistoryFile file;
  file.file = "h0.01.csv";
  file.rows = 2001;
  file.rows_beyond = 7;
  file.first = 0.01;
  file.last = 19.99;
  file.spacing = 0.0101;
  file.step_source = StepSource::option;
  file.columns = {{"t", 6, false, 5e-5}, {"u1", 7, true, 5e-6}};
  file.printed_floor = 3e-6;
  file.printed_by = "u1";
  file.unseen_bend = 0.02;
  file.has_velocities = true;
  file.has_u = {true, false};
  file.start_error = 1e-5;
  file.impact_source = ImpactSource::history;
  file.rows_resolve_impacts = false;
  file.contact_time = 0.016;
  file.notes = {{"rows-beyond-end", {7.0, 20.0}, ""}, {"columns-not-used", {}, "energy"}};
  file.history = {{0.25}, {{1.0}, {0.5}}};
  method.levels = {
      {0.05,
       {{run, {}, metrics, {{0.5, 1.5}, {{1e-3, 1e-4}, {2e-3, 2e-4}}}, {{0.5}, {{0.25}, {0.5}}}},
        {silent, {}, {}, {}, {}, "Segmentation fault"}}},
      {0.025, {{run, file, {}, {}}}}};
  method.refinement = {2, 1, 16, RefinementEnd::budget, 12.5};
  method.assessment = {fit,
                       second,
                       third,
                       Verdict::not_claimed,
                       judge::Mismatch::lower_order,
                       "printed-digits",
                       {{"within-tolerance", Verdict::agrees, {1e-4, 1e-3, 1e-6}}}};
  auto& without = method.self_convergence.emplace();
  without.order = 1.5;
  without.self = {second, true, 0.1234};
  without.errors = third;
  without.against_reference = {true, "wrong-limit", 7.25};
  without.extrapolation = {true, "differences-turn", {0.3, -tiny}, 1e-9, 2e-10, 6};
  without.extrapolation_error = 3e-9;
  method.refined_by = RefinementParameter::tolerance;
  method.diagnoses = {
      {"restitution-differs",
       0.99,
       "1",
       0.9375,
       {{"gain", 9e7}, {"uncertainty", tiny}},
       "t,u2",
       "damping-differs"},
      {"wrong-limit", std::numeric_limits<double>::quiet_NaN(), "", 0.5, {}, "", ""}};
  method.departure = {2, 4.7181};
  method.impacts = {{1.5727, 0, 0.5, 0.25, 0.5, 1e-9, 0.01, 3e-3, 0.3, 9e-3, 0.6366, 2e-4, tiny},
                    {4.7181, 1, 2.0, 1.0, 0.5, 1e-8, 0.02, -1e-3, -0.1, -3e-3, NAN, 5e-4, NAN}};
  auto histories = method;
  histories.kind = SubjectKind::histories;
  histories.name = "histories";
  histories.tolerance.reset();
  histories.self_convergence.reset();
  histories.refinement.reset();
  CaseRecord problem;
  problem.problem = {"three-parameter",
                     "two masses",
                     "Eq. (25)",
                     {{"N", 2.0, "", "whole"}},
                     {{"m2", 1.0 / 3.0, "kg", "mass 2"}},
                     20.0,
                     0.699,
                     {1.5727, 4.7181},
                     {0, 1},
                     {{{0, 1.0}, {1, 0.5}}, {{0, -1}}, {{0, 1, 0.25}}},
                     2};
  problem.plan = {0.04, 6, 5};
  problem.response = {{0.0, 1.0}, {{1.0, 0.5}, {-0.3, 0.2}}};
  problem.subjects = {method, histories};
  problem.profiles = {
      {"steps",
       {"stop: error in u <= 1e-01"},
       {{"newmark", {1.5, std::numeric_limits<double>::infinity()}, {{1.5, 0.5}}, 0, 1}}}};
  Record record;
  record.command = "check";
  record.provenance = {"clackers verify", "9.8.7", "GCC 12",
                       "Linux",           "EPYC",  "2030-01-02T03:04:05Z"};
  record.cases = {problem, CaseRecord{}};
  record.profiles = problem.profiles;
  record.profiles[0].counter = "force_evaluations";
  record.interrupted = true;
  return record;
}

}  // namespace clackers::record
