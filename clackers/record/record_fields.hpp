#pragma once

#include <concepts>
#include <type_traits>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// T, or const T: one list of fields serves writing and reading.
template <class T, class Base>
concept Like = std::same_as<std::remove_const_t<T>, Base>;

// Every struct of a record and the names of its fields in json. `fields(archive, x)` calls
// archive(name, member) for each; record_json_test.cpp compares their number with that of the
// members, so that none is forgotten. archive.added(name, member) is a field that records of earlier
// versions lack.

void fields(auto& archive, Like<Quantity> auto& x) {
  archive("name", x.name);
  archive("value", x.value);
  archive("unit", x.unit);
  archive("meaning", x.meaning);
  archive.added("text", x.text);
}

void fields(auto& archive, Like<Provenance> auto& x) {
  archive("command", x.command);
  archive("version", x.version);
  archive("compiler", x.compiler);
  archive("machine", x.machine);
  archive("processor", x.processor);
  archive("date", x.date);
}

void fields(auto& archive, Like<Schematic::Block> auto& x) {
  archive("column", x.column);
  archive("height", x.height);
}

void fields(auto& archive, Like<Schematic::Spring> auto& x) {
  archive("one", x.one);
  archive("other", x.other);
}

void fields(auto& archive, Like<Schematic::Touch> auto& x) {
  archive("left", x.left);
  archive("right", x.right);
  archive("gap", x.gap);
}

void fields(auto& archive, Like<Schematic> auto& x) {
  archive("blocks", x.blocks);
  archive("springs", x.springs);
  archive("contacts", x.contacts);
}

void fields(auto& archive, Like<CaseSummary> auto& x) {
  archive("name", x.name);
  archive("summary", x.summary);
  archive("equations", x.equations);
  archive("parameters", x.parameters);
  archive("constants", x.constants);
  archive("end", x.end);
  archive("fast_period", x.fast_period);
  archive("impact_times", x.impact_times);
  archive("impact_count", x.impact_count);
  archive.added("impact_contacts", x.impact_contacts);
  archive.added("drawing", x.drawing);
}

void fields(auto& archive, Like<RefinementPlan> auto& x) {
  archive("coarsest", x.coarsest);
  archive("levels", x.levels);
  archive("samples_per_level", x.samples_per_level);
}

void fields(auto& archive, Like<Refinement> auto& x) {
  archive("finer_levels", x.finer_levels);
  archive("coarser_levels", x.coarser_levels);
  archive("samples_per_level", x.samples_per_level);
  archive("end", x.end);
  archive("next_seconds", x.next_seconds);
}

void fields(auto& archive, Like<Curve> auto& x) {
  archive("t", x.t);
  archive("y", x.y);
}

void fields(auto& archive, Like<PrintedColumn> auto& x) {
  archive("name", x.name);
  archive("digits", x.digits);
  archive("single_precision", x.single);
  archive("half_unit", x.half_unit);
}

void fields(auto& archive, Like<Note> auto& x) {
  archive("code", x.code);
  archive("numbers", x.numbers);
  archive("text", x.text);
}

void fields(auto& archive, Like<HistoryFile> auto& x) {
  archive("file", x.file);
  archive("rows", x.rows);
  archive("rows_beyond_end", x.rows_beyond);
  archive("first_time", x.first);
  archive("last_time", x.last);
  archive("spacing", x.spacing);
  archive("step_source", x.step_source);
  archive("columns", x.columns);
  archive("printed_floor", x.printed_floor);
  archive("printed_floor_column", x.printed_by);
  archive("unseen_bend", x.unseen_bend);
  archive("has_velocities", x.has_velocities);
  archive("has_displacement", x.has_u);
  archive("start_error", x.start_error);
  archive("collision_source", x.impact_source);
  archive("rows_resolve_collisions", x.rows_resolve_impacts);
  archive("contact_time", x.contact_time);
  archive("notes", x.notes);
  archive("history", x.history);
}

void fields(auto& archive, Like<MetricResult> auto& x) {
  archive("name", x.name);
  archive("unit", x.unit);
  archive("value", x.value);
  archive("masses", x.masses);
  archive("reason", x.reason);
  archive("across_jumps", x.across_jumps);
}

void fields(auto& archive, Like<model::Work> auto& x) {
  archive("steps", x.steps);
  archive("force_evaluations", x.force_evaluations);
  archive("factorizations", x.factorizations);
  archive("newton_iterations", x.newton_iterations);
  archive("event_searches", x.event_searches);
}

void fields(auto& archive, Like<measure::ImpactScore> auto& x) {
  archive("expected", x.expected);
  archive("found", x.found);
  archive("matched", x.matched);
  archive("missed", x.missed);
  archive("extra", x.extra);
  archive("worst_time_error", x.worst_time_error);
  archive("rounding_floor", x.rounding_floor);
}

