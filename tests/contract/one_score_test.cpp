// One history has one score, whether it is measured while a method runs, from stored rows, as a file, or
// as the output of a callable.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "clackers/cases/case.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/solvers/solver.hpp"
#include "clackers/study/check.hpp"
#include "clackers/study/verify.hpp"

namespace clackers {
namespace {

const char* const dozen[] = {"newmark",
                             "rk4",
                             "generalized-alpha:rho=0.8",
                             "central-difference",
                             "velocity-verlet",
                             "hht-alpha",
                             "newmark+reversal",
                             "rk4+reversal",
                             "newmark+penalty",
                             "rk4+penalty",
                             "moreau-jean",
                             "houbolt"};

// The reference is sampled in other blocks, which changes its last digits; errors above 1 are of
// runs that diverge, and their rounding is relative to them.
void expect_equal(double found, double expected, const std::string& where) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(found)) << where;
    return;
  }
  EXPECT_NEAR(found, expected, 1e-12 * std::max(1.0, std::abs(expected))) << where;
}

void expect_equal(const measure::RunScore& found, const measure::RunScore& expected,
                  const std::string& where) {
  expect_equal(found.u_error, expected.u_error, where + ": u_error");
  expect_equal(found.u_error_absolute, expected.u_error_absolute, where + ": u_error_absolute");
  expect_equal(found.v_error, expected.v_error, where + ": v_error");
  expect_equal(found.energy_error, expected.energy_error, where + ": energy_error");
  expect_equal(found.energy_ratio, expected.energy_ratio, where + ": energy_ratio");
  EXPECT_EQ(found.rounding_floor, expected.rounding_floor) << where;
  ASSERT_EQ(found.impacts.has_value(), expected.impacts.has_value()) << where;
  if (!found.impacts) return;
  EXPECT_EQ(found.impacts->expected, expected.impacts->expected) << where;
  EXPECT_EQ(found.impacts->found, expected.impacts->found) << where;
  EXPECT_EQ(found.impacts->matched, expected.impacts->matched) << where;
  EXPECT_EQ(found.impacts->extra, expected.impacts->extra) << where;
  expect_equal(found.impacts->worst_time_error, expected.impacts->worst_time_error,
               where + ": worst_time_error");
}

// 40 steps a fast period, at most 3,000, and at least 16 between impacts of a contact: Comparison takes
// rows that are further apart for a part of the run's states.
double step_of(const cases::Case& test_case) {
  const auto& periods = test_case.damped_periods;
  const double end = test_case.problem.end;
  double step = periods.empty() ? end / 1000.0 : *std::ranges::min_element(periods) / 40.0;
  step = std::max(step, end / 3000.0);
  const auto impacts = test_case.motion->impact_count(test_case.motion->end());
  if (impacts > 0)
    step = std::min(step,
                    end * double(std::ssize(test_case.problem.contacts)) / double(impacts) / 16.5);
  return end / std::ceil(end / step);
}

