#pragma once

#include <concepts>
#include <type_traits>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// T, or const T: one list of fields serves writing and reading.
template <class T, class Base>
concept Like = std::same_as<std::remove_const_t<T>, Base>;

// Every struct of a record and the names of its fields in json. `fields(archive, x)` calls
// archive(name, member) for each, by each() for several at once; record_json_test.cpp compares their
// number with that of the members, so that none is forgotten. archive.added(name, member) is a field
// that records of earlier versions lack.

void each(auto&) {}
void each(auto& archive, const char* name, auto& member, auto&&... others) {
  archive(name, member);
  each(archive, others...);
}

void fields(auto& archive, Like<Quantity> auto& x) {
  each(archive, "name", x.name, "value", x.value, "unit", x.unit, "meaning", x.meaning);
  archive.added("text", x.text);
}

void fields(auto& archive, Like<Provenance> auto& x) {
  each(archive, "command", x.command, "version", x.version, "compiler", x.compiler, "machine",
       x.machine, "processor", x.processor, "date", x.date);
}

void fields(auto& archive, Like<Schematic::Block> auto& x) {
  each(archive, "column", x.column, "height", x.height);
}

void fields(auto& archive, Like<Schematic::Spring> auto& x) {
  each(archive, "one", x.one, "other", x.other);
}

void fields(auto& archive, Like<Schematic::Touch> auto& x) {
  each(archive, "left", x.left, "right", x.right, "gap", x.gap);
}

void fields(auto& archive, Like<Schematic::Node> auto& x) {
  each(archive, "x", x.x, "mass", x.mass);
}

void fields(auto& archive, Like<Schematic> auto& x) {
  each(archive, "blocks", x.blocks, "springs", x.springs, "contacts", x.contacts);
  archive.added("leftward", x.leftward);
  archive.added("lengths", x.lengths);
  archive.added("plane", x.plane);
  archive.added("string", x.string);
}

void fields(auto& archive, Like<CaseSummary> auto& x) {
  each(archive, "name", x.name, "summary", x.summary, "equations", x.equations, "parameters",
       x.parameters, "constants", x.constants, "end", x.end, "fast_period", x.fast_period,
       "impact_times", x.impact_times, "impact_count", x.impact_count);
  archive.added("impact_contacts", x.impact_contacts);
  archive.added("contact_forces", x.contact_forces);
  archive.added("drawing", x.drawing);
}

void fields(auto& archive, Like<RefinementPlan> auto& x) {
  each(archive, "coarsest", x.coarsest, "levels", x.levels, "samples_per_level",
       x.samples_per_level);
}

void fields(auto& archive, Like<Refinement> auto& x) {
  each(archive, "finer_levels", x.finer_levels, "coarser_levels", x.coarser_levels,
       "samples_per_level", x.samples_per_level, "end", x.end, "next_seconds", x.next_seconds);
}

void fields(auto& archive, Like<Curve> auto& x) { each(archive, "t", x.t, "y", x.y); }

void fields(auto& archive, Like<PrintedColumn> auto& x) {
  each(archive, "name", x.name, "digits", x.digits, "single_precision", x.single, "half_unit",
       x.half_unit);
}

void fields(auto& archive, Like<Note> auto& x) {
  each(archive, "code", x.code, "numbers", x.numbers, "text", x.text);
}

void fields(auto& archive, Like<HistoryFile> auto& x) {
  each(archive, "file", x.file, "rows", x.rows, "rows_beyond_end", x.rows_beyond, "first_time",
       x.first, "last_time", x.last, "spacing", x.spacing, "step_source", x.step_source, "columns",
       x.columns, "printed_floor", x.printed_floor, "printed_floor_column", x.printed_by,
       "unseen_bend", x.unseen_bend, "has_velocities", x.has_velocities, "has_displacement",
       x.has_u, "start_error", x.start_error, "collision_source", x.impact_source,
       "rows_resolve_collisions", x.rows_resolve_impacts, "contact_time", x.contact_time, "notes",
       x.notes, "history", x.history);
}

void fields(auto& archive, Like<MetricResult> auto& x) {
  each(archive, "name", x.name, "unit", x.unit, "value", x.value, "masses", x.masses, "reason",
       x.reason, "across_jumps", x.across_jumps);
}

void fields(auto& archive, Like<model::Work> auto& x) {
  each(archive, "steps", x.steps, "force_evaluations", x.force_evaluations, "factorizations",
       x.factorizations, "newton_iterations", x.newton_iterations, "event_searches",
       x.event_searches);
}

void fields(auto& archive, Like<measure::ImpactScore> auto& x) {
  each(archive, "expected", x.expected, "found", x.found, "matched", x.matched, "missed", x.missed,
       "extra", x.extra, "worst_time_error", x.worst_time_error, "rounding_floor",
       x.rounding_floor);
}

void fields(auto& archive, Like<measure::RunScore> auto& x) {
  each(archive, "step", x.step, "finished", x.finished, "failure_code", x.failure_code, "failure",
       x.failure, "u_error", x.u_error, "u_error_absolute", x.u_error_absolute, "v_error",
       x.v_error, "energy_error", x.energy_error, "energy_ratio", x.energy_ratio, "rounding_floor",
       x.rounding_floor, "impacts", x.impacts, "work", x.work, "seconds", x.seconds);
}

