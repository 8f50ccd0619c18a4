#include <gtest/gtest.h>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/testing/histories.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"

// Each cause in histories of many cases and steps where it must be named, alone. Where it must not
// be: right_solvers_test.cpp. Those in digits and rows: file_numbers_test.cpp.
namespace clackers::diagnose {
namespace {

using testing::assorted_cases;
using testing::codes;
using testing::exact_rows;
using testing::Files;
using testing::run;

bool symmetric(const cases::Case& problem) { return problem.entry->name == "symmetric-pair"; }

// Of a method's own rows, all but the first.
void change(model::Trajectory& rows, const Reading& reading) {
  const auto before = rows;
  const auto masses = std::size_t(rows.dof);
  for (std::size_t row = 1; row < rows.t.size(); ++row)
    for (std::size_t q = 0; q < reading.column.size(); ++q) {
      const auto column = reading.column[q];
      (column < masses ? rows.u : rows.v)[row * masses + column % masses] =
          reading.factor[q] * (q < masses ? before.u : before.v)[row * masses + q % masses];
    }
}

TEST(FileCauses, NamesColumnsThatAreExchangedAfterTheFirstRow) {
  std::size_t number = 0;
  for (const auto& problem : assorted_cases())
    for (const double h : {0.02})
      for (const auto& reading : exchanges(std::size_t(problem.motion->dof()), true)) {
        // One in five of the permutations: all of them in some case.
        if (symmetric(problem) || (reading.column.size() > 2 && number++ % 5 != 0)) continue;
        auto rows = run("rk4", problem.problem, h);
        change(rows, reading);
        Files files{problem};
        files.add(rows, h);
        const auto causes = file_causes(files.question());
        ASSERT_EQ(codes(causes), reading.code) << problem.entry->name << h;
        EXPECT_EQ(causes[0].text, columns_option(reading, {}, std::size_t(rows.dof)));
      }
}

TEST(FileCauses, NamesSignsAndUnitsAfterTheFirstRow) {
  for (const auto& problem : assorted_cases())
    for (const double h : {0.02}) {
      const auto right = run("rk4", problem.problem, h);
      for (const auto& reading : reversals(std::size_t(right.dof), true)) {
        if (symmetric(problem)) continue;
        auto rows = right;
        change(rows, reading);
        Files files{problem};
        files.add(rows, h);
        ASSERT_EQ(codes(file_causes(files.question())), "sign-reversed") << problem.entry->name;
      }
      auto rows = right;
      for (double& v : rows.v) v *= 1000.0;
      Files files{problem};
      files.add(rows, h);
      const auto causes = file_causes(files.question());
      ASSERT_EQ(codes(causes), "unit-scaled") << problem.entry->name << h;
      EXPECT_EQ(causes[0].text, "v mm/s");
    }
}

TEST(FileCauses, NamesTheUnitOfTime) {
  for (const auto& problem : assorted_cases())
    for (const double h : {0.02, 0.01}) {
      auto rows = run("rk4", problem.problem, h);
      for (double& t : rows.t) t /= 60.0;
      Files files{problem};
      files.add(rows, h / 60.0);
      auto causes = file_causes(files.question());
      ASSERT_EQ(codes(causes), "time-unit") << problem.entry->name;
      EXPECT_EQ(causes[0].text, "min");
      // In ms only the rows of the first 20 ms lie within the case.
      rows = run("rk4", problem.problem, 0.001);
      rows.t.resize(21);
      rows.u.resize(21 * std::size_t(rows.dof));
      rows.v.resize(rows.u.size());
      for (double& t : rows.t) t = std::min(std::round(t * 1000.0), problem.motion->end());
      Files in_ms{problem};
      in_ms.add(rows, 1.0);
      causes = file_causes(in_ms.question());
      ASSERT_EQ(codes(causes), "time-unit") << problem.entry->name;
      EXPECT_EQ(causes[0].value, 1000.0);
    }
}

// v of the steps' middle, (u1 - u0) / h, of Newmark's method and of one without errors.
TEST(FileCauses, NamesVelocitiesOfHalfSteps) {
  for (const auto& problem : assorted_cases())
    for (const auto& steps : {std::vector{0.01, 0.005}, std::vector{0.002}}) {
      Files forward{problem}, backward{problem};
      for (const double h : steps) {
        const auto rows = run("newmark", problem.problem, h);
        const auto dof = std::size_t(rows.dof);
        auto later = rows, earlier = rows;
        for (std::size_t i = 0; i + dof < rows.u.size(); ++i) {
          const double rate = (rows.u[i + dof] - rows.u[i]) / rows.t[1];
          if (i >= dof) later.v[i] = rate;
          earlier.v[i + dof] = rate;
        }
        forward.add(later, h);
        backward.add(earlier, h);
      }
      auto causes = file_causes(forward.question());
      ASSERT_EQ(codes(causes), "velocity-at-half-steps")
          << problem.entry->name << problem.values[0].second << ' ' << steps[0];
      EXPECT_EQ(causes[0].value, 0.5);
      causes = file_causes(backward.question());
      ASSERT_EQ(codes(causes), "velocity-at-half-steps")
          << problem.entry->name << problem.values[0].second << ' ' << steps[0];
      EXPECT_EQ(causes[0].value, -0.5);
    }
}

TEST(FileCauses, NamesVelocitiesOfALowerOrder) {
  for (const double lower : {1.0, 2.0})
    for (const double spread : {0.0, 0.05, 0.1}) {
      Files files{cases::make("three-parameter")};
      files.add(exact_rows(files.problem, 0.02), 0.02);
      files.displacement.behaviour = files.velocity.behaviour = Behaviour::proper;
      files.displacement.has_line = files.velocity.has_line = true;
      files.displacement.order = lower + 1.0;
      files.velocity.order = lower + 0.02;
      files.displacement.spread = files.velocity.spread = spread;
      const auto causes = file_causes(files.question());
      ASSERT_EQ(codes(causes), "velocity-order-lower");
      EXPECT_EQ(causes[0].value, files.velocity.order);
      files.velocity.order = lower + 0.6;  // between two orders
      EXPECT_EQ(codes(file_causes(files.question())), "");
      files.velocity.order = lower + 1.0;
      EXPECT_EQ(codes(file_causes(files.question())), "");
      files.velocity.order = lower;
      files.velocity.on_envelope = true;
      EXPECT_EQ(codes(file_causes(files.question())), "");
      files.velocity.on_envelope = false;
      files.displacement.behaviour = Behaviour::exact;
      files.displacement.has_line = false;
      const auto of_exact = file_causes(files.question());
      ASSERT_EQ(codes(of_exact), "velocity-order-lower");
      EXPECT_TRUE(std::isnan(of_exact[0].fact("expected")));
    }
}

TEST(FileCauses, NamesVelocitiesThatStayAwayFromTheTrueOnes) {
  const auto causes_of = [](auto changed, std::initializer_list<double> steps) {
    Files files{cases::make("synchronized-pair", {{"X", 5.0}, {"r", 2.0}})};
    for (const double h : steps) {
      auto rows = exact_rows(files.problem, h);
      for (std::size_t i = std::size_t(rows.dof); i < rows.v.size(); ++i)
        rows.v[i] = changed(rows.v[i], h);
      files.add(rows, h);
    }
    return file_causes(files.question());
  };
  for (const double factor : {0.9, 0.999, 1.03}) {
    const auto found = causes_of([&](double v, double) { return factor * v; }, {0.04, 0.02, 0.01});
    ASSERT_EQ(codes(found), "velocities-differ") << factor;
    EXPECT_NEAR(found[0].value, factor, 1e-5);
    EXPECT_TRUE(is_other_system(found[0]));
  }
  const auto offset = causes_of([](double v, double) { return v + 1e-3; }, {0.04, 0.02, 0.01});
  ASSERT_EQ(codes(offset), "velocities-differ");
  EXPECT_TRUE(std::isnan(offset[0].value));
  // What falls with the step, or is seen at only one step, is no other velocity.
  EXPECT_EQ(codes(causes_of([](double v, double h) { return v + h; }, {0.04, 0.02, 0.01})), "");
  EXPECT_EQ(codes(causes_of([](double v, double) { return 0.9 * v; }, {0.01})), "");
}

}  // namespace
}  // namespace clackers::diagnose
