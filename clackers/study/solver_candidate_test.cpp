#include "clackers/study/solver_candidate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

// Keeps the runs that it was asked for; each fails.
struct FailingSolver : solvers::Solver {
  FailingSolver(std::vector<solvers::SolverRun>& kept, bool repeats)
      : runs(kept), would_repeat(repeats) {}
  solvers::SolverOutput run(const solvers::SolverRun& run, const std::atomic<bool>*) override {
    runs.push_back(run);
    solvers::SolverOutput output;
    output.failure_code = "program-failed";
    output.failure = "exit status 1.";
    output.printed = "no licence";
    output.would_repeat = would_repeat;
    return output;
  }
  std::vector<solvers::SolverRun>& runs;
  bool would_repeat;
};

class SolversUnderTest : public testing::Test {
 protected:
  SolversUnderTest() {
    request_.plan = {.coarsest = 0.1, .levels = 3, .samples_per_level = 2};
    request_.jobs = 1;
    subject_.name = "mine";
    subject_.prepare = [this](const cases::Case&) {
      return std::make_unique<FailingSolver>(runs_, would_repeat_);
    };
  }
  record::Record verify_one() {
    request_.solvers = {subject_};
    return verify(request_);
  }

  std::vector<solvers::SolverRun> runs_;
  bool would_repeat_ = false;
  VerifyRequest request_;
  solvers::SolverSubject subject_;
};

TEST_F(SolversUnderTest, AreRunWithTheStepsOfThePlan) {
  const auto record = verify_one();
  ASSERT_EQ(runs_.size(), 6u);
  for (const auto& run : runs_) {
    EXPECT_NEAR(run.step * double(run.steps), record.cases[0].problem.end, 1e-12);
    EXPECT_EQ(run.tolerance, 0.0);
  }
  EXPECT_EQ(record.cases[0].plan.levels, 3);
}

TEST_F(SolversUnderTest, AreRunWithTheirOwnSteps) {
  subject_.steps = {0.1, 0.03, 0.01};
  const auto record = verify_one();
  ASSERT_EQ(runs_.size(), 3u);
  EXPECT_EQ(runs_[0].step, 0.1);
  EXPECT_EQ(runs_[0].steps, 200);  // 20 s
  EXPECT_EQ(runs_[1].steps, 667);  // beyond the end by a part of a step
  EXPECT_EQ(record.cases[0].plan.levels, 0);
}

TEST_F(SolversUnderTest, AreRunWithTheirTolerances) {
  subject_.tolerances = {1e-3, 1e-6};
  const auto record = verify_one();
  ASSERT_EQ(runs_.size(), 2u);
  EXPECT_EQ(runs_[1].tolerance, 1e-6);
  EXPECT_EQ(runs_[0].step, runs_[1].step);
  EXPECT_EQ(record.cases[0].subjects[0].refined_by, record::RefinementParameter::tolerance);
}

TEST_F(SolversUnderTest, KeepTheFailuresOfTheirRuns) {
  const auto record = verify_one();
  const auto& subject = record.cases[0].subjects[0];
  EXPECT_EQ(subject.name, "mine");
  EXPECT_EQ(subject.kind, record::SubjectKind::program);
  ASSERT_FALSE(subject.levels.empty());
  const auto& run = subject.levels[0].runs[0];
  EXPECT_EQ(run.score.failure_code, "program-failed");
  EXPECT_EQ(run.printed, "no licence");
  EXPECT_EQ(record::failed_solvers(record).at(0).first->score.failure, "exit status 1.");
}

TEST_F(SolversUnderTest, AreNotRunFurtherAfterThreeFailuresThatSmallerStepsShare) {
  would_repeat_ = true;
  const auto record = verify_one();
  EXPECT_EQ(runs_.size(), 3u);
  const auto& last = record.cases[0].subjects[0].levels.back().runs.back();
  EXPECT_EQ(last.score.failure, "not made after 3 runs in a row: exit status 1.");
}

TEST_F(SolversUnderTest, AreRunFurtherWhereAnotherFailureStandsBetween) {
  struct EverySecond : FailingSolver {
    using FailingSolver::FailingSolver;
    solvers::SolverOutput run(const solvers::SolverRun& run,
                              const std::atomic<bool>* interrupt) override {
      would_repeat = runs.size() % 2 == 0;
      return FailingSolver::run(run, interrupt);
    }
  };
  subject_.prepare = [this](const cases::Case&) {
    return std::make_unique<EverySecond>(runs_, true);
  };
  verify_one();
  EXPECT_EQ(runs_.size(), 6u);
}

TEST_F(SolversUnderTest, AreRefusedWithTwoOfOneName) {
  request_.solvers = {subject_, subject_};
  EXPECT_REFUSED(verify(request_), "bad-syntax", "mine");
  request_.methods = {"rk4"};
  subject_.name = "rk4";
  EXPECT_REFUSED(verify_one(), "bad-syntax", "rk4");
}

