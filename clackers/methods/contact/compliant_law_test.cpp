#include "clackers/methods/contact/compliant_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

namespace clackers::methods {
namespace {

class EveryLaw : public testing::TestWithParam<CompliantLaw> {
 protected:
  CompliantContact contact(double eta) const { return {3e4, 2.5, GetParam().damping(eta), 0.7}; }
  ContactForce force(double eta, double d, double w) const {
    return GetParam().force(contact(eta), d, w);
  }
};

TEST_P(EveryLaw, HasTheDerivativesOfItsForce) {
  std::mt19937_64 bits(4);
  std::uniform_real_distribution<double> depth(1e-4, 1e-2), rate(-1.0, 1.0), restitution(0.2, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double d = depth(bits), w = rate(bits);
    const double eta = GetParam().models(0.5) ? restitution(bits) : 1.0;
    const auto f = force(eta, d, w);
    // Central differences: error h^2 F'''/6 of the size 1e-8 of F' here, rounding 1e-16 F/h.
    const double hd = 1e-4 * d, hw = 1e-4 * std::abs(w);
    const double scale = 3e4 * std::sqrt(d);
    if (f.value > 1e-2 * scale * d) {  // no switch of the law nearby
      EXPECT_NEAR(f.by_d, (force(eta, d + hd, w).value - force(eta, d - hd, w).value) / (2 * hd),
                  1e-6 * (std::abs(f.by_d) + scale))
          << i;
      EXPECT_NEAR(f.by_w, (force(eta, d, w + hw).value - force(eta, d, w - hw).value) / (2 * hw),
                  1e-6 * (std::abs(f.by_w) + scale * d))
          << i;
    }
  }
}

TEST_P(EveryLaw, IsElasticWhereRestitutionIsOne) {
  EXPECT_EQ(GetParam().damping(1.0), 0.0);
  for (const double d : {1e-3, 4e-3})
    for (const double w : {-0.5, 0.0, 0.5}) {
      const auto f = force(1.0, d, w);
      EXPECT_NEAR(f.value, 3e4 * std::pow(d, GetParam().exponent), 1e-12 * f.value);
      EXPECT_EQ(f.by_w, 0.0);
    }
}

TEST_P(EveryLaw, TakesEnergyFromTheApproachWhereRestitutionIsLess) {
  if (!GetParam().models(0.5)) return;
  EXPECT_GT(force(0.5, 1e-3, 0.5).value, force(1.0, 1e-3, 0.5).value);
  EXPECT_LE(force(0.5, 1e-3, -0.2).value, force(1.0, 1e-3, -0.2).value);
}

TEST_P(EveryLaw, ActsNoLongerOnceLeft) {
  const auto left = force(GetParam().models(0.5) ? 0.5 : 1.0, -1e-6, -0.1);
  EXPECT_EQ(left.value, 0.0);
  EXPECT_EQ(left.by_d, 0.0);
  EXPECT_EQ(left.by_w, 0.0);
}

TEST_P(EveryLaw, HasFiniteCoefficientsWhereItModelsTheRestitution) {
  for (const double eta : {0.0, 0.01, 0.5, 0.99, 1.0}) {
    if (GetParam().models(eta)) {
      EXPECT_TRUE(std::isfinite(GetParam().damping(eta))) << eta;
    }
  }
  if (GetParam().restitution == CompliantLaw::Restitution::positive) {
    EXPECT_FALSE(std::isfinite(GetParam().damping(0.0)));
  }
}

// The elastic motion m d'' = -F(d) from d = 0 with w0, by Simpson's rule in the angle x of
// d = peak sin^2 x, where the integrand is smooth.
TEST_P(EveryLaw, LastsAsLongAsItsElasticMotion) {
  const auto& law = GetParam();
  const double k = 3e4, m = 2.5, w0 = 0.7, n = law.exponent;
  const double peak = std::pow(0.5 * (n + 1) * m * w0 * w0 / k, 1 / (n + 1));
  const int parts = 200;
  double sum = 0.0;
  for (int i = 0; i <= parts; ++i) {
    const double x = 0.5 * std::numbers::pi * i / parts, s = std::sin(x), c = std::cos(x);
    // Limits at both ends: d' = w0 at d = 0; (1 - (d/peak)^(n+1)) -> (n + 1) c^2 at the peak.
    const double slowness =
        i == parts ? 2 / std::sqrt(n + 1) : 2 * s * c / std::sqrt(1 - std::pow(s * s, n + 1));
    sum += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * slowness;
  }
  const double time = 2 * peak / w0 * sum * 0.5 * std::numbers::pi / parts / 3;
  EXPECT_NEAR(law.contact_time(k, m, w0), time, 1e-8 * time);
  EXPECT_NEAR(law.stiffness_for(time, m, w0), k, 1e-7 * k);
}

INSTANTIATE_TEST_SUITE_P(Table, EveryLaw,
                         testing::ValuesIn(compliant_laws().begin(), compliant_laws().end()),
                         [](const auto& row) {
                           std::string name(row.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(CompliantLaw, TimesOfSpringAndSpheresAreThoseOfTheLiterature) {
  const double k = 3e4, m = 2.5, w0 = 0.7;
  EXPECT_NEAR(compliant_law("linear").contact_time(k, m, w0), std::numbers::pi * std::sqrt(m / k),
              1e-15);
  EXPECT_NEAR(compliant_law("linear").contact_time(k, m, 0.0), std::numbers::pi * std::sqrt(m / k),
              1e-15);
  const double peak = std::pow(5 * m * w0 * w0 / (4 * k), 0.4);
  EXPECT_NEAR(compliant_law("hertz").contact_time(k, m, w0) * w0 / peak, 2.9432, 1e-4);
  EXPECT_NEAR(compliant_law("hertz").contact_time(k, m, w0),
              3.2180 * std::pow(m * m / (k * k * w0), 0.2), 1e-4 * 3.218 * 0.02);
  EXPECT_EQ(compliant_law("hertz").contact_time(k, m, 0.0),
            std::numeric_limits<double>::infinity());
}

TEST(CompliantLaw, HystereticDampingIsLeftOutOfAContactThatClosedAtRest) {
  const auto& law = compliant_law("ye");
  const auto f = law.force({3e4, 2.5, law.damping(0.5), 0.0}, 1e-3, 0.5);
  EXPECT_DOUBLE_EQ(f.value, 3e4 * std::pow(1e-3, 1.5));
}

TEST(CompliantLaw, SpringAndDamperStopAllMotionWhereRestitutionIsZero) {
  EXPECT_EQ(compliant_law("kelvin-voigt").damping(0.0), 1.0);  // critical
}

TEST(CompliantLaw, OnlyOneVariantOfSpringAndDamperPulls) {
  const auto pull = [](const char* name) {
    const auto& law = compliant_law(name);
    return law.force({3e4, 2.5, law.damping(0.5), 0.7}, 1e-6, -0.5).value;
  };
  EXPECT_LT(pull("kelvin-voigt"), 0.0);
  EXPECT_EQ(pull("kelvin-voigt-no-tension"), 0.0);
}

TEST(CompliantLaw, OfAnotherNameIsAnErrorOfTheProgram) {
  EXPECT_THROW(compliant_law("herz"), std::logic_error);
}

}  // namespace
}  // namespace clackers::methods
