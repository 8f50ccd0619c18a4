#include "clackers/measure/metrics/causes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/quantities/quantities.hpp"
#include "clackers/measure/testing/toy_motion.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;

// Stops the run when synchrony is lost.
class WatchingSink : public model::Sink {
 public:
  explicit WatchingSink(const model::SmoothSystem<>& system) : system_(system) {}
  bool take(const model::SampleBlock&) override { return true; }
  bool take(const model::ReportedImpact& impact) override {
    watch.take(impact.t, pi * double(++count_), relative_momentum(system_, impact.v_after));
    return !watch.loss().lost;
  }
  SynchronyWatch watch{pi};

 private:
  const model::SmoothSystem<>& system_;
  long long count_ = 0;
};

// Average acceleration on X = 9, xi1 = 0, from just after an impact.
SynchronyLoss newmark_loss(double r, int steps_per_fast_period, double impacts) {
  const double m2 = 1.0 / r, X = 9.0;
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector2d(1.0, m2).asDiagonal();
  problem.system.stiffness = Eigen::Vector2d(1.0, m2 * X * X).asDiagonal();
  problem.system.damping = Eigen::Matrix2d::Zero();
  problem.contacts.push_back({Eigen::Vector2d(1.0, -1.0), 0.0, 1.0});
  problem.start = {0.0, Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, -r)};
  problem.end = impacts * pi;
  WatchingSink sink(problem.system);
  const double h = 2.0 * pi / X / steps_per_fast_period;
  methods::method("newmark")->prepare(problem, h)->advance(sink);
  return sink.watch.loss();
}

// Impacts with the spacings T (1 + error of k) and the momentum of k after them.
template <class Error, class Momentum>
SynchronyLoss watch(int impacts, Error&& error, Momentum&& momentum) {
  SynchronyWatch watch(2.0);
  double found = 0.0;
  for (int k = 1; k <= impacts; ++k) {
    found += 2.0 * (1.0 + error(k));
    watch.take(found, 2.0 * k, momentum(k));
  }
  return watch.loss();
}

SynchronyLoss watch(int impacts, auto&& error) {
  return watch(impacts, error, [](int) { return NAN; });
}

TEST(Synchrony, IsLostAtTheFirstSpacingThatIsWrongByATenth) {
  const auto late = watch(20, [](int k) { return k == 7 ? 0.11 : 0.09; });
  EXPECT_EQ(late.lost, 7);
  EXPECT_EQ(late.impacts, 7);
  EXPECT_NEAR(late.worst, 0.11, 1e-12);
  EXPECT_EQ(watch(20, [](int k) { return k == 1 ? -0.11 : 0.0; }).lost, 1);
  const auto kept = watch(20, [](int) { return 0.09; });
  EXPECT_FALSE(kept.lost);
  EXPECT_EQ(kept.impacts, 20);
}

TEST(Synchrony, CountsSpacingsAndNotTheLagThatTheyAddUpTo) {
  EXPECT_FALSE(watch(100, [](int) { return 0.05; }).lost);
}

TEST(Synchrony, MeasuresTheGrowthOfMomentumBeforeTheLoss) {
  const auto loss = [](int k) { return k == 30 ? -0.8 : 0.0; };
  const auto growing = watch(100, loss, [](int k) {
    return k == 30 ? 5.0 : (k % 2 ? 1.0 : -1.0) * 1e-3 * std::exp(0.2 * k);
  });
  EXPECT_EQ(growing.lost, 30);
  EXPECT_NEAR(growing.growth, 0.2, 1e-12);
  // What does not stand out is left out, wherever it was before.
  const auto wandering = watch(100, loss, [](int k) {
    return k < 10 ? 0.5 / k : k < 18 ? 0.01 : 1e-3 * std::exp(0.2 * k);
  });
  EXPECT_NEAR(wandering.growth, 0.2, 1e-12);
  EXPECT_TRUE(std::isnan(watch(5, loss, [](int) { return 0.02; }).growth));
  EXPECT_TRUE(std::isnan(watch(2, loss, [](int) { return 0.2; }).growth));
  EXPECT_EQ(watch(3, loss, [](int) { return 0.2; }).growth, 0.0);
  EXPECT_TRUE(std::isnan(watch(5, loss).growth));
}

TEST(Synchrony, MomentumIsRelativeToThatOfTheMasses) {
  const auto system = toy_problem().system;  // masses 1 and 2
  const double away[] = {3.0, -1.0}, together[] = {3.0, 1.0}, one[] = {1.0};
  EXPECT_DOUBLE_EQ(relative_momentum(system, away), 0.2);
  EXPECT_DOUBLE_EQ(relative_momentum(system, together), 1.0);
  EXPECT_TRUE(std::isnan(relative_momentum(system, one)));
}

class SynchronyOfAHistory : public testing::Test {
 protected:
  ToyMotion reference_;
  model::ImpactProblem<> problem_ = toy_problem();
  SynchronyLoss loss(const model::Trajectory& history) {
    return synchrony_loss(Comparison(history, reference_, problem_));
  }
  MetricValue spacing(const ToyFlaws& flaws) {
    const auto history = toy_history(flaws);
    return measure_spacing_error(Comparison(history, reference_, problem_));
  }
};

