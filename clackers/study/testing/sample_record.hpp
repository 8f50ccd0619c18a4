#pragma once

#include <limits>

#include "clackers/study/record.hpp"

namespace clackers::study {

/// For tests: a record in which every member differs from its default and from its neighbours,
/// with doubles that a careless printer would change.
inline Record sample_record() {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double huge = std::numeric_limits<double>::max();
  assess::RunScore run;
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
  run.impacts = assess::ImpactScore{6, 7, 5, 1, 2, 0.1 + 0.2, 3e-14};
  run.work = {1'000'000'007, 2, 3, 4, 5};
  run.seconds = 1e23;
  auto silent = run;
  silent.impacts.reset();
  silent.finished = false;
  assess::LadderFit fit;
  fit.behaviour = Behaviour::irregular;
  fit.reason = "energy-growth";
  fit.has_line = fit.on_envelope = true;
  fit.order = 1.03;
  fit.spread = 0.07;
  fit.scatter = 17.5;
  fit.constant = 0.123456789012345678;
  fit.first_level = 2;
  fit.last_level = 7;
  fit.floor = 1e-15;
  fit.steps = {0.05, 0.025};
  fit.errors = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  auto second = fit, third = fit;
  second.behaviour = Behaviour::proper;
  third.behaviour = Behaviour::divergent;
  MethodResult method;
  method.name = "newmark+event-driven";
  method.claim = {Behaviour::proper, 2.0, "why"};
  method.contact_time = 0.0157;
  method.refusal = "cannot";
  method.refusal_code = "simultaneous-contacts";
  method.complete = false;
  method.ladder = {{0.05, {run, silent}}, {0.025, {run}}};
  method.assessment = {fit, second, third, Verdict::not_claimed, "a sentence"};
  method.error_history = {{0.5, 1.5}, {{1e-3, 1e-4}, {2e-3, 2e-4}}};
  method.history_step = 0.003125;
  auto& without = method.self_convergence.emplace();
  without.order = 1.5;
  without.self = {second, true, 0.1234, "alone"};
  without.errors = third;
  without.against_reference = {true, "wrong-limit", 7.25, "both"};
  without.extrapolation = {true, "differences-turn", "so far", {0.3, -tiny}, 1e-9, 2e-10, 6};
  without.extrapolation_error = 3e-9;
  method.metrics = {{"u-max", "m", 0.1 + 0.7, {tiny, huge}, "", true},
                    {"v-max", "m/s", -0.0, {}, "no velocities", false}};
  method.metrics_step = 0.0125;
  Record record;
  record.provenance = {"clackers verify", "9.8.7", "GCC 12",
                       "Linux",           "EPYC",  "2030-01-02T03:04:05Z"};
  record.problem = {"three-parameter",
                    "two masses",
                    "Eq. (25)",
                    {{"N", 2.0, "", "whole"}},
                    {{"m2", 1.0 / 3.0, "kg", "mass 2"}},
                    20.0,
                    0.699,
                    {1.5727, 4.7181},
                    2};
  record.plan = {0.04, 6, 5};
  record.response = {{0.0, 1.0}, {{1.0, 0.5}, {-0.3, 0.2}}};
  record.methods = {method};
  record.interrupted = true;
  record.profiles = {
      {"steps",
       {"stop: error in u <= 1e-01"},
       {{"newmark", {1.5, std::numeric_limits<double>::infinity()}, {{1.5, 0.5}}, 0, 1}}}};
  return record;
}

}  // namespace clackers::study
