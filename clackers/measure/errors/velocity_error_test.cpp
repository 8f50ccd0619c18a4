#include "clackers/measure/errors/mechanics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;
const double first = 0.5 * pi;  // of the true impacts

// One report: at what time, and the velocity of mass 1 on both sides.
struct Report {
  double t, before, after;
};

// Feeds a run that knows its own velocity of mass 1 and reports impacts; mass 2 moves with minus
// half of it. A report at an output time comes before or after the state of that time.
double integral(const std::function<double(double)>& v, double h, int steps,
                const std::vector<Report>& reports, int mass = 0, bool report_first = false) {
  const ToyMotion reference;
  VelocityError error(reference);
  std::size_t next = 0;
  const auto report = [&](double until, bool at_too) {
    for (; next < reports.size(); ++next) {
      const auto& r = reports[next];
      if (r.t > until || (r.t == until && !at_too)) return;
      const std::vector<double> u{0.0, 0.0}, before{r.before, -0.5 * r.before},
          after{r.after, -0.5 * r.after};
      error.take(model::ReportedImpact{r.t, 0, u, before, after, 0.0});
    }
  };
  for (int i = 0; i <= steps; ++i) {
    const double t = i * h;
    report(t, report_first);
    const auto now = reference.at(t, model::Side::right);
    const std::vector<double> own{v(t), -0.5 * v(t)};
    error.take(t, own, {now.v.data(), 2});
    report(t, true);
  }
  return error.integral(mass);
}

// True velocity of mass 1 with the impact moved to `when` and an offset in front of and behind it.
auto jumping(double when, double offset = 0.0) {
  return [=](double t) { return (t < when ? -std::sin(t) : std::sin(t)) + offset; };
}

TEST(VelocityError, IsZeroForTheReference) {
  EXPECT_EQ(integral(jumping(first), 0.1, 30, {{first, -1.0, 1.0}}), 0.0);
}

TEST(VelocityError, AConstantOffsetIntegratesToOffsetTimesLength) {
  const auto v = jumping(first, 0.01);
  EXPECT_NEAR(integral(v, 0.1, 30, {{first, -0.99, 1.01}}), 0.03, 1e-15);
  EXPECT_NEAR(integral(v, 0.1, 30, {{first, -0.99, 1.01}}, 1), 0.015, 1e-15);
  EXPECT_NEAR(integral(v, 0.1, 10, {}), 0.01, 1e-15);
}

TEST(VelocityError, TheTrapezoidalRuleTakesBothEndsOfAnInterval) {
  // Errors 0, 0.1, 0.2, ... at 0, 0.1, 0.2, ...: the rule is exact for a straight error.
  EXPECT_NEAR(integral([](double t) { return -std::sin(t) + t; }, 0.1, 10, {}), 0.5, 1e-15);
}

TEST(VelocityError, AnImpactAtTheWrongMomentCountsTheJumpForThatLong) {
  // Between its own impact and the true one the run is off by the jump, 2; the velocity turns by
  // less than delay^2 meanwhile.
  for (const double delay : {-0.02, -1e-3, -1e-9, 1e-9, 1e-3, 0.02}) {
    const double when = first + delay;
    const auto found = integral(jumping(when), 0.1, 30, {{when, -std::sin(when), std::sin(when)}});
    // The limits are compared with those of the true impact: sin(when) - 1 = delay^2 / 2 over a
    // step.
    EXPECT_NEAR(found, 2.0 * std::abs(delay), 0.12 * delay * delay + 1e-15) << delay;
  }
}

TEST(VelocityError, AnImpactReportedAtAnOwnTimeCountsTheSameWhicheverSideIsDelivered) {
  // True impact at 1.5708; the run notices at 1.6. The state at 1.6 is of either side.
  const double when = 1.6, sine = std::sin(when);
  for (const bool report_first : {false, true})
    for (const double switches : {1.55, 1.65}) {
      const double own = 16 * 0.1;
      const auto found =
          integral(jumping(switches), 0.1, 30, {{own, -sine, sine}}, 0, report_first);
      EXPECT_NEAR(found, 2.0 * (when - first), 2e-4) << report_first << " " << switches;
    }
}

TEST(VelocityError, AnImpactReportedStepsLaterCountsAllTimesBetween) {
  // The run bounces at 1.81 instead of 1.5708: output times 1.6, 1.7, 1.8 and its left limit are
  // off by 2 sin t, by the rule from the output time before the true impact on.
  const double when = 1.81;
  const auto found = integral(jumping(when), 0.1, 30, {{when, -std::sin(when), std::sin(when)}});
  const auto off = [](double t) { return 2.0 * std::sin(t); };
  EXPECT_NEAR(found, 0.1 * (off(1.6) + off(1.7)) + 0.055 * off(1.8) + 0.005 * off(when), 1e-12);
}