TEST_F(SynchronyOfAHistory, IsFoundNumberByNumber) {
  const auto kept = loss(toy_history({.end = 10.0}));
  EXPECT_FALSE(kept.lost);
  EXPECT_EQ(kept.impacts, 3);
  // The first is late by half of what each later spacing is too long.
  EXPECT_EQ(loss(toy_history({.end = 10.0, .stretch = 1.15})).lost, 2);
  EXPECT_EQ(loss(toy_history({.end = 10.0, .stretch = 1.25})).lost, 1);
  EXPECT_NEAR(spacing({.end = 10.0, .stretch = 1.05}).value, 0.05, 1e-12);
  EXPECT_NEAR(spacing({.end = 10.0, .stretch = 0.95}).value, 0.05, 1e-12);
  EXPECT_EQ(spacing({.end = 1.0}).reason, "The history or the reference has no impacts.");
}

TEST_F(SynchronyOfAHistory, TakesMomentaAfterImpacts) {
  auto history = toy_history({.end = 20.0});
  double p = 0.04;  // m1 v1 = 1 and m2 v2 = -1 in synchrony
  for (auto& impact : *history.impacts) impact.v_after[0] *= 1.0 + (p *= 1.2);
  // Relative momentum p / (2 + p): a little less growth than that of p.
  EXPECT_NEAR(loss(history).growth, std::log(1.2), 0.02);
  for (auto& impact : *history.impacts) impact.v_after.clear();
  EXPECT_TRUE(std::isnan(loss(history).growth));
}

TEST(Synchrony, PredictsFromDetuningWhatTheRoomOfReferencePredicts) {
  const SynchronyLoss loss{.impacts = 64, .lost = 64, .worst = 0.9, .growth = 0.08};
  for (const double eps : {-0.01, 1e-4, 0.2}) {
    const exact::FrequencyRatio ratio{.odd = 9.0};
    const double rate = exact::detuning_rate(ratio, 3.0);
    for (const double eta : {1.0, 0.9}) {
      const auto part = explained_by_detuning(loss, {.rate = rate, .eta = eta, .eps = eps});
      EXPECT_EQ(part.impact, exact::impacts_until_detuning(ratio, 3.0, eta, eps));
      EXPECT_NEAR(part.share * 0.08, rate * std::abs(eps) - std::log(eta), 1e-15);
    }
  }
  EXPECT_EQ(explained_by_detuning(loss, {.rate = 0.0, .eta = 1.0, .eps = 0.01}).impact, INFINITY);
}

TEST(Synchrony, IsKeptWhereTheFastMassIsTheHeavierOne) {
  // r < 1 is a centre: no growth at the steps that lose r = 3 at impact 64.
  const auto loss = newmark_loss(0.5, 20, 640);
  EXPECT_FALSE(loss.lost);
  EXPECT_GE(loss.impacts, 630);
}

TEST(Synchrony, RefusesWhatIsNoDetuning) {
  EXPECT_THROW(SynchronyWatch(0.0), InputError);
  EXPECT_THROW(explained_by_detuning({}, {.rate = -1.0, .eta = 1.0, .eps = 0.1}), InputError);
  EXPECT_THROW(explained_by_detuning({}, {.rate = 1.0, .eta = 0.0, .eps = 0.1}), InputError);
  EXPECT_THROW(explained_by_detuning({}, {.rate = 1.0, .eta = 1.0, .eps = 0.0}), InputError);
  EXPECT_THROW(explained_by_detuning({}, {.rate = 1.0, .eta = 1.0, .eps = 1.0}), InputError);
}

TEST(Synchrony, OfAverageAccelerationIsLostByItsOwnDetuning) {
  for (const auto& [steps, lost] : {std::pair{20, 64}, std::pair{40, 396}, std::pair{80, 2152}}) {
    const auto loss = newmark_loss(3.0, steps, 1.5 * lost);
    // Frequencies of the rule: tan(w h/2) = omega h/2, of mass 2 with W = 2 pi/steps.
    const auto period_error = [](double W) { return 2.0 * std::atan(0.5 * W) / W - 1.0; };
    const double W = 2.0 * pi / steps;
    const double eps = (1.0 + period_error(W)) / (1.0 + period_error(W / 9.0)) - 1.0;
    const double rate = exact::detuning_rate({.odd = 9.0}, 3.0);
    const auto part = explained_by_detuning(loss, {.rate = rate, .eta = 1.0, .eps = eps});
    SCOPED_TRACE(testing::Message() << steps << " steps a fast period, eps " << eps);
    ASSERT_TRUE(loss.lost);
    // Found by another run of the rule, which started every flight with a full step.
    EXPECT_NEAR(double(*loss.lost), lost, 1.0 + 2e-3 * lost);
    // The estimate starts the growth at |eps|; measured here 2.7 to 4.7 % too late.
    EXPECT_NEAR(part.impact, lost, 0.06 * lost);
    // sinh instead of exp: up to coth(1) at first, so the measured growth is the greater one.
    EXPECT_GT(part.share, 0.85);
    EXPECT_LT(part.share, 1.02);
  }
}

}  // namespace
}  // namespace clackers::measure
