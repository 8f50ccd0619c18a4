// Numbers of the figures against values found without the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "paper/catalogue.hpp"
#include "paper/figures/validation.hpp"

namespace clackers::paper {
namespace {

using std::numbers::pi;

// Linear between points.
double at(const Series& series, double x) {
  const auto right = std::ranges::upper_bound(series.x, x) - series.x.begin();
  const auto i =
      std::size_t(std::clamp<std::ptrdiff_t>(right, 1, std::ptrdiff_t(series.x.size()) - 1));
  const double share = (x - series.x[i - 1]) / (series.x[i] - series.x[i - 1]);
  return series.y[i - 1] + share * (series.y[i] - series.y[i - 1]);
}

// The value at a drawn point.
double exactly(const Series& series, double x) {
  const auto found =
      std::ranges::min_element(series.x, {}, [&](double each) { return std::abs(each - x); });
  EXPECT_NEAR(*found, x, 1e-12 * x) << "no point there";
  return series.y[std::size_t(found - series.x.begin())];
}

TEST(Fig1, FollowsEquation4) {
  const auto figure = free_mass();
  const auto& u = figure.panels.at(0).series.at(0);
  const auto& v = figure.panels.at(1).series.at(0);
  EXPECT_DOUBLE_EQ(u.y.front(), 1.0);
  EXPECT_DOUBLE_EQ(v.y.front(), -0.05);
  EXPECT_DOUBLE_EQ(u.x.back(), 20.0);
  // half a period: cos = -1
  const double half = pi / std::sqrt(0.9975);
  EXPECT_NEAR(exactly(u, half), -std::exp(-0.05 * half), 1e-15);
  EXPECT_NEAR(exactly(v, half), 0.05 * std::exp(-0.05 * half), 1e-15);
}

TEST(Fig3, MassStaysBeyondTheStopAndItsVelocityJumpsSixTimes) {
  const auto figure = response_at_stop();
  const auto& u = figure.panels.at(0).series.at(0);
  EXPECT_GE(std::ranges::min(u.y), 0.0);
  const auto& v = figure.panels.at(1).series.at(0);
  int jumps = 0;
  for (std::size_t i = 1; i < v.x.size(); ++i)
    if (v.x[i] == v.x[i - 1]) {
      EXPECT_DOUBLE_EQ(v.y[i], -v.y[i - 1]);
      EXPECT_NEAR(v.x[i], (jumps + 0.5) * pi / std::sqrt(0.9975), 1e-14);
      ++jumps;
    }
  EXPECT_EQ(jumps, 6);
}

TEST(Fig4, MassesAreMirrorImages) {
  const auto figure = symmetric_pair();
  for (const auto& panel : figure.panels)
    for (std::size_t i = 0; i < panel.series.at(0).y.size(); ++i)
      EXPECT_EQ(panel.series[0].y[i], -panel.series.at(1).y[i]);
}

TEST(Fig5, SecondMassIsFiveTimesAsFast) {
  const auto figure = sample_extension();
  const auto& u2 = figure.panels.at(0).series.at(1);
  EXPECT_DOUBLE_EQ(u2.y.front(), -0.6);
  const double half = pi / (5.0 * std::sqrt(0.9975));
  EXPECT_NEAR(exactly(u2, half), 0.6 * std::exp(-0.05 * half), 1e-15);
  EXPECT_NEAR(exactly(u2, 2.5 * half), 0.0, 1e-15);
}

TEST(Fig6, AmplitudesAreThoseOfAnIndependentQuadrature) {
  const auto figure = spectra();
  ASSERT_EQ(figure.panels.size(), 6u);
  // The integral of u1 = |cos(w t)| exp(-0.05 t) over 20 s, by the midpoint rule.
  double mean = 0.0;
  constexpr int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const double t = 20.0 * (i + 0.5) / n;
    mean += std::abs(std::cos(std::sqrt(0.9975) * t)) * std::exp(-0.05 * t) * 20.0 / n;
  }
  const auto& frequency = figure.panels.at(1);
  EXPECT_EQ(frequency.series.at(0).x.front(), 0.0);
  EXPECT_NEAR(frequency.series.at(0).y.front(), mean, 1e-7);
  EXPECT_NEAR(frequency.series.at(1).y.front(), mean, 1e-5);  // from samples
  // Each peak of mass 2 is beside one of its harmonics X - 1 and X + 1.
  for (const auto& [panel, X] : {std::pair{1u, 5.0}, {3u, 9.0}, {5u, 41.0}}) {
    const auto& line = figure.panels[panel].series.at(2);
    const auto top = std::size_t(std::ranges::max_element(line.y) - line.y.begin());
    EXPECT_NEAR(line.x[top], X - 1.0, 0.3) << "X = " << X;
  }
}

TEST(Fig8, IsAGridOfNAndDamping) {
  const auto figure = effect_of_damping();
  ASSERT_EQ(figure.panels.size(), 9u);
  EXPECT_EQ(figure.panels[5].note, "N = 5, ξ1 = 0.15");
  EXPECT_DOUBLE_EQ(figure.panels[5].series.at(1).y.front(), -3.0 / 21.0);
}

TEST(Fig9And10, DurationsAndStartsFollowFromTheParameters) {
  const auto ends = [](const Figure& figure) {
    std::vector<double> out;
    for (const auto& panel : figure.panels) out.push_back(panel.series.at(1).x.back());
    return out;
  };
  EXPECT_EQ(ends(effect_of_duration()), (std::vector<double>{40, 100, 400}));
  const auto ten = three_parameters();
  EXPECT_EQ(ends(ten), (std::vector<double>{80, 20, 20, 20, 20, 24, 24, 24, 10, 20}));
  std::vector<double> starts;
  for (const auto& panel : ten.panels) starts.push_back(-3.0 / panel.series.at(1).y.front());
  const std::vector<double> ratios{1, 1, 1, 5, 5, 5, 9, 9, 9, 21};
  for (std::size_t i = 0; i < ratios.size(); ++i) EXPECT_DOUBLE_EQ(starts[i], ratios[i]) << i;
}

TEST(Fig11, TheResponseWithoutImpactIsTheMirrorImage) {
  const auto panel = mirrored_response().panels.at(0);
  for (std::size_t mass = 0; mass < 2; ++mass) {
    const auto& with = panel.series.at(2 * mass);
    const auto& alone = panel.series.at(2 * mass + 1);
    EXPECT_EQ(alone.x.front(), panel.series.at(4).x.front());
    for (std::size_t i = 0; i < alone.x.size(); ++i)
      EXPECT_NEAR(exactly(with, alone.x[i]), -alone.y[i], 1e-14);
  }
}

TEST(Fig12, CurvesMeetAtMultiplesOfTheFullPeriod) {
  const auto figure = coincidence();
  ASSERT_EQ(figure.panels.size(), 2u);
  const double period = 2.0 * pi / std::sqrt(0.99);
  for (const auto& panel : figure.panels) {
    const double start = panel.series.at(0).y.front();
    const auto& points = panel.series.at(2);
    ASSERT_EQ(points.x.size(), 3u);
    for (std::size_t n = 0; n < 3; ++n) {
      const double t = double(n + 1) * period;
      EXPECT_NEAR(points.x[n], t, 1e-14 * t);
      EXPECT_NEAR(points.y[n], start * std::exp(-0.1 * t), 1e-14);
      for (const std::size_t curve : {0u, 1u})
        EXPECT_NEAR(exactly(panel.series[curve], t), start * std::exp(-0.1 * t), 1e-14);
    }
    // And not elsewhere: between the first and the second impact they are opposite.
    EXPECT_NEAR(at(panel.series[0], 0.45 * period), -at(panel.series[1], 0.45 * period), 1e-12);
  }
}

TEST(FigA1, FollowsEquationA13) {
  const auto figure = positive_definite();
  ASSERT_EQ(figure.panels.size(), 6u);
  EXPECT_NEAR(at(figure.panels[0].series.at(0), 0.0), 1.6, 1e-15);
  // cos(1) + cos(9)/3, cos(1) + 3 cos(21)/21, from a table of cosines
  EXPECT_NEAR(at(figure.panels[1].series.at(0), 1.0), 0.5403023058 - 0.9111302619 / 3.0, 2e-5);
  EXPECT_NEAR(at(figure.panels[2].series.at(0), 1.0), 0.5403023058 - 3.0 * 0.5477292602 / 21.0,
              2e-5);
  for (const auto& panel : figure.panels)
    for (const double y : panel.series[0].y) ASSERT_GT(y, 0.0) << panel.note;
  // D' = 4 s at the first and the last point, the doubles s = 6.12e-17 inside of +-pi/2.
  for (const double end :
       {figure.panels[2].series[0].y.front(), figure.panels[2].series[0].y.back()})
    EXPECT_DOUBLE_EQ(end, 4.0 * 6.123233995736766e-17);
}

TEST(FigA2, MassTwoMovesHalfAsFarOnTheRight) {
  const auto figure = amplitudes();
  ASSERT_EQ(figure.panels.size(), 6u);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& left = figure.panels[2 * row].series.at(1).y;
    const auto& right = figure.panels[2 * row + 1].series.at(1).y;
    ASSERT_EQ(left.size(), right.size());
    EXPECT_DOUBLE_EQ(left.front(), -3.0 / (row == 0 ? 5.0 : row == 1 ? 9.0 : 21.0));
    for (std::size_t i = 0; i < left.size(); ++i) EXPECT_NEAR(left[i], 2.0 * right[i], 1e-15);
  }
}