TEST(VelocityError, BetweenOwnAndTrueImpactTheRightLimitsAreCompared) {
  // The run comes back with 1/2 instead of 1. Late by 0.02 it is off by 2 meanwhile, early by 1.5;
  // behind both it is off by 1/2, falling to nothing at the output time 1.6.
  const double late = first + 0.02, early = first - 0.02;
  EXPECT_NEAR(integral(jumping(first), 0.1, 30, {{late, -1.0, 0.5}}), 0.04 + 0.25 * (1.6 - late),
              1e-12);
  EXPECT_NEAR(integral(jumping(first), 0.1, 30, {{early, -1.0, 0.5}}), 0.03 + 0.25 * (1.6 - first),
              1e-12);
}

TEST(VelocityError, ARunNeedNotStartAtZero) {
  const ToyMotion reference;
  VelocityError error(reference);
  for (const double t : {0.5, 0.6, 0.7}) {
    const std::vector<double> own{1.0, 1.0}, right{0.99, 1.0};
    error.take(t, own, right);
  }
  EXPECT_NEAR(error.integral(0), 0.01 * 0.2, 1e-15);
}

TEST(VelocityError, AnImpactReportedStepsTooEarlyCountsAllTimesBetween) {
  const double when = 1.31;
  const auto found = integral(jumping(when), 0.1, 30, {{when, -std::sin(when), std::sin(when)}});
  EXPECT_NEAR(found, 2.0 * (1.55 - when), 0.03);
}

TEST(VelocityError, WithoutAReportTheOwnTimesAloneCount) {
  // Nothing at all is off at output times, although the run does not report its impact.
  EXPECT_NEAR(integral(jumping(first), 0.1, 30, {}), 0.0, 1e-15);
  // It misses the impact: from 1.6 on it is off by 2 sin t, and the rule adds half the step before.
  // Its own error over [1.6, 3]: h^2 / 12 times the change of slope, 2 (cos 1.6 - cos 3) = 1.92.
  const auto found = integral([](double t) { return -std::sin(t); }, 0.1, 30, {});
  EXPECT_NEAR(found, 2.0 * (std::cos(1.6) - std::cos(3.0)) + 0.1 * std::sin(1.6), 2e-3);
}

TEST(VelocityError, FiringTwiceInOneStepCountsTheTimeBetweenTheShots) {
  // Back at 1.58, forth again at 1.59: the second and third are compared with the reference of
  // their time.
  const std::vector<Report> reports{{first, -1.0, 1.0}, {1.58, 1.0, -1.0}, {1.59, -1.0, 1.0}};
  const double a = std::sin(1.58), b = std::sin(1.59);
  const double expected =
      0.5 * ((1.58 - first) * (1.0 - a) + 0.01 * (1.0 + a + 1.0 + b) + 0.01 * (1.0 - b));
  EXPECT_NEAR(integral(jumping(first), 0.1, 30, reports), expected, 1e-12);
}

TEST(VelocityError, FiringTwiceTooEarlyComparesTheSecondWithTheReferenceBehindTheTrueImpact) {
  // Back at 1.55 and, not known to the reference, once more at 1.56 with the same sense.
  const std::vector<Report> reports{{1.55, -1.0, 1.0}, {1.56, 1.0, 1.0}};
  EXPECT_NEAR(integral(jumping(first), 0.1, 30, reports), 2.0 * (first - 1.55), 1e-12);
}

TEST(VelocityError, EveryImpactOfALongRunIsComparedWithItsOwn) {
  std::vector<Report> reports;
  for (int k = 0; k < 6; ++k) {
    const double t = first + k * pi + 1e-4;
    reports.push_back({t, -1.0, 1.0});
  }
  const auto v = [&](double t) {
    int k = 0;
    for (const auto& r : reports) k += r.t <= t;
    return (k % 2 == 0 ? -1.0 : 1.0) * std::sin(t);
  };
  EXPECT_NEAR(integral(v, 0.1, 199, reports), 6 * 2e-4, 1e-6);
}

TEST(VelocityError, AskingForTheIntegralChangesNothing) {
  const ToyMotion reference;
  VelocityError error(reference);
  for (int i = 0; i <= 10; ++i) {
    const auto now = reference.at(0.1 * i, model::Side::right);
    const std::vector<double> own{now.v[0] + 1.0, now.v[1]};
    error.take(0.1 * i, own, {now.v.data(), 2});
    EXPECT_NEAR(error.integral(0), 0.1 * i, 1e-15);
    EXPECT_EQ(error.integral(1), 0.0);
  }
}

}  // namespace
}  // namespace clackers::measure