TEST_F(SolversUnderTest, AreRefusedWithStepsThatDoNotDescend) {
  subject_.steps = {0.01, 0.02};
  EXPECT_REFUSED(verify_one(), "not-sorted", "steps");
  subject_.steps = {0.02, 0.02};
  EXPECT_REFUSED(verify_one(), "not-sorted", "steps");
  subject_.steps = {0.02, 0.0};
  EXPECT_REFUSED(verify_one(), "step-not-positive", "h = 0");
  EXPECT_TRUE(runs_.empty());
}

// The reference itself, in memory that lives as long as the output says.
struct ExactSolver : solvers::Solver {
  explicit ExactSolver(const cases::Case& problem) : motion(problem.motion) {}
  solvers::SolverOutput run(const solvers::SolverRun& run, const std::atomic<bool>*) override {
    auto numbers = std::make_shared<std::vector<double>>();
    for (long long i = 0; i <= run.steps; ++i) {
      const double t = std::min(double(i) * run.step, motion->end());
      const auto now = motion->at(t, model::Side::right);
      numbers->insert(numbers->end(), {t, now.u[0], now.u[1]});
    }
    input::NumberColumns columns{"mine", numbers->size() / 3, {}};
    for (std::size_t c = 0; c < 3; ++c)
      columns.columns.push_back({c == 0 ? "t" : c == 1 ? "u1" : "u2", numbers->data() + c, 3});
    solvers::SolverOutput output;
    output.history = columns;
    output.events = input::NumberColumns{"its impacts", 0, {{"t"}}};
    output.memory = numbers;
    return output;
  }
  std::shared_ptr<const model::Motion> motion;
};

TEST_F(SolversUnderTest, AreReadFromMemory) {
  subject_.kind = record::SubjectKind::callable;
  subject_.prepare = [](const cases::Case& problem) {
    return std::make_unique<ExactSolver>(problem);
  };
  subject_.steps = {0.1, 0.01};
  const auto record = verify_one();
  ASSERT_EQ(record.cases[0].subjects[0].levels.size(), 2u);
  for (const auto& level : record.cases[0].subjects[0].levels) {
    EXPECT_TRUE(level.runs[0].score.finished) << level.runs[0].score.failure;
    EXPECT_LT(level.runs[0].score.u_error, 1e-14);
    EXPECT_EQ(level.runs[0].score.impacts->found, 0) << "as its events say";
    EXPECT_EQ(level.runs[0].file->file, "mine");
  }
}

TEST_F(SolversUnderTest, TakeEachCaseWithItsOwnSettings) {
  request_.cases = {"stop", "three-parameter"};
  request_.case_settings = {{{"eta", 0.5}}, {{"N", 3.0}}};
  const auto record = verify_one();
  ASSERT_EQ(record.cases.size(), 2u);
  const auto value = [&](std::size_t at, const char* name) {
    for (const auto& parameter : record.cases[at].problem.parameters)
      if (parameter.name == name) return parameter.value;
    return 0.0;
  };
  EXPECT_EQ(value(0, "eta"), 0.5);
  EXPECT_EQ(value(1, "N"), 3.0);
}

// The rows of a method of the catalogue, as a program with the same steps would print them.
struct RowsOfMethod : solvers::Solver {
  RowsOfMethod(const char* specification, const cases::Case& studied)
      : method(methods::method(specification)), problem(studied.problem) {}
  solvers::SolverOutput run(const solvers::SolverRun& run, const std::atomic<bool>*) override {
    auto rows = std::make_shared<model::TrajectorySink>(false);
    method->prepare(problem, methods::Resolution(run.step))->advance(*rows);
    const auto& motion = rows->trajectory();
    input::NumberColumns columns{"twin", motion.t.size(), {{"t", motion.t.data(), 1}}};
    for (int i = 0; i < motion.dof; ++i) {
      columns.columns.push_back({fmt::format("u{}", i + 1), motion.u.data() + i, motion.dof});
      columns.columns.push_back({fmt::format("v{}", i + 1), motion.v.data() + i, motion.dof});
    }
    solvers::SolverOutput output;
    output.history = columns;
    output.memory = rows;
    return output;
  }
  std::shared_ptr<const methods::Method> method;
  model::ImpactProblem<> problem;
};

TEST_F(SolversUnderTest, AreToldTheCauseThatTheSameMethodIsTold) {
  subject_.kind = record::SubjectKind::callable;
  subject_.prepare = [](const cases::Case& problem) {
    return std::make_unique<RowsOfMethod>("newmark+reversal", problem);
  };
  request_.methods = {"newmark+reversal", "rk4"};
  request_.plan = {.coarsest = 0.05, .levels = 6, .samples_per_level = 4};
  const auto record = verify_one();
  const auto& subjects = record.cases[0].subjects;
  ASSERT_EQ(subjects.size(), 3u);
  for (const auto i : {0u, 2u}) {
    ASSERT_FALSE(subjects[i].diagnoses.empty()) << subjects[i].name;
    EXPECT_EQ(subjects[i].diagnoses[0].code, "impact-at-step-end") << subjects[i].name;
  }
  EXPECT_TRUE(subjects[1].diagnoses.empty()) << subjects[1].diagnoses[0].code;
}

}  // namespace
}  // namespace clackers::study
