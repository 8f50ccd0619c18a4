// check() of columns in memory.
#include <gtest/gtest.h>

#include <fstream>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/record/record_json.hpp"
#include "clackers/study/check.hpp"
#include "clackers/study/testing/check_fixture.hpp"

namespace clackers::study {
namespace {

TEST_F(Check, ColumnsInMemoryAreJudgedAsTheirFile) {
  CheckRequest request;
  request.subjects[0].files = {write(0.01, 1.0)};
  request.tolerance = 1.0;
  const std::vector<double> hits = {1.0, 2.0, 30.0};
  const auto events = (folder_ / "hits.csv").string();
  std::ofstream(events) << "t\n1\n2\n30\n";
  const auto values = numbers(0.01, 1.0);
  for (const bool with_events : {false, true}) {
    if (with_events) request.events = {events};
    auto expected = check(request);
    auto given = request;
    given.subjects[0].files = {columns("h0.01", values)};
    if (with_events) given.events = {input::NumberColumns{"events 1", 3, {{"t", hits.data(), 1}}}};
    const auto record = check(given);
    const auto* run = record.cases[0].subjects[0].shown_run();
    EXPECT_EQ(run->file->file, "h0.01");
    EXPECT_EQ(has(*run, "events-outside"), with_events);
    // The rest of the record is the same.
    auto& file = *expected.cases[0].subjects[0].levels[0].runs[0].file;
    file.file = "h0.01";
    for (auto& note : file.notes)
      if (note.code == "events-outside") note.text = "events 1";
    auto same = record;
    same.provenance = expected.provenance;
    EXPECT_EQ(to_json(same), to_json(expected));
  }
}

TEST_F(Check, NamesOfColumnsInMemoryGiveStepsAsThoseOfFilesDo) {
  CheckRequest request;
  std::vector<std::vector<double>> values;
  for (const double h : {0.01, 0.005}) values.push_back(numbers(h, 1.0));
  request.subjects[0].files = {columns("h=0.02", values[0]), columns("h=0.01", values[1])};
  auto record = check(request);
  EXPECT_EQ(record.cases[0].subjects[0].levels[0].step, 0.02);
  request.steps = {0.04, 0.02};
  record = check(request);
  EXPECT_EQ(record.cases[0].subjects[0].levels[0].step, 0.04);
}

TEST_F(Check, RefusalsNameColumnsInMemory) {
  CheckRequest request;
  auto values = numbers(0.01);
  values[1] = 0.5;
  request.subjects[0].files = {columns("history 1", values)};
  EXPECT_REFUSED(check(request), "not-this-case", "history 1: u1 starts at 0.5");
  values = numbers(0.01);
  values[5 * 17] = -1.0;
  request.subjects[0].files = {columns("history 1", values)};
  EXPECT_REFUSED(check(request), "not-sorted", "history 1 row 17 (from 0): t = -1");
}

}  // namespace
}  // namespace clackers::study