/// The fields of the score stand beside the others.
void fields(auto& archive, Like<Run> auto& x) {
  fields(archive, x.score);
  each(archive, "file", x.file, "metrics", x.metrics, "error_history", x.error_history);
  archive.added("printed", x.printed);
  archive.added("motion", x.motion);
}

void fields(auto& archive, Like<Level> auto& x) { each(archive, "step", x.step, "runs", x.runs); }

void fields(auto& archive, Like<Claim> auto& x) {
  each(archive, "behaviour", x.behaviour, "order", x.order, "reason", x.reason);
  archive.added("velocity_order", x.velocity_order);
}

void fields(auto& archive, Like<judge::LadderFit> auto& x) {
  each(archive, "behaviour", x.behaviour, "reason", x.reason, "has_line", x.has_line, "on_envelope",
       x.on_envelope, "order", x.order, "spread", x.spread, "scatter", x.scatter, "constant",
       x.constant, "first_level", x.first_level, "last_level", x.last_level);
  archive.added("largest_step", x.largest_step);
  archive.added("smallest_step", x.smallest_step);
  archive("floor", x.floor);
  archive.added("floor_step", x.floor_step);
  archive.added("floor_scatter", x.floor_scatter);
  archive.added("cancel_step", x.cancel_step);
  archive.added("lucky_share", x.coincident_share);
  archive.added("stable_step", x.stable_step);
  each(archive, "steps", x.steps, "errors", x.errors);
}

void fields(auto& archive, Like<judge::Evidence> auto& x) {
  each(archive, "code", x.code, "verdict", x.verdict, "numbers", x.numbers);
}

void fields(auto& archive, Like<judge::Assessment> auto& x) {
  each(archive, "displacement", x.displacement, "velocity", x.velocity, "impact_time",
       x.impact_time, "verdict", x.verdict);
  archive.added("mismatch", x.mismatch);
  each(archive, "reason", x.reason, "evidence", x.evidence);
}

void fields(auto& archive, Like<judge::SelfConvergence> auto& x) {
  each(archive, "differences", x.differences, "proper", x.proper, "estimate", x.estimate);
}

void fields(auto& archive, Like<judge::SelfAgainstReference> auto& x) {
  each(archive, "false_convergence", x.false_convergence, "reason", x.reason, "error_ratio",
       x.error_ratio);
}

void fields(auto& archive, Like<judge::Richardson> auto& x) {
  each(archive, "bounded", x.bounded, "reason", x.reason, "value", x.value, "bound", x.bound,
       "estimate", x.estimate, "level", x.level);
}

void fields(auto& archive, Like<SelfResult> auto& x) {
  each(archive, "order", x.order, "without_reference", x.self, "errors", x.errors,
       "against_reference", x.against_reference, "extrapolation", x.extrapolation,
       "extrapolation_error", x.extrapolation_error);
}

void fields(auto& archive, Like<diagnose::LocatedImpact> auto& x) {
  each(archive, "t", x.t, "contact", x.contact, "closing_speed", x.closing, "opening_speed",
       x.opening, "restitution", x.restitution, "restitution_error", x.restitution_error,
       "momentum_defect", x.momentum_defect, "delay", x.delay, "delay_steps", x.delay_steps,
       "duration", x.duration, "closed_speed", x.closed_speed, "defect", x.defect, "stale_share",
       x.stale_share);
  archive.added("acting_gap", x.gap);
}

void fields(auto& archive, Like<diagnose::Departure> auto& x) {
  each(archive, "impact", x.impact, "time", x.time);
}

void fields(auto& archive, Like<Subject> auto& x) {
  each(archive, "kind", x.kind, "name", x.name);
  archive.added("integrator", x.integrator);
  archive.added("treatment", x.treatment);
  archive.added("labels", x.labels);
  each(archive, "claim", x.claim, "tolerance", x.tolerance, "contact_time", x.contact_time,
       "refusal", x.refusal, "refusal_code", x.refusal_code, "complete", x.complete);
  archive.added("resolution", x.refined_by);
  archive("levels", x.levels);
  archive.added("refinement", x.refinement);
  each(archive, "assessment", x.assessment, "self_convergence", x.self_convergence);
  archive.added("diagnoses", x.diagnoses);
  archive.added("departure", x.departure);
  archive.added("impact_table", x.impacts);
}

void fields(auto& archive, Like<judge::ProfileStep> auto& x) {
  each(archive, "ratio", x.ratio, "share", x.share);
}

void fields(auto& archive, Like<judge::MethodProfile> auto& x) {
  each(archive, "method", x.method, "ratios", x.ratios, "steps", x.steps, "best", x.best, "failed",
       x.failed);
}

void fields(auto& archive, Like<Profile> auto& x) {
  each(archive, "counter", x.counter, "tasks", x.tasks, "methods", x.methods);
}

void fields(auto& archive, Like<CaseRecord> auto& x) {
  each(archive, "problem", x.problem, "plan", x.plan, "response", x.response, "subjects",
       x.subjects, "profiles", x.profiles);
}

void fields(auto& archive, Like<Record> auto& x) {
  each(archive, "command", x.command, "provenance", x.provenance, "cases", x.cases, "profiles",
       x.profiles, "interrupted", x.interrupted);
}

}  // namespace clackers::record
