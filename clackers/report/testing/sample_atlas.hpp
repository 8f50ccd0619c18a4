#pragma once

#include "clackers/report/atlas.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/testing/sample_record.hpp"

// Made-up sheets in the shape of a campaign's tables, for tests of the page.
namespace clackers::report {

struct SampleAtlas {
  record::Sheet subjects, runs;
};

inline record::Sheet sheet_of(std::initializer_list<const char*> first) {
  record::Sheet sheet;
  for (const auto* name : first) sheet.columns.push_back({name, "", ""});
  for (const auto& shown : columns())
    if (shown.in_rows) sheet.columns.push_back({std::string(shown.name), "", ""});
  return sheet;
}

inline void add_row(record::Sheet& sheet, std::vector<record::Cell> first, const Row& row) {
  for (const auto& shown : columns())
    if (shown.in_rows) first.push_back(shown.get(row));
  sheet.rows.push_back(std::move(first));
}

/// `n` by `xi` systems of three-parameter, and one of stop, with the methods of sample_record(); the
/// errors grow with the system.
inline SampleAtlas sample_atlas(int n = 3, int xi = 2) {
  SampleAtlas atlas{sheet_of({"task", "system", "set_N", "set_xi1"}), sheet_of({"task"})};
  auto record = sample_record({.levels = 4, .samples = 2, .points = 9}).cases.front();
  long long task = 0;
  const auto add_system = [&](long long system, record::Cell first, record::Cell second) {
    for (auto& subject : record.subjects) {
      for (int level = 0; level < int(subject.levels.size()); ++level)
        for (auto& run : subject.levels[std::size_t(level)].runs) {
          run.score.u_error *= 1.25;
          add_row(atlas.runs, {task}, run_row(record, subject, level + 1, run));
        }
      add_row(atlas.subjects, {task, system, first, second}, subject_row(record, subject));
      ++task;
    }
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < xi; ++k) add_system(i * xi + k, (long long)(n - i), 0.05 * (k + 1));
  record.problem.name = "stop";
  add_system(n * xi, {}, {});
  return atlas;
}

inline AtlasPart sample_part(const SampleAtlas& atlas, record::RowSource& runs,
                             const std::string& origin = {}) {
  AtlasPart part;
  part.subjects = &atlas.subjects;
  part.runs = &runs;
  part.origin = origin;
  part.from = sample_provenance("clackers atlas");
  part.options = "--levels 4 --samples-per-level 2";
  return part;
}

inline AtlasText sample_atlas_text() {
  return {"atlas", "A small atlas", "Made-up numbers.", "methods = [\"all\"]\n",
          sample_provenance("clackers atlas --out 'my atlas'")};
}

}  // namespace clackers::report
