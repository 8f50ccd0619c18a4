#include <gtest/gtest.h>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/histories.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"

// Causes in the digits, times and rows of files, where each must be named, alone.
namespace clackers::diagnose {
namespace {

using testing::assorted_cases;
using testing::codes;
using testing::exact_rows;
using testing::Files;
using testing::find;
using testing::run;

TEST(FileNumbers, NamesPrintedDigits) {
  for (const auto& problem : assorted_cases())
    for (const int digits : {3, 5, 7}) {
      auto rows = run("rk4", problem.problem, 0.005);
      testing::print(rows, digits);
      Files files{problem};
      files.add(rows, testing::facts_of(problem, rows, 0.005, digits));
      const auto causes = file_causes(files.question());
      // Where the method errs more than printing does, digits say nothing.
      const double error = files.ladder.back().runs.front().u_error;
      const bool limits = error < 3.0 * files.histories[0].facts.floor;
      if (digits == 3 || limits) {
        ASSERT_EQ(codes(causes), "printed-digits") << problem.entry->name;
        EXPECT_EQ(causes[0].value, digits);
      } else {
        EXPECT_EQ(codes(causes), "");
      }
    }
}

TEST(FileNumbers, NamesSinglePrecision) {
  for (const auto& problem : assorted_cases())
    for (const bool times_alone : {false, true}) {
      auto rows = exact_rows(problem, 0.01);
      for (double& t : rows.t) t = std::min(double(float(t)), problem.motion->end());
      if (!times_alone)
        for (auto* values : {&rows.u, &rows.v})
          for (double& x : *values) x = double(float(x));
      Files files{problem};
      files.add(rows, 0.01);
      const auto causes = file_causes(files.question());
      ASSERT_EQ(codes(causes), "single-precision") << problem.entry->name;
      EXPECT_EQ(causes[0].text, times_alone ? "t" : rows.dof == 1 ? "t,u1,v1" : "t,u1,v1,u2,v2");
    }
}

// t = t + h in single precision, of a solver that is exact.
TEST(FileNumbers, NamesTimesThatDrift) {
  for (const auto& problem : assorted_cases())
    for (const double h : {0.004, 0.003}) {
      auto rows = exact_rows(problem, h);
      float t = 0.0f;
      for (double& time : rows.t) {
        time = std::min(double(t), problem.motion->end());
        t += float(h);
      }
      const double drift = rows.t[rows.t.size() - 5] - h * double(rows.t.size() - 5);
      Files files{problem};
      files.add(rows, h);
      const auto causes = file_causes(files.question());
      const auto* cause = find(causes, "time-drifts");
      ASSERT_NE(cause, nullptr) << problem.entry->name << h << codes(causes);
      EXPECT_NEAR(cause->value, drift, 0.1 * std::abs(drift) + 1e-5);
    }
}

// Straight lines, and Hermite's cubics, between exact nodes h apart, at rows that meet no node.
model::Trajectory interpolated(const cases::Case& problem, double h, double spacing, int degree) {
  const auto nodes = exact_rows(problem, h);
  auto rows = exact_rows(problem, spacing, nodes.t.back());
  const auto dof = std::size_t(rows.dof);
  for (std::size_t i = 0; i < rows.t.size(); ++i) {
    const auto k = std::min(std::size_t(rows.t[i] / h), nodes.t.size() - 2);
    const double s = (rows.t[i] - nodes.t[k]) / h;
    for (std::size_t mass = 0; mass < dof; ++mass) {
      const auto at = [&](const std::vector<double>& values, std::size_t node) {
        return values[node * dof + mass];
      };
      const double u0 = at(nodes.u, k), u1 = at(nodes.u, k + 1), v0 = at(nodes.v, k),
                   v1 = at(nodes.v, k + 1);
      rows.u[i * dof + mass] = degree == 1
                                   ? u0 + s * (u1 - u0)
                                   : (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s) * u0 +
                                         s * (1.0 - s) * (1.0 - s) * h * v0 +
                                         s * s * (3.0 - 2.0 * s) * u1 + s * s * (s - 1.0) * h * v1;
      rows.v[i * dof + mass] = v0 + s * (v1 - v0);
    }
  }
  return rows;
}

TEST(FileNumbers, NamesInterpolatedRows) {
  for (const auto& problem : assorted_cases())
    for (const double h : {20.0 / 952.0, 20.0 / 1979.0})
      for (const int degree : {1, 3}) {
        Files files{problem};
        files.add(interpolated(problem, h, 0.001, degree), 0.001);
        const auto causes = file_causes(files.question());
        const auto* cause = find(causes, "output-resampled");
        ASSERT_NE(cause, nullptr) << problem.entry->name << problem.values[0].second << ' ' << h
                                  << degree << codes(causes);
        EXPECT_EQ(cause->text, degree == 1 ? "linear" : "cubic");
        EXPECT_NEAR(cause->fact("step"), h, 0.02 * h);
        EXPECT_NEAR(cause->value, 0.001, 1e-12);
      }
}

TEST(FileNumbers, NamesAnEarlyEnd) {
  for (const auto& problem : assorted_cases())
    for (const double last : {1.0, 10.0, 19.9}) {
      Files files{problem};
      files.add(exact_rows(problem, 0.02, last), 0.02);
      const auto causes = file_causes(files.question());
      ASSERT_EQ(codes(causes), "ends-early") << problem.entry->name;
      EXPECT_NEAR(causes[0].value, last, 0.02);
      EXPECT_EQ(causes[0].fact("expected"), problem.motion->end());
    }
}

// Damping so small that the start is accepted.
TEST(FileNumbers, NamesAStartAtRestThatWasAccepted) {
  for (const char* name : {"sdof", "stop", "symmetric-pair", "three-parameter"})
    for (const double xi1 : {9e-4, 5e-4, 2e-4})
      for (const double h : {0.01, 0.005}) {
        auto problem = cases::make(name, {{"xi1", xi1}});
        auto other = problem;
        other.problem.start.v.setZero();
        Files files{problem};
        files.add(run("rk4", other.problem, h), h);
        const auto causes = file_causes(files.question());
        ASSERT_EQ(codes(causes), "starts-at-rest") << name << xi1;
      }
}

}  // namespace
}  // namespace clackers::diagnose
