#pragma once

#include "clackers/study/check_record.hpp"
#include "clackers/study/record/record_fields.hpp"

namespace clackers::study {

// The fields of a CheckRecord in json, as record_fields.hpp has them of a Record.

template <class Archive>
void fields(Archive& archive, Like<PrintedColumn> auto& x) {
  auto& [name, digits, single, half_unit] = x;
  archive("name", name);
  archive("digits", digits);
  archive("single_precision", single);
  archive("half_unit", half_unit);
}

template <class Archive>
void fields(Archive& archive, Like<CheckedFile> auto& x) {
  auto& [file, rows, rows_beyond, first, last, spacing, step_source, columns, floor, by, bend,
         has_v, has_u, start, collisions, resolved, contact, score, metrics, notes, history,
         error_history] = x;
  archive("file", file);
  archive("rows", rows);
  archive("rows_beyond_end", rows_beyond);
  archive("first_time", first);
  archive("last_time", last);
  archive("spacing", spacing);
  archive("step_source", step_source);
  archive("columns", columns);
  archive("printed_floor", floor);
  archive("printed_floor_column", by);
  archive("unseen_bend", bend);
  archive("has_velocities", has_v);
  archive("has_displacement", has_u);
  archive("start_error", start);
  archive("collision_source", collisions);
  archive("rows_resolve_collisions", resolved);
  archive("contact_time", contact);
  archive("score", score);
  archive("metrics", metrics);
  archive("notes", notes);
  archive("history", history);
  archive("error_history", error_history);
}

template <class Archive>
void fields(Archive& archive, Like<CheckRecord> auto& x) {
  auto& [provenance, problem, response, expect, tolerance, files, assessment, verdict, sentence,
         reason, next] = x;
  archive("provenance", provenance);
  archive("case", problem);
  archive("response", response);
  archive("expect", expect);
  archive("tolerance", tolerance);
  archive("files", files);
  archive("assessment", assessment);
  archive("verdict", verdict);
  archive("sentence", sentence);
  archive("reason", reason);
  archive("next", next);
}

}  // namespace clackers::study