void fields(auto& archive, Like<measure::RunScore> auto& x) {
  archive("step", x.step);
  archive("finished", x.finished);
  archive("failure_code", x.failure_code);
  archive("failure", x.failure);
  archive("u_error", x.u_error);
  archive("u_error_absolute", x.u_error_absolute);
  archive("v_error", x.v_error);
  archive("energy_error", x.energy_error);
  archive("energy_ratio", x.energy_ratio);
  archive("rounding_floor", x.rounding_floor);
  archive("impacts", x.impacts);
  archive("work", x.work);
  archive("seconds", x.seconds);
}

/// The fields of the score stand beside the others.
void fields(auto& archive, Like<Run> auto& x) {
  fields(archive, x.score);
  archive("file", x.file);
  archive("metrics", x.metrics);
  archive("error_history", x.error_history);
  archive.added("printed", x.printed);
  archive.added("motion", x.motion);
}

void fields(auto& archive, Like<Level> auto& x) {
  archive("step", x.step);
  archive("runs", x.runs);
}

void fields(auto& archive, Like<Claim> auto& x) {
  archive("behaviour", x.behaviour);
  archive("order", x.order);
  archive("reason", x.reason);
}

void fields(auto& archive, Like<judge::LadderFit> auto& x) {
  archive("behaviour", x.behaviour);
  archive("reason", x.reason);
  archive("has_line", x.has_line);
  archive("on_envelope", x.on_envelope);
  archive("order", x.order);
  archive("spread", x.spread);
  archive("scatter", x.scatter);
  archive("constant", x.constant);
  archive("first_level", x.first_level);
  archive("last_level", x.last_level);
  archive.added("largest_step", x.largest_step);
  archive.added("smallest_step", x.smallest_step);
  archive("floor", x.floor);
  archive.added("floor_step", x.floor_step);
  archive.added("floor_scatter", x.floor_scatter);
  archive.added("cancel_step", x.cancel_step);
  archive.added("lucky_share", x.coincident_share);
  archive.added("stable_step", x.stable_step);
  archive("steps", x.steps);
  archive("errors", x.errors);
}

void fields(auto& archive, Like<judge::Evidence> auto& x) {
  archive("code", x.code);
  archive("verdict", x.verdict);
  archive("numbers", x.numbers);
}

void fields(auto& archive, Like<judge::Assessment> auto& x) {
  archive("displacement", x.displacement);
  archive("velocity", x.velocity);
  archive("impact_time", x.impact_time);
  archive("verdict", x.verdict);
  archive.added("mismatch", x.mismatch);
  archive("reason", x.reason);
  archive("evidence", x.evidence);
}

void fields(auto& archive, Like<judge::SelfConvergence> auto& x) {
  archive("differences", x.differences);
  archive("proper", x.proper);
  archive("estimate", x.estimate);
}

void fields(auto& archive, Like<judge::SelfAgainstReference> auto& x) {
  archive("false_convergence", x.false_convergence);
  archive("reason", x.reason);
  archive("error_ratio", x.error_ratio);
}

void fields(auto& archive, Like<judge::Richardson> auto& x) {
  archive("bounded", x.bounded);
  archive("reason", x.reason);
  archive("value", x.value);
  archive("bound", x.bound);
  archive("estimate", x.estimate);
  archive("level", x.level);
}

void fields(auto& archive, Like<SelfResult> auto& x) {
  archive("order", x.order);
  archive("without_reference", x.self);
  archive("errors", x.errors);
  archive("against_reference", x.against_reference);
  archive("extrapolation", x.extrapolation);
  archive("extrapolation_error", x.extrapolation_error);
}

void fields(auto& archive, Like<Subject> auto& x) {
  archive("kind", x.kind);
  archive("name", x.name);
  archive.added("integrator", x.integrator);
  archive.added("treatment", x.treatment);
  archive("claim", x.claim);
  archive("tolerance", x.tolerance);
  archive("contact_time", x.contact_time);
  archive("refusal", x.refusal);
  archive("refusal_code", x.refusal_code);
  archive("complete", x.complete);
  archive.added("resolution", x.resolution);
  archive("levels", x.levels);
  archive.added("refinement", x.refinement);
  archive("assessment", x.assessment);
  archive("self_convergence", x.self_convergence);
  archive.added("diagnoses", x.diagnoses);
}

void fields(auto& archive, Like<judge::ProfileStep> auto& x) {
  archive("ratio", x.ratio);
  archive("share", x.share);
}

void fields(auto& archive, Like<judge::MethodProfile> auto& x) {
  archive("method", x.method);
  archive("ratios", x.ratios);
  archive("steps", x.steps);
  archive("best", x.best);
  archive("failed", x.failed);
}

void fields(auto& archive, Like<Profile> auto& x) {
  archive("counter", x.counter);
  archive("tasks", x.tasks);
  archive("methods", x.methods);
}

void fields(auto& archive, Like<CaseRecord> auto& x) {
  archive("problem", x.problem);
  archive("plan", x.plan);
  archive("response", x.response);
  archive("subjects", x.subjects);
  archive("profiles", x.profiles);
}

void fields(auto& archive, Like<Record> auto& x) {
  archive("command", x.command);
  archive("provenance", x.provenance);
  archive("cases", x.cases);
  archive("profiles", x.profiles);
  archive("interrupted", x.interrupted);
}

}  // namespace clackers::record
