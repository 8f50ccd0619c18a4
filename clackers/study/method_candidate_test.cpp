#include "clackers/study/method_candidate.hpp"

#include <gtest/gtest.h>
#include <time.h>

#include <cmath>
#include <functional>

#include "clackers/measure/metrics/metric.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/study/shared_runs.hpp"
#include "clackers/tables/testing/counted_motion.hpp"

namespace clackers::study {
namespace {

// A method whose runs deliver one state and then do what a test wants; it knows how often they ran.
class ScriptedMethod : public methods::Method {
 public:
  using Script = std::function<bool(int runs)>;
  explicit ScriptedMethod(Script script) : script_(std::move(script)) {}

  methods::Facts facts() const override { return {}; }
  std::optional<methods::Objection> objection(const model::ImpactProblem<>&) const override {
    return {};
  }
  std::unique_ptr<model::Run> prepare(const model::ImpactProblem<>&,
                                      const methods::Resolution&) const override {
    ++prepared;
    return std::make_unique<ScriptedRun>(script_);
  }

  std::string shared_run(const model::ImpactProblem<>&) const override { return shared; }

  mutable int prepared = 0;
  std::string shared;

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

// What a method claims on a case.
Claim claim_on(const char* method, const char* name, const cases::Settings& settings = {}) {
  const auto problem = study_case(cases::make(name, settings));
  return MethodCandidate(methods::method(method), problem, {}, {}).facts().subject.claim;
}

TEST(MethodCandidate, ClaimsWhatItsStepsAndEventsDo) {
  EXPECT_EQ(claim_on("newmark", "ball").behaviour, Behaviour::exact);
  EXPECT_EQ(claim_on("dissipative-newmark", "ball").behaviour, Behaviour::exact);
  EXPECT_EQ(claim_on("cr", "ball").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_on("cr", "billiard").behaviour, Behaviour::exact);
  EXPECT_EQ(claim_on("paoli-schatzman", "billiard").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_on("paoli-schatzman", "ball").behaviour, Behaviour::irregular);
  EXPECT_EQ(claim_on("paoli-schatzman", "piecewise").behaviour, Behaviour::irregular);
  EXPECT_EQ(claim_on("paoli-schatzman", "stop").behaviour, Behaviour::proper);
  // With eta = 0: held at rest and in motion, torn open by it, and without contacts.
  const cases::Settings plastic{{"eta", 0.0}};
  EXPECT_EQ(claim_on("paoli-schatzman", "stop", plastic).order, 2.0);
  EXPECT_EQ(claim_on("forward-increment-lagrange", "row", plastic).order, 2.0);
  EXPECT_EQ(claim_on("paoli-schatzman", "pressed-oscillator", plastic).behaviour,
            Behaviour::proper);
  EXPECT_EQ(claim_on("paoli-schatzman", "synchronized-pair", {{"X", 3.0}, {"r", 0.5}, {"eta", 0.0}})
                .order,
            2.0);
  const auto torn = claim_on("paoli-schatzman", "two-bars",
                             {{"elements", 8.0}, {"mass", std::string("lumped")}, {"eta", 0.0}});
  EXPECT_EQ(torn.behaviour, Behaviour::irregular);
  EXPECT_EQ(torn.order, 1.0);
  EXPECT_EQ(claim_on("paoli-schatzman", "circle-billiard").order, 1.0);
  EXPECT_EQ(claim_on("explicit-generalized-alpha", "pressed-oscillator").behaviour,
            Behaviour::irregular);
  EXPECT_EQ(claim_on("explicit-generalized-alpha", "pendulum").behaviour, Behaviour::irregular);
  EXPECT_EQ(claim_on("explicit-generalized-alpha", "ball").behaviour, Behaviour::exact);
  EXPECT_EQ(claim_on("explicit-generalized-alpha", "stop").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_on("newmark+reversal", "ball").behaviour, Behaviour::irregular);
  EXPECT_EQ(claim_on("exponential", "pressed-oscillator").behaviour, Behaviour::exact);
  EXPECT_EQ(claim_on("exponential", "belt").behaviour, Behaviour::exact);
  EXPECT_EQ(claim_on("precise-integration", "belt").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_on("exponential", "forced-pair").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_on("newmark", "pendulum").behaviour, Behaviour::proper);
  // It lands without an impact.
  EXPECT_EQ(claim_on("newmark+reversal", "plastic-pair").behaviour, Behaviour::irregular);
}

// Of the 16 impacts, which accumulate, a contact of 0.03 s resolves few. Score and metrics count alike.
TEST(MethodCandidate, ExpectsOfACompliantContactTheImpactsThatItResolves) {
  const auto problem = study_case(cases::make("pressed-oscillator", {}));
  MethodCandidate candidate(methods::method("newmark+penalty:law=kelvin-voigt"), problem, {}, {});
  const long long steps = 20480;
  ProgressMeter meter(1.0, {});
  TaskShare share(meter, 1.0);
  const auto result =
      candidate.run({{20.0 / double(steps), steps, 0.0}, {.metrics = true}}, share, nullptr);
  ASSERT_TRUE(result && result->run.score.impacts);
  const auto& impacts = *result->run.score.impacts;
  EXPECT_GE(impacts.matched, 2);
  EXPECT_LE(impacts.matched, 6);
  EXPECT_EQ(impacts.missed, 0);
  EXPECT_EQ(impacts.extra, 0);
  for (const auto& metric : result->run.metrics)
    if (metric.name == "impact-missed-count" || metric.name == "impact-extra-count") {
      EXPECT_EQ(metric.value, 0.0) << metric.name;
    }
}

// Of this thread [s].
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

class RunsOfMethods : public testing::Test {
 protected:
  std::optional<Measured> assessed(ScriptedMethod::Script script, bool metrics = false) {
    method_ = std::make_shared<ScriptedMethod>(std::move(script));
    study_ = {};
    study_.problem.motion = std::make_shared<tables::CountedMotion>(1, 8.0, std::vector<double>{});
    auto& problem = study_.problem.problem;
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(1, 1);
    problem.system = {unit, unit, unit};
    problem.start = {0.0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
    problem.end = 8.0;
    ProgressMeter meter(1.0, {});
    TaskShare share(meter, 1.0);
    MethodCandidate candidate(method_, study_, {}, {});
    return candidate.run({{4.0, 2, 0.0}, {.metrics = metrics}}, share, &interrupt_);
  }

  StudyCase study_;
  std::shared_ptr<ScriptedMethod> method_;
  std::atomic<bool> interrupt_ = false;
};

TEST_F(RunsOfMethods, AreTimedUntilTheClockResolvesThem) {
  int runs = 0;
  const auto result = assessed([&](int count) {
    runs = count;
    const double start = processor_time();
    while (processor_time() < start + 2e-5) {
    }
    return true;
  });
  ASSERT_TRUE(result.has_value());
  // One with errors; the others together fill a tenth of a millisecond, so that each counts for less.
  EXPECT_GE(runs, 3);
  EXPECT_GE(result->run.score.seconds, 2e-5);
  EXPECT_LT(result->run.score.seconds, 1e-3);
}

TEST_F(RunsOfMethods, AreNotTimedWhenTheyFailed) {
  int runs = 0;
  const auto result = assessed([&](int count) {
    runs = count;
    return false;
  });
  ASSERT_TRUE(result.has_value());
  EXPECT_FALSE(result->run.score.finished);
  EXPECT_EQ(result->run.score.seconds, 0.0);
  EXPECT_EQ(runs, 1);
}

TEST_F(RunsOfMethods, HoldWhereTheyEndedOverTheInitialEnvelope) {
  // The envelope of the toy's mass 1 is 4 m.
  EXPECT_EQ(assessed([](int) { return true; })->end_u, (std::vector<double>{0.75}));
  EXPECT_TRUE(assessed([](int) { return false; })->end_u.empty());
}

TEST_F(RunsOfMethods, AreMeasuredByAllMetricsWhereThatIsAskedFor) {
  const auto result = assessed([](int) { return true; }, true);
  ASSERT_EQ(result->run.metrics.size(), measure::metrics().size());
  EXPECT_EQ(result->run.metrics[0].name, "u-max");
  EXPECT_EQ(result->run.metrics[0].value, 1.0);  // 3 m where the reference is at 4 m
  EXPECT_EQ(result->run.metrics[0].masses, (std::vector<double>{1.0}));
  EXPECT_EQ(result->run.metrics[0].unit, "m");
  for (std::size_t i = 0; i < result->run.metrics.size(); ++i) {
    const auto& metric = result->run.metrics[i];
    EXPECT_EQ(metric.across_jumps, measure::metrics()[i].across_jumps);
    EXPECT_EQ(std::isnan(metric.value), !metric.reason.empty()) << metric.name;
  }
  EXPECT_TRUE(assessed([](int) { return true; }, false)->run.metrics.empty());
  EXPECT_TRUE(assessed([](int) { return false; }, true)->run.metrics.empty());
}

TEST_F(RunsOfMethods, AreMeasuredOnceWhereMethodsShareThem) {
  (void)assessed([](int) { return true; });
  study_.runs = std::make_shared<SharedRuns>();
  const auto prepared = [&](const char* shared, bool times, bool metrics) {
    method_ = std::make_shared<ScriptedMethod>([](int) { return true; });
    method_->shared = shared;
    MethodCandidate candidate(method_, study_, {}, {.times = times});
    ProgressMeter meter(1.0, {});
    TaskShare share(meter, 1.0);
    const auto result = candidate.run({{4.0, 2, 0.0}, {.metrics = metrics}}, share, nullptr);
    EXPECT_EQ(result->end_u, (std::vector<double>{0.75}));
    EXPECT_EQ(result->run.metrics.empty(), !metrics);
    EXPECT_GT(result->run.score.seconds, 0.0);
    return method_->prepared;
  };
  EXPECT_EQ(prepared("a", false, false), 1);
  EXPECT_EQ(prepared("a", false, false), 0);
  EXPECT_EQ(prepared("a", false, true), 1) << "more is wanted of this one";
  EXPECT_EQ(prepared("b", false, false), 1);
  for (int twice = 0; twice < 2; ++twice) EXPECT_EQ(prepared("", false, false), 1);
  EXPECT_EQ(prepared("a", true, false), 1) << "for its own time";
}

TEST_F(RunsOfMethods, CostMoreWhereMetricsAreMeasured) {
  method_ = std::make_shared<ScriptedMethod>([](int) { return true; });
  study_.problem.motion = std::make_shared<tables::CountedMotion>(1, 8.0, std::vector<double>{});
  const MethodCandidate candidate(method_, study_, {}, {});
  EXPECT_GT(candidate.cost({{0.1, 100, 0.0}, {.metrics = true}}),
            candidate.cost({{0.1, 100, 0.0}}));
}

TEST_F(RunsOfMethods, AreNothingWhenInterruptedInEitherRun) {
  for (const int when : {1, 2}) {
    interrupt_ = false;
    EXPECT_FALSE(assessed([&](int count) {
      interrupt_ = count == when;
      return true;
    }));
  }
}

TEST_F(RunsOfMethods, AreNotEvenPreparedAfterAnInterrupt) {
  interrupt_ = true;
  EXPECT_FALSE(assessed([](int) { return true; }));
  EXPECT_EQ(method_->prepared, 0);
}

}  // namespace
}  // namespace clackers::study