TEST(OneScore, IsThatOfTheRunAndOfItsStoredRows) {
  int compared = 0;
  for (const auto& entry : cases::entries()) {
    const auto test_case = cases::make(entry.name);
    const double h = step_of(test_case);
    for (const auto* name : dozen) {
      const auto method = methods::method(name);
      if (method->objection(test_case.problem)) continue;
      measure::ErrorSink sink(*test_case.motion, test_case.problem, h);
      const auto run = method->prepare(test_case.problem, h);
      const auto outcome = run->advance(sink);
      const auto expected = sink.score(outcome);
      if (!outcome.finished || !std::isfinite(expected.u_error)) continue;
      const bool reports = method->facts().reports_impacts;
      model::TrajectorySink stored(reports);
      run->advance(stored);
      const measure::Comparison comparison(stored.trajectory(), *test_case.motion,
                                           test_case.problem);
      auto found = comparison.score(h);
      if (!reports) found.impacts = expected.impacts;  // searched for in the rows
      expect_equal(found, expected, entry.name + ", " + name);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

// A run of a method as columns in memory.
struct Columns {
  model::TrajectorySink run{true};
  std::vector<double> times, impulses, before, after;
  input::NumberColumns history, events;

  Columns(const methods::Method& method, const cases::Case& test_case, double step) {
    method.prepare(test_case.problem, step)->advance(run);
    const auto& rows = run.trajectory();
    const auto dof = std::size_t(rows.dof);
    history = {"run", rows.t.size(), {{"t", rows.t.data()}}};
    for (const auto& impact : *rows.impacts) {
      times.push_back(impact.t);
      impulses.push_back(impact.impulse);
      before.insert(before.end(), impact.v_before.begin(), impact.v_before.end());
      after.insert(after.end(), impact.v_after.begin(), impact.v_after.end());
    }
    events = {"impacts", times.size(), {{"t", times.data()}, {"impulse", impulses.data()}}};
    const auto add = [dof](input::NumberColumns& to, std::string name, const double* first) {
      to.columns.push_back({std::move(name), first, std::ptrdiff_t(dof)});
    };
    for (std::size_t j = 0; j < dof; ++j) {
      const auto mass = std::to_string(j + 1);
      add(history, "u" + mass, rows.u.data() + j);
      add(history, "v" + mass, rows.v.data() + j);
      add(events, "v" + mass + "-", before.data() + j);
      add(events, "v" + mass + "+", after.data() + j);
    }
  }
};

struct Callable : solvers::Solver {
  Callable(std::string method_name, cases::Case made)
      : name(std::move(method_name)), test_case(std::move(made)) {}
  solvers::SolverOutput run(const solvers::SolverRun& run, const std::atomic<bool>*) override {
    const auto columns =
        std::make_shared<const Columns>(*methods::method(name), test_case, run.step);
    solvers::SolverOutput output;
    output.history = columns->history;
    output.events = columns->events;
    output.memory = columns;
    return output;
  }
  std::string name;
  cases::Case test_case;
};

const record::Run& only_run(const record::Subject& subject) {
  return subject.levels.at(0).runs.at(0);
}

TEST(OneScore, IsThatOfTheMethodTheCallableAndTheFile) {
  for (const auto* case_name : {"three-parameter", "forced-pair", "cradle"})
    for (const auto* name : {"rk4", "newmark+reversal", "moreau-jean"}) {
      const auto test_case = cases::make(case_name);
      const auto where = std::string(case_name) + ", " + name;
      study::VerifyRequest request;
      request.methods = {name};
      request.cases = {case_name};
      request.plan = {.coarsest = step_of(test_case), .levels = 1, .samples_per_level = 1};
      solvers::SolverSubject callable;
      callable.kind = record::SubjectKind::callable;
      callable.name = "callable";
      callable.prepare = [&](const cases::Case& made) {
        return std::make_unique<Callable>(name, made);
      };
      request.solvers = {callable};
      const auto verified = study::verify(request);
      const auto& subjects = verified.cases.at(0).subjects;
      const auto& expected = only_run(subjects.at(0)).score;
      expect_equal(only_run(subjects.at(1)).score, expected, where + ", callable");

      const Columns columns(*methods::method(name), test_case, expected.step);
      study::CheckRequest file;
      file.case_name = case_name;
      file.subjects[0].files = {columns.history};
      file.events = {columns.events};
      file.steps = {expected.step};
      const auto checked = study::check(file);
      const auto& run = only_run(checked.cases.at(0).subjects.at(0));
      expect_equal(run.score, expected, where + ", file");
      for (const auto& [metric, value] : {std::pair{"u-max-relative", expected.u_error},
                                          {"v-l1-relative", expected.v_error},
                                          {"energy-max-relative", expected.energy_error}}) {
        const auto found = std::ranges::find(run.metrics, metric, &record::MetricResult::name);
        ASSERT_NE(found, run.metrics.end()) << metric;
        expect_equal(found->value, value, where + ", " + metric);
      }
    }
}

}  // namespace
}  // namespace clackers
