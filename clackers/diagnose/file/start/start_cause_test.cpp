#include <gtest/gtest.h>

#include <random>

#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/file/units.hpp"
#include "clackers/diagnose/testing/histories.hpp"
#include "clackers/methods/testing/runs.hpp"

namespace clackers::diagnose {
namespace {

using testing::assorted_cases;
using testing::exact_rows;

std::optional<Diagnosis> cause_of(const cases::Case& problem, const model::Trajectory& rows,
                                  double step, std::vector<std::string> columns = {}) {
  FirstRows opening;
  opening.step = step;
  opening.rows = rows;
  opening.has_u.assign(std::size_t(rows.dof), true);
  opening.columns = std::move(columns);
  return diagnose_start(opening, problem.problem, *problem.motion);
}

std::string code_of(const std::optional<Diagnosis>& cause) { return cause ? cause->code : ""; }

// The rows that a file has in which quantity q is printed as factor[q] times itself in the column
// labelled column[q].
model::Trajectory written(const Reading& reading, const model::Trajectory& rows) {
  auto file = rows;
  const auto masses = std::size_t(rows.dof);
  for (std::size_t row = 0; row < rows.t.size(); ++row)
    for (std::size_t q = 0; q < reading.column.size(); ++q) {
      const auto& from = q < masses ? rows.u : rows.v;
      const auto column = reading.column[q];
      (column < masses ? file.u : file.v)[row * masses + column % masses] =
          reading.factor[q] * from[row * masses + q % masses];
    }
  return file;
}

bool symmetric_start(const cases::Case& problem) { return problem.entry->name == "symmetric-pair"; }

TEST(StartCause, SaysNothingOfARightStart) {
  for (const auto& problem : assorted_cases())
    for (const double step : {0.05, 0.02})
      for (const int digits : {3, 6, 17}) {
        auto rows = exact_rows(problem, step);
        testing::print(rows, digits);
        FirstRows opening{step, rows, std::vector<bool>(std::size_t(rows.dof), true), 0.0, {}};
        opening.printed_floor = testing::facts_of(problem, rows, step, digits).floor;
        EXPECT_EQ(code_of(diagnose_start(opening, problem.problem, *problem.motion)), "");
      }
}

TEST(StartCause, SaysNothingOfOtherParameters) {
  const auto problem = cases::make("three-parameter");
  for (const double N : {0.0, 1.0, 3.0, 5.0, 20.0})
    EXPECT_EQ(code_of(cause_of(problem,
                               exact_rows(cases::make("three-parameter", {{"N", N}}), 0.01), 0.01)),
              "")
        << N;
  for (const double xi1 : {0.01, 0.1, 0.25, 0.5, 0.7})
    for (const char* name : {"three-parameter", "stop", "sdof"})
      EXPECT_EQ(code_of(cause_of(cases::make(name),
                                 exact_rows(cases::make(name, {{"xi1", xi1}}), 0.01), 0.01)),
                "")
          << name << xi1;
}

TEST(StartCause, NamesTheUnit) {
  for (const auto& problem : assorted_cases())
    for (const auto& unit : length_units) {
      auto rows = exact_rows(problem, 0.01);
      for (auto* values : {&rows.u, &rows.v})
        for (double& x : *values) x *= unit.factor;
      const auto cause = cause_of(problem, rows, 0.01);
      ASSERT_EQ(code_of(cause), "unit-scaled") << problem.entry->name << unit.name;
      EXPECT_EQ(cause->text, unit.name);
      EXPECT_NEAR(cause->value / unit.factor, 1.0, 1e-5);
      EXPECT_GE(cause->confidence, 0.9);
    }
}

TEST(StartCause, NamesTheUnitOfOneQuantity) {
  for (const auto& problem : assorted_cases()) {
    auto rows = exact_rows(problem, 0.01);
    for (double& x : rows.u) x *= 1000.0;
    auto cause = cause_of(problem, rows, 0.01);
    ASSERT_EQ(code_of(cause), "unit-scaled") << problem.entry->name;
    EXPECT_EQ(cause->text, "u mm");
    EXPECT_EQ(cause->value, 1000.0);
    rows = exact_rows(problem, 0.01);
    for (double& x : rows.v) x *= 1000.0;
    cause = cause_of(problem, rows, 0.01);
    ASSERT_EQ(code_of(cause), "unit-scaled") << problem.entry->name;
    EXPECT_EQ(cause->text, "v mm/s");
  }
}

TEST(StartCause, TellsTimesInMillisecondsFromVelocitiesInOtherUnits) {
  for (const auto& problem : assorted_cases()) {
    auto rows = exact_rows(problem, 0.01);
    for (double& x : rows.v) x /= 1000.0;
    auto cause = cause_of(problem, rows, 0.01);
    ASSERT_EQ(code_of(cause), "unit-scaled") << problem.entry->name;
    for (double& t : rows.t) t *= 1000.0;
    cause = cause_of(problem, rows, 10.0);
    ASSERT_EQ(code_of(cause), "time-unit") << problem.entry->name;
    EXPECT_EQ(cause->value, 1000.0);
    EXPECT_EQ(cause->text, "ms");
  }
}

TEST(StartCause, NamesExchangedMassesAndColumns) {
  for (const auto& problem : assorted_cases()) {
    const auto masses = std::size_t(problem.motion->dof());
    for (const auto& reading : exchanges(masses, true)) {
      const auto cause =
          cause_of(problem, written(reading, exact_rows(problem, 0.01)), 0.01,
                   masses == 2 ? std::vector<std::string>{"t", "u1", "u2", "v1", "v2"}
                               : std::vector<std::string>{"t", "u", "v"});
      // Equal masses with opposite motions: exchanges and signs are one thing.
      if (symmetric_start(problem)) {
        EXPECT_TRUE(cause.has_value());
        continue;
      }
      ASSERT_EQ(code_of(cause), reading.code) << problem.entry->name;
      EXPECT_GE(cause->confidence, 0.9);
      auto option = std::string("t");
      // The file's columns in order u1 u2 v1 v2, each by the quantity that it truly has.
      for (std::size_t column = 0; column < 2 * masses; ++column)
        for (std::size_t q = 0; q < 2 * masses; ++q)
          if (reading.column[q] == column) option += "," + quantity_name(q, masses);
      EXPECT_EQ(cause->text, option);
    }
  }
}

TEST(StartCause, KeepsTheFilesOrderAndOtherColumns) {
  const auto problem = cases::make("three-parameter");
  const auto swap = exchanges(2, true).front();
  const auto cause = cause_of(problem, written(swap, exact_rows(problem, 0.01)), 0.01,
                              {"step", "T", "U2", "v2", "u1", "V1", "_"});
  ASSERT_TRUE(cause);
  EXPECT_EQ(cause->text, "step,T,u1,v1,u2,v2,_");
}

TEST(StartCause, NamesReversedSigns) {
  for (const auto& problem : assorted_cases())
    for (const auto& reading : reversals(std::size_t(problem.motion->dof()), true)) {
      const auto cause = cause_of(problem, written(reading, exact_rows(problem, 0.01)), 0.01);
      if (symmetric_start(problem)) continue;
      ASSERT_EQ(code_of(cause), "sign-reversed") << problem.entry->name;
      EXPECT_EQ(cause->text, reversed_columns(reading, std::size_t(problem.motion->dof())));
    }
}

TEST(StartCause, NamesAnExchangeInAnotherUnit) {
  for (const double N : {1.0, 2.0, 5.0})
    for (auto reading : exchanges(2, true)) {
      const auto problem = cases::make("three-parameter", {{"N", N}});
      std::ranges::fill(reading.factor, 1000.0);
      const auto cause = cause_of(problem, written(reading, exact_rows(problem, 0.01)), 0.01);
      ASSERT_EQ(code_of(cause), reading.code);
      EXPECT_EQ(cause->value, 1000.0);
    }
}

// The program starts with v = 0, and moves as the system does from there.
TEST(StartCause, NamesAStartAtRest) {
  for (const auto& problem : assorted_cases())
    for (const double step : {0.05, 0.02}) {
      auto other = problem.problem;
      other.start.v.setZero();
      const auto rows =
          methods::runs::run("rk4", other, problem.problem.end / std::round(20.0 / step))
              .trajectory;
      const auto cause = cause_of(problem, rows, step);
      ASSERT_EQ(code_of(cause), "starts-at-rest") << problem.entry->name;
      EXPECT_NEAR(std::abs(cause->fact("expected")), problem.problem.start.v.cwiseAbs().maxCoeff(),
                  1e-12);
    }
}

TEST(StartCause, NamesVelocitiesOfHalfSteps) {
  for (const auto& problem : assorted_cases())
    for (const double step : {0.05, 0.02, 0.005})
      for (const double side : {0.5, -0.5}) {
        const auto& start = problem.problem.start;
        const auto start_a = problem.motion->at(0.0, model::Side::right).a;
        auto rows = exact_rows(problem, step);
        testing::resample(rows, problem, 0.0, -side * step);
        for (int mass = 0; mass < rows.dof; ++mass)
          rows.v[std::size_t(mass)] = start.v[mass] + side * step * start_a[mass];
        const auto cause = cause_of(problem, rows, step);
        ASSERT_EQ(code_of(cause), "velocity-at-half-steps") << problem.entry->name;
        EXPECT_EQ(cause->value, side);
      }
}

TEST(StartCause, NamesTheTimeOfTheFirstRow) {
  for (const auto& problem : assorted_cases())
    for (const double step : {0.05, 0.02}) {
      // The first row, at t = h, holds the initial state.
      auto rows = exact_rows(problem, step);
      for (double& t : rows.t) t += step;
      auto cause = cause_of(problem, rows, step);
      ASSERT_EQ(code_of(cause), "time-shifted") << problem.entry->name;
      EXPECT_EQ(cause->value, 1.0);
      EXPECT_EQ(cause->unit, "steps");
      // Rows from 3.3333 s on, their times from 0.
      rows = exact_rows(problem, step);
      testing::resample(rows, problem, -3.3333, -3.3333);
      cause = cause_of(problem, rows, step);
      ASSERT_EQ(code_of(cause), "time-shifted") << problem.entry->name;
      EXPECT_EQ(cause->unit, "s");
      EXPECT_NEAR(cause->value, -3.3333, 1e-9);
    }
}

TEST(StartCause, SaysNothingOfAFirstRowThatAMethodMade) {
  for (const auto& problem : assorted_cases())
    for (const char* method : {"newmark", "rk4", "moreau-jean"}) {
      if (std::string_view(method) == "moreau-jean" && problem.problem.contacts.empty()) continue;
      auto rows = methods::runs::run(method, problem.problem, problem.problem.end / 400).trajectory;
      const auto dof = std::ptrdiff_t(rows.dof);
      rows.t.erase(rows.t.begin());
      rows.u.erase(rows.u.begin(), rows.u.begin() + dof);
      rows.v.erase(rows.v.begin(), rows.v.begin() + dof);
      EXPECT_EQ(code_of(cause_of(problem, rows, problem.problem.end / 400)), "")
          << problem.entry->name << method;
    }
}

}  // namespace
}  // namespace clackers::diagnose
