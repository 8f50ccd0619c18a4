#pragma once

#include <concepts>
#include <type_traits>

#include "clackers/study/record.hpp"

namespace clackers::study {

/// T, or const T: one list of fields serves writing and reading.
template <class T, class Base>
concept Like = std::same_as<std::remove_const_t<T>, Base>;

// Every struct of a record and the names of its fields in json. `fields(archive, x)` calls
// archive(name, member) for each. The structured binding at the head of each function names all
// members, so that a member added to a struct and forgotten here does not compile. A field that
// records of earlier versions lack is told by archive.added(name, member).

template <class Archive>
void fields(Archive& archive, Like<Quantity> auto& x) {
  auto& [name, value, unit, meaning] = x;
  archive("name", name);
  archive("value", value);
  archive("unit", unit);
  archive("meaning", meaning);
}

template <class Archive>
void fields(Archive& archive, Like<Provenance> auto& x) {
  auto& [command, version, compiler, machine, processor, date] = x;
  archive("command", command);
  archive("version", version);
  archive("compiler", compiler);
  archive("machine", machine);
  archive("processor", processor);
  archive("date", date);
}

template <class Archive>
void fields(Archive& archive, Like<CaseSummary> auto& x) {
  auto& [name, summary, equations, parameters, constants, end, fast_period, times, count] = x;
  archive("name", name);
  archive("summary", summary);
  archive("equations", equations);
  archive("parameters", parameters);
  archive("constants", constants);
  archive("end", end);
  archive("fast_period", fast_period);
  archive("impact_times", times);
  archive("impact_count", count);
}

template <class Archive>
void fields(Archive& archive, Like<LadderPlan> auto& x) {
  auto& [coarsest, levels, neighbours] = x;
  archive("coarsest", coarsest);
  archive("levels", levels);
  archive("neighbours", neighbours);
}

template <class Archive>
void fields(Archive& archive, Like<Curve> auto& x) {
  auto& [t, y] = x;
  archive("t", t);
  archive("y", y);
}

template <class Archive>
void fields(Archive& archive, Like<Claim> auto& x) {
  auto& [behaviour, order, reason] = x;
  archive("behaviour", behaviour);
  archive("order", order);
  archive("reason", reason);
}

template <class Archive>
void fields(Archive& archive, Like<model::Work> auto& x) {
  auto& [steps, forces, factorizations, newton, searches] = x;
  archive("steps", steps);
  archive("force_evaluations", forces);
  archive("factorizations", factorizations);
  archive("newton_iterations", newton);
  archive("event_searches", searches);
}

template <class Archive>
void fields(Archive& archive, Like<assess::ImpactScore> auto& x) {
  auto& [expected, found, matched, missed, extra, worst, floor] = x;
  archive("expected", expected);
  archive("found", found);
  archive("matched", matched);
  archive("missed", missed);
  archive("extra", extra);
  archive("worst_time_error", worst);
  archive("rounding_floor", floor);
}

template <class Archive>
void fields(Archive& archive, Like<assess::RunScore> auto& x) {
  auto& [step, finished, code, failure, u, u_absolute, v, energy, ratio, floor, impacts, work,
         seconds] = x;
  archive("step", step);
  archive("finished", finished);
  archive("failure_code", code);
  archive("failure", failure);
  archive("u_error", u);
  archive("u_error_absolute", u_absolute);
  archive("v_error", v);
  archive("energy_error", energy);
  archive("energy_ratio", ratio);
  archive("rounding_floor", floor);
  archive("impacts", impacts);
  archive("work", work);
  archive("seconds", seconds);
}

template <class Archive>
void fields(Archive& archive, Like<assess::Level> auto& x) {
  auto& [step, runs] = x;
  archive("step", step);
  archive("runs", runs);
}

template <class Archive>
void fields(Archive& archive, Like<assess::LadderFit> auto& x) {
  auto& [behaviour, reason, has_line, on_envelope, order, spread, scatter, constant, first, last,
         floor, steps, errors] = x;
  archive("behaviour", behaviour);
  archive("reason", reason);
  archive("has_line", has_line);
  archive("on_envelope", on_envelope);
  archive("order", order);
  archive("spread", spread);
  archive("scatter", scatter);
  archive("constant", constant);
  archive("first_level", first);
  archive("last_level", last);
  archive("floor", floor);
  archive("steps", steps);
  archive("errors", errors);
}

template <class Archive>
void fields(Archive& archive, Like<assess::Assessment> auto& x) {
  auto& [displacement, velocity, impact_time, verdict, sentence] = x;
  archive("displacement", displacement);
  archive("velocity", velocity);
  archive("impact_time", impact_time);
  archive("verdict", verdict);
  archive("sentence", sentence);
}

template <class Archive>
void fields(Archive& archive, Like<MetricResult> auto& x) {
  auto& [name, unit, value, masses, reason, across_jumps] = x;
  archive("name", name);
  archive("unit", unit);
  archive("value", value);
  archive("masses", masses);
  archive("reason", reason);
  archive("across_jumps", across_jumps);
}

template <class Archive>
void fields(Archive& archive, Like<assess::SelfConvergence> auto& x) {
  auto& [differences, proper, estimate, sentence] = x;
  archive("differences", differences);
  archive("proper", proper);
  archive("estimate", estimate);
  archive("sentence", sentence);
}

template <class Archive>
void fields(Archive& archive, Like<assess::SelfAgainstReference> auto& x) {
  auto& [would_have_lied, reason, error_ratio, sentence] = x;
  archive("would_have_lied", would_have_lied);
  archive("reason", reason);
  archive("error_ratio", error_ratio);
  archive("sentence", sentence);
}

template <class Archive>
void fields(Archive& archive, Like<assess::Richardson> auto& x) {
  auto& [bounded, reason, sentence, value, bound, estimate, level] = x;
  archive("bounded", bounded);
  archive("reason", reason);
  archive("sentence", sentence);
  archive("value", value);
  archive("bound", bound);
  archive("estimate", estimate);
  archive("level", level);
}

template <class Archive>
void fields(Archive& archive, Like<SelfResult> auto& x) {
  auto& [order, self, errors, against_reference, extrapolation, extrapolation_error] = x;
  archive("order", order);
  archive("without_reference", self);
  archive("errors", errors);
  archive("against_reference", against_reference);
  archive("extrapolation", extrapolation);
  archive("extrapolation_error", extrapolation_error);
}

template <class Archive>
void fields(Archive& archive, Like<MethodResult> auto& x) {
  auto& [name, claim, contact_time, refusal, refusal_code, complete, ladder, assessment, history,
         history_step, self_convergence, metrics, metrics_step] = x;
  archive("name", name);
  archive("claim", claim);
  archive("contact_time", contact_time);
  archive("refusal", refusal);
  archive("refusal_code", refusal_code);
  archive("complete", complete);
  archive("ladder", ladder);
  archive("assessment", assessment);
  archive("error_history", history);
  archive("history_step", history_step);
  archive.added("self_convergence", self_convergence);
  archive.added("metrics", metrics);
  archive.added("metrics_step", metrics_step);
}

template <class Archive>
void fields(Archive& archive, Like<assess::ProfileStep> auto& x) {
  auto& [ratio, share] = x;
  archive("ratio", ratio);
  archive("share", share);
}

template <class Archive>
void fields(Archive& archive, Like<assess::MethodProfile> auto& x) {
  auto& [method, ratios, steps, best, failed] = x;
  archive("method", method);
  archive("ratios", ratios);
  archive("steps", steps);
  archive("best", best);
  archive("failed", failed);
}

template <class Archive>
void fields(Archive& archive, Like<Profile> auto& x) {
  auto& [counter, tasks, methods] = x;
  archive("counter", counter);
  archive("tasks", tasks);
  archive("methods", methods);
}

template <class Archive>
void fields(Archive& archive, Like<Record> auto& x) {
  auto& [provenance, problem, plan, response, results, interrupted, profiles] = x;
  archive("provenance", provenance);
  archive("case", problem);
  archive("plan", plan);
  archive("response", response);
  archive("methods", results);
  archive("interrupted", interrupted);
  archive.added("profiles", profiles);
}

}  // namespace clackers::study
