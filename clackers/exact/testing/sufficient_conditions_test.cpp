// Conditions 4 and 6 of section 2.2 of the paper and its Eq. (12) are sufficient, not necessary:
// motions that break one of them and still collide at equilibrium only, equally spaced. Simulated
// with 90 digits, from impact to impact, each first contact proven.
#include <gtest/gtest.h>

#include "clackers/exact/testing/impact_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::exact {
namespace {

using testing_oracle::ImpactSimulator;
using testing_oracle::pi;
using testing_oracle::RawPair;
using testing_oracle::RawPairImpact;
using testing_oracle::Real;

// Elastic, m1/m2 = 3, damped frequencies 1 and 5, just after an impact: time between impacts pi.
RawPair after_an_impact(const Real& sigma1, const Real& sigma2, const Real& v1, const Real& v2) {
  return {
      3,  1, 3 * (1 + sigma1 * sigma1), 25 + sigma2 * sigma2, 6 * sigma1, 2 * sigma2, 1, 0, 0, 0,
      v1, v2};
}

// The next `count` impacts; all must be at equilibrium and `spacing` apart.
std::vector<RawPairImpact> expect_synchronized(const RawPair& pair, int count, Real t,
                                               const Real& spacing) {
  ImpactSimulator simulator(pair);
  std::vector<RawPairImpact> hits;
  for (int k = 1; k <= count; ++k, t += spacing) {
    const auto hit = simulator.next(Real(1000));
    EXPECT_TRUE(hit) << "impact " << k;
    if (!hit) break;
    EXPECT_LE(abs(hit->before.t - t), Real("1e-60")) << "impact " << k;
    for (const auto& u : hit->before.u) EXPECT_LE(abs(u), Real("1e-60")) << "impact " << k;
    hits.push_back(*hit);
  }
  return hits;
}

TEST(SufficientConditions, MomentaNeedNotBeEqualAndOpposite) {
  // Condition 4 would have v2 = -3. The map of velocities after an impact, -J, is its own inverse:
  // every second impact leaves them as they were, and between impacts v2/v1 = -2.9 or -59/19, both
  // above -r*(5) = -4.
  const auto hits = expect_synchronized(after_an_impact(0, 0, 1, Real("-2.9")), 12, pi(), pi());
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const auto &v = hits[k].before.v, &w = hits[k].after.v;
    // 0.1 kg m/s after the start; each half period turns the momentum about.
    EXPECT_NEAR(double(3 * v[0] + v[1]), k % 2 == 0 ? -0.1 : 0.1, 1e-15);
    EXPECT_NEAR(double(w[1] / w[0]), k % 2 == 0 ? -59.0 / 19.0 : -2.9, 1e-14);
  }
}

TEST(SufficientConditions, StartsNeedNotBeAtZeroPhase) {
  // The pair of Eq. (25), N = 1, xi1 = 0.1, from 0.3 of the first flight on: no phase is 0 there.
  const Real xi1("0.1"), omega = sqrt(1 - xi1 * xi1), first = pi() / (2 * omega),
                         t0 = first * 3 / 10;
  const Real c1 = cos(omega * t0), s1 = sin(omega * t0);
  const Real c2 = cos(5 * omega * t0), s2 = sin(5 * omega * t0), d2 = Real(-3) / 5;
  const RawPair pair{1,
                     Real(1) / 3,
                     1,
                     (25 * omega * omega + xi1 * xi1) / 3,
                     2 * xi1,
                     2 * xi1 / 3,
                     1,
                     0,
                     c1,
                     d2 * c2,
                     -xi1 * c1 - omega * s1,
                     -d2 * (xi1 * c2 + 5 * omega * s2)};
  expect_synchronized(pair, 8, first - t0, pi() / omega);
}

TEST(SufficientConditions, RatesOfDecayNeedNotBeEqual) {
  // Eq. (12) is sigma1 = sigma2. Otherwise the velocities after impacts are multiplied by -J E, E =
  // diag(e1, e2), e_i = exp(-sigma_i pi): with r = 3, eta = 1, -J = (-1 -1; -3 1)/2. Its positive
  // eigenvalue is lambda = (e2 - e1)/4 + sqrt((e2 - e1)^2/16 + e1 e2).
  const Real sigma1("0.05"), sigma2("0.03");
  const Real e1 = exp(-sigma1 * pi()), e2 = exp(-sigma2 * pi()), quarter = (e2 - e1) / 4;
  const Real lambda = quarter + sqrt(quarter * quarter + e1 * e2);
  const Real v2 = -(e1 + 2 * lambda) / e2;
  const auto hits = expect_synchronized(after_an_impact(sigma1, sigma2, 1, v2), 12, pi(), pi());
  ASSERT_EQ(hits.size(), 12U);
  const Real after_all = pow(lambda, 12);
  EXPECT_LE(abs(hits.back().after.v[0] - after_all), Real("1e-60"));
  EXPECT_LE(abs(hits.back().after.v[1] - v2 * after_all), Real("1e-60"));
  EXPECT_NEAR(double(v2), -2.90793, 1e-5);  // not -3
}

}  // namespace
}  // namespace clackers::exact
