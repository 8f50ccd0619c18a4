#include "clackers/measure/errors/error_sink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

// A run in the making: the true states at 0, h, 2 h, ..., to be spoiled and then delivered in
// blocks.
struct History {
  std::vector<double> t, u, v;

  History(const ToyMotion& reference, double h, int steps) {
    for (int i = 0; i <= steps; ++i) {
      t.push_back(i * h);
      const auto now = reference.at(std::min(i * h, reference.end()), model::Side::right);
      for (const double x : now.u) u.push_back(x);
      for (const double x : now.v) v.push_back(x);
    }
  }
  bool deliver(ErrorSink& sink, std::size_t block = 1000) const {
    for (std::size_t from = 0; from < t.size(); from += block) {
      const auto count = std::min(block, t.size() - from);
      if (!sink.take(model::SampleBlock{2,
                                        {t.data() + from, count},
                                        {u.data() + 2 * from, 2 * count},
                                        {v.data() + 2 * from, 2 * count}}))
        return false;
    }
    return true;
  }
};

model::Outcome finished() { return {}; }

TEST(ErrorSink, TheReferenceScoresNothing) {
  const ToyMotion reference;
  ErrorSink sink(reference, toy_problem(), 0.1);
  EXPECT_TRUE(History(reference, 0.1, 200).deliver(sink));
  const auto score = sink.score(finished());
  EXPECT_EQ(score.step, 0.1);
  EXPECT_TRUE(score.finished);
  EXPECT_EQ(score.u_error, 0.0);
  EXPECT_EQ(score.u_error_absolute, 0.0);
  EXPECT_EQ(score.v_error, 0.0);
  EXPECT_EQ(score.energy_error, 0.0);
  EXPECT_EQ(score.energy_ratio, 1.0);
  EXPECT_EQ(score.rounding_floor, 201 * 0x1p-52);
  EXPECT_EQ(score.seconds, 0.0);
}

TEST(ErrorSink, TheReferenceAtAnImpactIsItsRightLimit) {
  const ToyMotion reference(4.0, {1.5});
  ErrorSink sink(reference, toy_problem(4.0), 0.1);
  History(reference, 0.1, 40).deliver(sink);  // 15 * 0.1 is 1.5
  EXPECT_EQ(sink.score(finished()).v_error, 0.0);
}

TEST(ErrorSink, AsksForTheReferenceABlockAtATime) {
  const ToyMotion reference;
  ErrorSink sink(reference, toy_problem(), 0.01);
  const History history(reference, 0.01, 1999);
  reference.samples = 0;
  history.deliver(sink, 2000);
  EXPECT_EQ(reference.samples, 8);  // 2000 / 256, rounded up
}

TEST(ErrorSink, TheScoreDoesNotDependOnHowTheRunIsCutIntoBlocks) {
  const ToyMotion reference;
  History history(reference, 0.02, 1000);
  for (std::size_t i = 0; i < history.u.size(); ++i) {
    history.u[i] += 1e-3 * std::sin(double(i));
    history.v[i] += 1e-3 * std::cos(double(i));
  }
  ErrorSink whole(reference, toy_problem(), 0.02), cut(reference, toy_problem(), 0.02);
  history.deliver(whole, 2000);
  history.deliver(cut, 7);
  const auto one = whole.score(finished()), other = cut.score(finished());
  EXPECT_EQ(one.u_error, other.u_error);
  EXPECT_NEAR(one.v_error, other.v_error, 1e-15 * one.v_error);  // sums in another order
  EXPECT_EQ(one.energy_error, other.energy_error);
  EXPECT_EQ(one.rounding_floor, other.rounding_floor);
}

TEST(ErrorSink, DisplacementIsRelativeToTheEnvelopeOfEachMass) {
  const ToyMotion reference;
  History history(reference, 0.1, 200);
  history.u[2 * 50] += 0.03;       // mass 1, envelope 1
  history.u[2 * 120 + 1] -= 0.02;  // mass 2, envelope 1/2
  ErrorSink sink(reference, toy_problem(), 0.1);
  history.deliver(sink);
  const auto score = sink.score(finished());
  EXPECT_NEAR(score.u_error, 0.04, 1e-14);
  EXPECT_NEAR(score.u_error_absolute, 0.03, 1e-14);
}

