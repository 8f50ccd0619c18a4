#include "clackers/tables/listing/show_sheets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "clackers/methods/registry.hpp"

namespace clackers::tables {
namespace {

using std::numbers::pi;

std::vector<Amplification> of(const std::string& name, const std::vector<double>& steps) {
  return amplification(*methods::integrator(name), steps);
}

// Average acceleration turns by 2 arctan(omega h / 2) a step and loses nothing.
TEST(Amplification, OfAverageAccelerationIsItsFormula) {
  for (const auto& point : of("average-acceleration", {0.01, 0.1, 0.2, 0.4})) {
    const double W = 2.0 * pi * point.steps;
    EXPECT_NEAR(point.period_elongation, W / (2.0 * std::atan(W / 2.0)) - 1.0, 1e-7 * (1.0 + W));
    EXPECT_NEAR(point.amplitude_decay, 0.0, 1e-6);
    EXPECT_NEAR(point.spectral_radius, 1.0, 1e-7);
    EXPECT_NEAR(point.u_overshoot, 1.0, 1e-12);  // energy is kept
  }
}

// Central difference turns by 2 arcsin(omega h / 2) up to omega h = 2, and grows beyond, where the
// larger root of z^2 - (2 - W^2) z + 1 is its radius.
TEST(Amplification, OfCentralDifferenceEndsAtItsLimit) {
  const auto points = of("central-difference", {0.05, 0.1, 0.2, 0.3, 0.4});
  for (std::size_t i = 0; i < 4; ++i) {
    const double W = 2.0 * pi * points[i].steps;
    EXPECT_NEAR(points[i].period_elongation, W / (2.0 * std::asin(W / 2.0)) - 1.0, 1e-7);
    EXPECT_NEAR(points[i].spectral_radius, 1.0, 1e-7);
  }
  const double W = 2.0 * pi * 0.4, b = W * W / 2.0 - 1.0;
  EXPECT_NEAR(points[4].spectral_radius, b + std::sqrt(b * b - 1.0), 1e-7);
  EXPECT_TRUE(std::isnan(points[4].period_elongation));
  EXPECT_TRUE(std::isnan(points[4].u_overshoot));
}

// Generalized-alpha: radius rho at infinity, which its period elongation and decay approach as known.
TEST(Amplification, OfDissipativeMethodsReachesTheirRadius) {
  for (const double rho : {0.0, 0.5, 0.8})
    EXPECT_NEAR(
        of("generalized-alpha:rho=" + std::to_string(rho), {0.01, 1e4}).back().spectral_radius, rho,
        0.01);
  const auto wilson = of("wilson-theta", {0.01, 0.1, 10.0});
  EXPECT_GT(wilson[1].amplitude_decay, 0.0);
  EXPECT_GT(wilson[2].u_overshoot, 10.0);  // known for it
}

// A multistep method starts with steps of others, which are none of its own.
TEST(Amplification, OfMultistepMethodsIsThatOfTheirOwnSteps) {
  // BDF2 on the first-order system: 3/2 z^2 - 2 z + 1/2 = i W z^2.
  const double W = 2.0 * pi * 0.1;
  const std::complex<double> a(1.5, -W);
  const auto root = (2.0 + std::sqrt(4.0 - 2.0 * a)) / (2.0 * a);
  const auto point = of("bdf2", {0.01, 0.1}).back();
  EXPECT_NEAR(point.spectral_radius, std::abs(root), 1e-7);
  EXPECT_NEAR(point.period_elongation, W / std::arg(root) - 1.0, 1e-7);
  EXPECT_NEAR(point.amplitude_decay,
              1.0 - std::exp(2.0 * pi * std::log(std::abs(root)) / std::arg(root)), 1e-7);
}

TEST(AmplificationSheets, OfEveryIntegratorAreDrawnAndLackWhatHasNoMeaning) {
  for (const auto& entry : methods::entries()) {
    if (entry.kind != "integrator") continue;
    const auto integrator = methods::integrator(entry.name);
    if (integrator->facts().is_adaptive) continue;
    for (const auto& sheet : amplification_sheets(*integrator)) {
      ASSERT_TRUE(sheet.curves) << entry.name;
      for (const auto& row : sheet.rows) {
        ASSERT_EQ(row.size(), sheet.columns.size());
        for (const auto& cell : row)
          if (const auto* value = std::get_if<double>(&cell)) {
            ASSERT_TRUE(std::isfinite(*value)) << entry.name << ", " << sheet.title;
          }
      }
    }
  }
}

// The curve of rk4 crosses 1 at 2 sqrt(2) / (2 pi), where it has a point, and goes on above it.
TEST(Amplification, TheSpectralRadiusIsDrawnToItsMarkedLimit) {
  const auto radius = amplification_sheets(*methods::integrator("rk4"))[1];
  const double limit = std::sqrt(2.0) / pi;
  ASSERT_EQ(radius.curves->marks.size(), 1u);
  EXPECT_NEAR(radius.curves->marks[0], limit, 1e-3);
  int near = 0, above = 0;
  for (const auto& row : radius.rows) {
    const double h = std::get<double>(row[0]), rho = std::get<double>(row[1]);
    if (std::abs(h - radius.curves->marks[0]) < 1e-12) {
      EXPECT_NEAR(rho, 1.0, 1e-2);
    }
    near += std::abs(h / limit - 1.0) < 0.05;
    above += rho > 1.1 && rho < 1.5;
  }
  EXPECT_GT(near, 6);
  EXPECT_GT(above, 4);
  EXPECT_TRUE(amplification_sheets(*methods::integrator("newmark"))[1].curves->marks.empty());
}

}  // namespace
}  // namespace clackers::tables
