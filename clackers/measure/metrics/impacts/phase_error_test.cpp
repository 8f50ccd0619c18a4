#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;

MetricValue of_toy(const ToyFlaws& flaws, MetricValue (*metric)(const Comparison&)) {
  const ToyMotion reference;
  const auto problem = toy_problem();
  const auto history = toy_history(flaws);
  return metric(Comparison(history, reference, problem));
}

// The free mass of the reference with its frequency and its decay changed.
model::Trajectory free_history(double frequency, double decay, double end = 20.0, double h = 0.01) {
  const double sigma = 0.05 * decay, omega = std::sqrt(1.0 - 0.05 * 0.05) * frequency;
  model::Trajectory made;
  made.dof = 1;
  for (long i = 0; i <= std::lround(end / h); ++i) {
    const double t = double(i) * h, e = std::exp(-sigma * t);
    made.t.push_back(t);
    made.u.push_back(e * std::cos(omega * t));
    made.v.push_back(-e * (sigma * std::cos(omega * t) + omega * std::sin(omega * t)));
  }
  return made;
}

MetricValue of_free(const model::Trajectory& history, MetricValue (*metric)(const Comparison&)) {
  const exact::FreeMass reference({.xi1 = 0.05, .t_end = 20.0});
  const auto problem = reference.problem();
  return metric(Comparison(history, reference, problem));
}

TEST(PhaseError, OfImpactsThatAreALittleFartherApart) {
  for (const double stretch : {1.001, 0.999}) {
    const ToyFlaws flaws{.h = 0.01, .stretch = stretch};
    const auto period = of_toy(flaws, measure_period_error);
    ASSERT_EQ(period.masses.size(), 2u);
    EXPECT_NEAR(period.masses[0], stretch - 1.0, 1e-12);
    EXPECT_EQ(period.masses[1], period.masses[0]);
    EXPECT_EQ(period.value, std::abs(period.masses[0]));
    // Impact 3, the last one before 10 s, is at 2.5 T.
    EXPECT_NEAR(of_toy(flaws, measure_phase_error).masses[0], 2.5 * (stretch - 1.0), 1e-12);
  }
}

TEST(PhaseError, ADelayOfAllImpactsIsNoErrorOfThePeriod) {
  EXPECT_NEAR(of_toy({.delay = 0.02}, measure_period_error).value, 0.0, 1e-12);
  EXPECT_NEAR(of_toy({.delay = 0.02}, measure_phase_error).masses[0], 0.02 / pi, 1e-12);
  EXPECT_NEAR(of_toy({.delay = -0.02}, measure_phase_error).masses[1], -0.02 / pi, 1e-12);
}

TEST(PhaseError, OfAFreeMassComesFromItsZeroCrossings) {
  // Crossings at (k - 1/2) pi/omega; the last of 6 before 20 s. Straight lines between rows h apart
  // move a crossing by less than sigma h^2/4 = 1e-6 s, of a period of 6.3 s over 5 half periods.
  for (const double frequency : {1.002, 0.99}) {
    const auto history = free_history(frequency, 1.0);
    const double period = 1.0 / frequency - 1.0;
    EXPECT_NEAR(of_free(history, measure_period_error).masses[0], period, 1e-6);
    EXPECT_NEAR(of_free(history, measure_phase_error).masses[0], 5.5 / 2.0 * period, 1e-6);
  }
  EXPECT_EQ(of_free(free_history(1.0, 1.0), measure_period_error).reason, "");
}

TEST(PhaseError, DecayIsMeasuredAPeriod) {
  const double omega = std::sqrt(1.0 - 0.05 * 0.05);
  const auto a_period = [&](double sigma) { return 1.0 - std::exp(-sigma * 2.0 * pi / omega); };
  for (const double decay : {1.2, 0.5})
    EXPECT_NEAR(of_free(free_history(1.0, decay), measure_decay_error).masses[0],
                a_period(0.05 * decay) - a_period(0.05), 1e-5);
  EXPECT_NEAR(of_free(free_history(1.0, 1.0), measure_decay_error).value, 0.0, 1e-12);
}

TEST(PhaseError, DecayThroughImpactsIsThatOfTheSpeedBeforeThem) {
  auto history = toy_history({});
  double factor = 1.0;
  for (auto& impact : *history.impacts) {
    impact.v_before[0] *= factor;
    factor *= 0.9;
  }
  const ToyMotion reference;
  const auto problem = toy_problem();
  const auto found = measure_decay_error(Comparison(history, reference, problem));
  EXPECT_NEAR(found.masses[0], 0.1, 1e-12);
  EXPECT_NEAR(found.masses[1], 0.0, 1e-12);
  EXPECT_EQ(found.value, found.masses[0]);
}

TEST(PhaseError, TheLargestSizeStandsForAllMasses) {
  auto history = toy_history({});
  double factor = 1.0;
  for (auto& impact : *history.impacts) {
    impact.v_before[0] *= factor;
    factor *= 1.1;
  }
  const ToyMotion reference;
  const auto problem = toy_problem();
  const auto found = measure_decay_error(Comparison(history, reference, problem));
  EXPECT_NEAR(found.masses[0], -0.1, 1e-12);
  EXPECT_NEAR(found.value, 0.1, 1e-12);
}

TEST(PhaseError, SaysWhyItIsNotMeasured) {
  EXPECT_EQ(of_free(free_history(1.0, 1.0, 3.0), measure_period_error).reason,
            "Mass 1 crosses zero less than twice.");
  auto history = free_history(1.0, 1.0);
  history.v.clear();
  EXPECT_EQ(of_free(history, measure_decay_error).reason, "The speed at marks is not known, or 0.");
  EXPECT_EQ(of_free(history, measure_period_error).reason, "");
  EXPECT_NE(of_free(free_history(2.2, 1.0), measure_period_error).reason.find("do not follow"),
            std::string::npos);
  auto silent = toy_history({});
  silent.impacts.emplace();
  const ToyMotion reference;
  const auto problem = toy_problem();
  EXPECT_EQ(measure_period_error(Comparison(silent, reference, problem)).reason,
            "Fewer than two impacts are matched.");
}

TEST(PhaseError, ARowAtZeroIsOneCrossing) {
  auto history = free_history(1.0, 1.0);
  // The row nearest to the second crossing is put on it.
  for (std::size_t i = 1; i < history.t.size(); ++i)
    if (history.t[i] > 4.0 && history.u[i - 1] * history.u[i] < 0.0) {
      history.u[i] = 0.0;
      break;
    }
  EXPECT_NEAR(of_free(history, measure_period_error).value, 0.0, 1e-3);
}

}  // namespace
}  // namespace clackers::measure