TEST(ErrorSink, VelocityIsTheMeanOverTheRunRelativeToTheEnvelope) {
  const ToyMotion reference;
  History history(reference, 0.1, 200);
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    history.v[2 * i] += 0.03;
    history.v[2 * i + 1] -= 0.02;
  }
  ErrorSink sink(reference, toy_problem(), 0.1);
  history.deliver(sink);
  EXPECT_NEAR(sink.score(finished()).v_error, 0.04, 1e-14);
}

TEST(ErrorSink, EnergyIsThatOfMassAndStiffnessRelativeToTheStart) {
  const ToyMotion reference;
  History history(reference, 0.1, 200);
  // Mass 1 alone faster by 0.5 at t = 5, the run slower by half in the end.
  const double v = history.v[100], v1 = history.v[400], v2 = history.v[401];
  history.v[100] += 0.5;
  history.v[400] *= 0.5;
  history.v[401] *= 0.5;
  ErrorSink sink(reference, toy_problem(), 0.1);
  history.deliver(sink);
  const double jolt = 0.5 * ((v + 0.5) * (v + 0.5) - v * v);
  const double lost = 0.75 * (0.5 * v1 * v1 + v2 * v2);
  EXPECT_NEAR(sink.score(finished()).energy_error, std::max(jolt, lost) / 0.75, 1e-14);
  EXPECT_NEAR(sink.score(finished()).energy_ratio, 1.0 - lost / 0.75, 1e-14);
}

TEST(ErrorSink, ImpactsAreMatchedAndTakePartInTheVelocity) {
  const ToyMotion reference(4.0);
  const History history(reference, 0.1, 40);
  ErrorSink sink(reference, toy_problem(4.0), 0.1);
  const double t = 0.5 * std::numbers::pi + 0.001;
  const std::vector<double> u{0.0, 0.0}, before{-1.0, 0.5}, after{1.0, -0.5};
  const auto part = [&](std::size_t from, std::size_t count) {
    sink.take(model::SampleBlock{2,
                                 {history.t.data() + from, count},
                                 {history.u.data() + 2 * from, 2 * count},
                                 {history.v.data() + 2 * from, 2 * count}});
  };
  part(0, 16);
  EXPECT_TRUE(sink.take(model::ReportedImpact{t, 0, u, before, after, 4.0 / 3.0}));
  part(16, 25);
  const auto score = sink.score(finished());
  ASSERT_TRUE(score.impacts.has_value());
  EXPECT_EQ(score.impacts->expected, 1);
  EXPECT_EQ(score.impacts->matched, 1);
  EXPECT_NEAR(score.impacts->worst_time_error, 0.001, 1e-14);
  EXPECT_GT(score.impacts->rounding_floor, 0.0);
  EXPECT_NEAR(score.v_error, 2.0 * 0.001 / 4.0, 1e-12);
}

// What follows begins with the velocity behind the impact, not with that of the state.
TEST(ErrorSink, AnImpactReportedBeforeTheStateAtItsTimeStandsForThatState) {
  const ToyMotion reference(4.0, {1.6});
  const History history(reference, 0.1, 40);
  double errors[2];
  for (const std::size_t block : {std::size_t{1}, std::size_t{100}}) {
    ErrorSink sink(reference, toy_problem(4.0), 0.1);
    const auto part = [&](std::size_t from, std::size_t until) {
      for (; from < until; from += block) {
        const auto count = std::min(block, until - from);
        sink.take(model::SampleBlock{2,
                                     {&history.t[from], count},
                                     {&history.u[2 * from], 2 * count},
                                     {&history.v[2 * from], 2 * count}});
      }
    };
    const std::vector<double> u{0.0, 0.0}, before{-1.0, 0.5}, after{3.0, -1.5};
    part(0, 16);
    sink.take(model::ReportedImpact{history.t[16], 0, u, before, after, 1.0});
    part(16, 41);
    errors[block == 1 ? 0 : 1] = sink.score(finished()).v_error;
  }
  EXPECT_GT(errors[0], 0.02);
  EXPECT_NEAR(errors[1], errors[0], 1e-15);
}