TEST(FigA3, NearestMissSolvesItsEquationAndTheGrazingCurveTouches) {
  const auto panel = near_miss().panels.at(0);
  const auto& points = panel.series.at(3);
  const double omega = std::sqrt(1.0 - 0.05 * 0.05), t1 = pi / (2.0 * omega);
  // X = 21: 21 sin(x/21) cos x = sin x cos(x/21), whose first root beyond pi a bisection finds.
  const auto f = [](double x) {
    return 21.0 * std::sin(x / 21.0) * std::cos(x) - std::sin(x) * std::cos(x / 21.0);
  };
  double low = pi, high = 1.5 * pi;
  for (int i = 0; i < 60; ++i)
    (f(low) * f(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(21.0 * omega * (t1 - points.x.at(0)), low, 2e-3);  // two pieces of the scan
  EXPECT_LT(points.y.at(1), points.y.at(0));
  double least = 1.0;
  const auto& first = panel.series.at(0);
  const auto& grazing = panel.series.at(2);
  for (std::size_t i = 0; i + 1 < first.x.size(); ++i)
    least = std::min(least, (first.y[i] - grazing.y[i]) / first.y[i]);
  EXPECT_NEAR(least, 0.0, 2e-5);  // a double root between points 0.005 rad apart
  EXPECT_GT(least, -1e-12);
}

TEST(Validation, ErrorsConvergeIfTheyFallToATenthAndEndNearTheLeast) {
  const auto line = [](std::vector<double> errors) {
    return Series{"", errors, errors, first_mass()};
  };
  EXPECT_TRUE(converges(line({1.0, 0.3, 0.09})));
  EXPECT_TRUE(converges(line({1.0, 0.05, 0.09})));
  EXPECT_FALSE(converges(line({1.0, 0.3, 0.11})));   // not far enough
  EXPECT_FALSE(converges(line({1.0, 0.04, 0.09})));  // it was better before
  EXPECT_FALSE(converges(line({0.01, 0.3, 1.0})));
  EXPECT_FALSE(converges(line({})));  // every level failed
}

// Larger N do not differ and take the command longer.
TEST(Validation, InterruptStopsTheStudies) {
  constexpr std::array Ns{20};
  const std::atomic<bool> interrupt{true};
  EXPECT_TRUE(convergence(Ns, &interrupt).panels.empty());
}

TEST(Validation, SixMethodsConvergeForEveryN) {
  constexpr std::array Ns{0, 1, 2};
  const auto figure = convergence(Ns);
  ASSERT_EQ(figure.panels.size(), 3u);
  EXPECT_EQ(figure.panels[2].note, "N = 2");
  for (const auto& panel : figure.panels) {
    EXPECT_EQ(panel.series.size(), 6u);
    for (const auto& series : panel.series) EXPECT_TRUE(converges(series)) << series.name;
  }
}

}  // namespace
}  // namespace clackers::paper
