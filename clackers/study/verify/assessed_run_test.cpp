#include "clackers/study/verify/judged_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "clackers/assess/metrics/metric.hpp"
#include "clackers/study/cause_metrics.hpp"
#include "clackers/study/testing/toy_motion.hpp"
#include "clackers/study/verify/processor_time.hpp"

namespace clackers::study {
namespace {

// A method whose runs deliver one state and then do what a test wants, told how often they ran.
class ScriptedMethod : public methods::Method {
 public:
  using Script = std::function<bool(int runs)>;
  explicit ScriptedMethod(Script script) : script_(std::move(script)) {}

  methods::Facts facts() const override { return {}; }
  std::optional<methods::Objection> objection(const model::ImpactProblem<>&) const override {
    return {};
  }
  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>&, double) const override {
    ++prepared;
    return std::make_unique<ScriptedRun>(script_);
  }

  mutable int prepared = 0;

 private:
  class ScriptedRun : public model::Run {
   public:
    explicit ScriptedRun(const Script& script) : script_(script) {}
    model::Outcome advance(model::Sink& sink) override {
      const std::vector<double> times{0.0, 4.0}, u{0.0, 3.0}, ones{1.0, 1.0};
      const bool goes_well = script_(++runs_);
      model::Outcome outcome;
      outcome.finished = goes_well;
      if (!sink.take(model::SampleBlock{1, times, u, ones})) {
        outcome.finished = false;
        outcome.stopped_by_sink = true;
      }
      return outcome;
    }

   private:
    const Script& script_;
    int runs_ = 0;
  };

  Script script_;
};

class JudgedRuns : public testing::Test {
 protected:
  std::optional<JudgedRun> judge(ScriptedMethod::Script script, bool metrics = false) {
    method_ = std::make_shared<ScriptedMethod>(std::move(script));
    VerifyPlan plan;
    plan.problem.motion = std::make_shared<ToyMotion>(1, 8.0, std::vector<double>{});
    auto& problem = plan.problem.problem;
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(1, 1);
    problem.system = {unit, unit, unit};
    problem.start = {0.0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
    problem.end = 8.0;
    plan.methods.emplace_back();
    plan.methods[0].method = method_;
    ProgressMeter meter(1.0, {});
    TaskShare share(meter, 1.0);
    return judge_run(plan, {0, 0, 0, 4.0, 2, 0, metrics}, share, &interrupt_);
  }

  std::shared_ptr<ScriptedMethod> method_;
  std::atomic<bool> interrupt_ = false;
};

TEST_F(JudgedRuns, AreTimedUntilTheClockCanTell) {
  int runs = 0;
  const auto result = judge([&](int count) {
    runs = count;
    const double start = thread_processor_time();
    while (thread_processor_time() < start + 2e-4) {
    }
    return true;
  });
  ASSERT_TRUE(result.has_value());
  // One under judgement; the others together fill a millisecond, so that each counts for less.
  EXPECT_GE(runs, 3);
  EXPECT_GE(result->score.seconds, 2e-4);
  EXPECT_LT(result->score.seconds, 1e-3);
}

TEST_F(JudgedRuns, AreNotTimedWhenTheyFailed) {
  int runs = 0;
  const auto result = judge([&](int count) {
    runs = count;
    return false;
  });
  ASSERT_TRUE(result.has_value());
  EXPECT_FALSE(result->score.finished);
  EXPECT_EQ(result->score.seconds, 0.0);
  EXPECT_EQ(runs, 1);
}

TEST_F(JudgedRuns, TellWhereTheyEndedOverTheInitialEnvelope) {
  // The envelope of the toy's mass 1 is 4 m.
  EXPECT_EQ(judge([](int) { return true; })->end_u, (std::vector<double>{0.75}));
  EXPECT_TRUE(judge([](int) { return false; })->end_u.empty());
}

TEST_F(JudgedRuns, AreMeasuredByAllMetricsWhereThatIsAskedFor) {
  const auto result = judge([](int) { return true; }, true);
  const auto of_history = assess::metrics().size();
  ASSERT_EQ(result->metrics.size(), of_history + cause_metrics().size());
  EXPECT_EQ(result->metrics[0].name, "u-max");
  EXPECT_EQ(result->metrics[0].value, 1.0);  // 3 m where the reference is at 4 m
  EXPECT_EQ(result->metrics[0].masses, (std::vector<double>{1.0}));
  EXPECT_EQ(result->metrics[0].unit, "m");
  for (std::size_t i = 0; i < result->metrics.size(); ++i) {
    const auto& metric = result->metrics[i];
    EXPECT_EQ(metric.across_jumps, i >= of_history || assess::metrics()[i].across_jumps);
    EXPECT_EQ(std::isnan(metric.value), !metric.reason.empty()) << metric.name;
  }
  EXPECT_TRUE(judge([](int) { return true; }, false)->metrics.empty());
  EXPECT_TRUE(judge([](int) { return false; }, true)->metrics.empty());
}

TEST_F(JudgedRuns, CostMoreWhereMetricsAreMeasured) {
  RunTask task{0, 0, 0, 0.1, 100, 0, false};
  const double plain = task.cost();
  task.metrics = true;
  EXPECT_GT(task.cost(), plain);
}

TEST_F(JudgedRuns, AreNothingWhenInterruptedUnderJudgementOrWhileTimed) {
  for (const int when : {1, 2}) {
    interrupt_ = false;
    EXPECT_FALSE(judge([&](int count) {
      interrupt_ = count == when;
      return true;
    }));
  }
}

TEST_F(JudgedRuns, AreNotEvenPreparedAfterAnInterrupt) {
  interrupt_ = true;
  EXPECT_FALSE(judge([](int) { return true; }));
  EXPECT_EQ(method_->prepared, 0);
}

}  // namespace
}  // namespace clackers::study