TEST(ErrorSink, AMotionThatRestsInContactCollidesOnce) {
  // Both masses stop at the first impact for ever.
  struct Stops : ToyMotion {
    Stops() : ToyMotion(20.0, {1.5}) {}
    void sample(std::span<const double> times, model::Side side,
                model::SampleBuffers out) const override {
      ToyMotion::sample(times, side, out);
      for (std::size_t i = 0; i < times.size(); ++i)
        if (times[i] > 1.5 || (times[i] == 1.5 && side == model::Side::right))
          for (const std::size_t j : {2 * i, 2 * i + 1}) out.u[j] = out.v[j] = 0.0;
    }
  };
  const Stops reference;
  ErrorSink sink(reference, toy_problem(), 0.1);
  const std::vector<double> zero{0.0, 0.0}, before{-1.0, 0.5};
  for (const double t : {1.51, 3.0, 7.0, 20.0})
    EXPECT_TRUE(sink.take(model::ReportedImpact{t, 0, zero, before, zero, 1.0}));
  const auto impacts = *sink.score(finished()).impacts;
  EXPECT_EQ(impacts.found, 1);
  EXPECT_EQ(impacts.extra, 0);
  EXPECT_THROW(sink.take(model::ReportedImpact{8.0, 1, zero, before, zero, 1.0}), InputError);
}

TEST(ErrorSink, WhatIsNotReportedIsNotCounted) {
  const ToyMotion reference;
  ErrorSink sink(reference, toy_problem(), 0.1, {.impacts_are_reported = false});
  History(reference, 0.1, 200).deliver(sink);
  EXPECT_FALSE(sink.score(finished()).impacts.has_value());
}

TEST(ErrorSink, AStateThatIsNotFiniteMakesTheErrorsInfinite) {
  const ToyMotion reference;
  for (const double bad : {double(NAN), double(INFINITY)})
    for (const bool in_u : {true, false}) {
      History history(reference, 0.1, 200);
      (in_u ? history.u : history.v)[101] = bad;
      ErrorSink sink(reference, toy_problem(), 0.1);
      history.deliver(sink);
      const auto score = sink.score(finished());
      EXPECT_EQ(score.u_error, HUGE_VAL);
      EXPECT_EQ(score.u_error_absolute, HUGE_VAL);
      EXPECT_EQ(score.v_error, HUGE_VAL);
      EXPECT_EQ(score.energy_error, HUGE_VAL);
    }
}

TEST(ErrorSink, HowTheRunEndedAndItsCostStandInTheScore) {
  const ToyMotion reference;
  ErrorSink sink(reference, toy_problem(), 0.1);
  History(reference, 0.1, 20).deliver(sink);
  model::Outcome outcome;
  outcome.finished = false;
  outcome.reason = "diverged";
  outcome.detail = "left the finite numbers at t = 2 s";
  outcome.work.steps = 20;
  const auto score = sink.score(outcome);
  EXPECT_FALSE(score.finished);
  EXPECT_EQ(score.failure_code, "diverged");
  EXPECT_EQ(score.failure, "left the finite numbers at t = 2 s");
  EXPECT_EQ(score.work.steps, 20);
  outcome.stopped_by_sink = true;
  EXPECT_EQ(sink.score(outcome).failure_code, "");
}

TEST(ErrorSink, TheLastTimeMayPassTheEndByRoundingAndNoFurther) {
  const ToyMotion reference;
  const double u[] = {1.0, -0.5}, v[] = {0.0, 0.0};
  const double beyond = std::nextafter(std::nextafter(20.0, 30.0), 30.0), outside = 20.0 + 1e-12;
  ErrorSink sink(reference, toy_problem(), 0.1);
  EXPECT_NO_THROW(sink.take(model::SampleBlock{2, {&beyond, 1}, u, v}));
  EXPECT_THROW(sink.take(model::SampleBlock{2, {&outside, 1}, u, v}), InputError);
}

TEST(ErrorSink, KeepsTheErrorAgainstTimeWhenAsked) {
  const ToyMotion reference;
  History history(reference, 0.1, 200);
  history.u[2 * 55] += 0.03;
  history.u[2 * 155 + 1] += 0.01;
  ErrorSink sink(reference, toy_problem(), 0.1, {.history_bins = 20});
  history.deliver(sink);
  EXPECT_EQ(sink.history().times().size(), 20u);
  EXPECT_NEAR(sink.history().largest(0)[5], 0.03, 1e-15);
  EXPECT_NEAR(sink.history().largest(1)[15], 0.02, 1e-15);
  EXPECT_EQ(sink.history().largest(1)[5], 0.0);
}

TEST(ErrorSink, RefusesAMotionWithoutAScale) {
  struct Still : ToyMotion {
    model::Kinematics envelope(double) const override {
      const Eigen::Vector2d some(1.0, 0.0);
      return {some, some, some};
    }
  };
  EXPECT_THROW(ErrorSink(Still(), toy_problem(), 0.1), InputError);
  auto weightless = toy_problem();
  weightless.system.stiffness.setZero();
  weightless.system.mass.setZero();
  EXPECT_THROW(ErrorSink(ToyMotion(), weightless, 0.1), InputError);
}

// Mass 2 starts without an envelope and has its largest one in the middle of the run.
class Rising : public ToyMotion {
 public:
  model::Kinematics envelope(double t) const override {
    const Eigen::Vector2d now(1.0, 4.0 * t * (end() - t) / (end() * end()));
    return {now, 3.0 * now, now};
  }
};

TEST(ErrorSink, ErrorsAreRelativeToTheLargestEnvelopeOfTheRun) {
  const Rising reference;
  EXPECT_EQ(reference.peak().u, Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(reference.peak().v, Eigen::Vector2d(3.0, 3.0));
  History history(reference, 0.1, 200);
  history.u[2 * 3 + 1] += 0.25;  // early, where the envelope is small
  ErrorSink sink(reference, toy_problem(), 0.1);
  history.deliver(sink);
  EXPECT_NEAR(sink.score(finished()).u_error, 0.25, 1e-15);
}

// The state at the start has 3/4 J; a load may bring more, a motion without one has no more.
TEST(ErrorSink, EnergyErrorsAreRelativeToTheLargestEnergyOfTheRun) {
  struct Growing : ToyMotion {
    void sample(std::span<const double> times, model::Side side,
                model::SampleBuffers out) const override {
      ToyMotion::sample(times, side, out);
      for (std::size_t i = 0; i < out.u.size(); ++i) {
        const double factor = 1.0 + times[i / 2] / end();
        out.u[i] *= factor;
        out.v[i] *= factor;
      }
    }
  };
  const Growing reference;
  auto loaded = toy_problem();
  loaded.system.add_load = [](double, std::span<double>) {};
  const double still[] = {0.0, 0.0}, t = 0.0;
  for (const auto& [problem, expected] : {std::pair{toy_problem(), 1.0}, {loaded, 0.25}}) {
    ErrorSink sink(reference, problem, 0.1);
    sink.take(model::SampleBlock{2, {&t, 1}, still, still});
    EXPECT_NEAR(sink.score(finished()).energy_error, expected, 1e-14);
  }
}

TEST(ErrorSink, FloorIsTheBoundOfTheReferenceWhereThatIsLarger) {
  struct Rough : ToyMotion {
    model::Kinematics error_bound(double t) const override {
      const Eigen::Vector2d bound(1e-9 * t, 0.0);
      return {bound, bound, bound};
    }
  };
  const Rough reference;
  ErrorSink sink(reference, toy_problem(), 0.1);
  History(reference, 0.1, 200).deliver(sink);
  const auto score = sink.score({});
  EXPECT_DOUBLE_EQ(score.rounding_floor, 2e-8);
  EXPECT_GT(score.impacts->rounding_floor, 2e-9);  // 20 s and 6 impacts: 2e-8 * 20/6 / pi
}

TEST(ErrorSink, AMassThatStartsAtRestIsRelativeToItsLargestEnvelope) {
  struct StartsAtRest : ToyMotion {
    model::Kinematics envelope(double t) const override {
      const Eigen::Vector2d now(1.0, t < 2.0 ? 0.0 : t < 10.0 ? 0.5 : 0.25);
      return {now, now, now};
    }
  };
  const StartsAtRest reference;
  History history(reference, 0.1, 200);
  history.u[2 * 55 + 1] += 0.03;
  ErrorSink sink(reference, toy_problem(), 0.1);
  history.deliver(sink);
  EXPECT_NEAR(sink.score({}).u_error, 0.06, 1e-14);
}

TEST(ErrorSink, RefusesAnotherNumberOfMassesAndAStepThatIsNotPositive) {
  const ToyMotion reference;
  auto other = toy_problem();
  other.system.mass = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW(ErrorSink(reference, other, 0.1), InputError);
  EXPECT_THROW(ErrorSink(reference, toy_problem(), 0.0), InputError);
  ErrorSink sink(reference, toy_problem(), 0.1);
  const double one[] = {0.0};
  EXPECT_THROW(sink.take(model::SampleBlock{1, one, one, one}), InputError);
}

}  // namespace
}  // namespace clackers::measure
