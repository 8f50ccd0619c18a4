#include "clackers/exact/quantities/quantities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/testing/impact_simulator.hpp"

namespace clackers::exact {
namespace {

// One impact of a simulation: time since the one before, and the velocities just after it.
struct PairImpact {
  double spacing, v1, v2;
};

// Impacts of an undamped pair, slow mass m1 = r and fast m2 = 1, started just after an impact
// with velocities (1 + push, -r); frequencies 1 and X (1 + eps). Knows no closed form: Newton's
// method finds each contact on the free flights.
std::vector<PairImpact> simulate(double X, double r, double eta, double eps, double push,
                                 int count) {
  const double w = X * (1.0 + eps);
  double u = 0.0, v1 = 1.0 + push, v2 = -r;
  std::vector<PairImpact> list;
  for (int k = 0; k < count; ++k) {
    const auto u1 = [&](double t) { return u * std::cos(t) + v1 * std::sin(t); };
    const auto u2 = [&](double t) { return u * std::cos(w * t) + v2 / w * std::sin(w * t); };
    const auto rate1 = [&](double t) { return v1 * std::cos(t) - u * std::sin(t); };
    const auto rate2 = [&](double t) { return v2 * std::cos(w * t) - u * w * std::sin(w * t); };
    double t = std::numbers::pi;
    for (int i = 0; i < 40; ++i) t -= (u1(t) - u2(t)) / (rate1(t) - rate2(t));
    const double a = rate1(t), b = rate2(t), impulse = -(1.0 + eta) * (a - b) * r / (1.0 + r);
    u = u1(t);
    v1 = a + impulse / r;
    v2 = b - impulse;
    list.push_back({t, v1, v2});
  }
  return list;
}

std::vector<double> spacings(double X, double r, double eps, int count) {
  std::vector<double> list;
  for (const auto& impact : simulate(X, r, 1.0, eps, 0.0, count)) list.push_back(impact.spacing);
  return list;
}

// cosh of the growth over `stride` impacts: differences d of every second spacing obey
// d(k + stride) + d(k - stride) = 2 cosh(growth) d(k), which removes the constant part and the
// alternation of an elastic impact.
double hyperbolic_cosine(const std::vector<double>& s, std::size_t k, std::size_t stride) {
  const auto d = [&](std::size_t i) { return s[i + 2] - s[i]; };
  return 0.5 * (d(k + stride) + d(k - stride)) / d(k);
}

TEST(Conditioning, DetuningRateIsTheGrowthOfASimulation) {
  constexpr double eps = 1e-4;
  for (const auto& [X, r] :
       {std::pair{9.0, 3.0}, {5.0, 2.0}, {13.0, 1.5}, {9.0, 4.2}, {3.0, 2.0}}) {
    const double rate = detuning_rate({X, false}, r);
    const auto stride = 2 * static_cast<std::size_t>(0.25 / (rate * eps));
    const auto s = spacings(X, r, eps, static_cast<int>(4 * stride + 3));
    const double growth = std::acosh(hyperbolic_cosine(s, 2 * stride, stride)) / double(stride);
    // The law is of first order in eps; the next order was seen at 2e-5 ... 1e-4 relative.
    EXPECT_NEAR(growth / (rate * eps), 1.0, 1e-3) << X << " " << r;
  }
}

TEST(Conditioning, ALightSlowMassOscillatesInsteadOfGrowing) {
  EXPECT_EQ(detuning_rate({9.0, false}, 0.5), 0.0);
  const auto s = spacings(9.0, 0.5, 1e-4, 20000);
  double worst = 0.0;
  for (const double spacing : s) worst = std::max(worst, std::abs(spacing - std::numbers::pi));
  // It starts at 1.047e-4 and was seen to stay within 1.0483e-4.
  EXPECT_LT(worst, 1.1e-4);
  EXPECT_EQ(detuning_rate({1.0, false}, 3.0), 0.0);
  EXPECT_EQ(detuning_rate({9.0, false}, 1.0), 0.0);
}

TEST(Conditioning, ARelativeErrorGrowsByOneOverEtaAtEachImpact) {
  // The total momentum should be zero. An impact keeps it and half a period turns it round, while
  // the motion itself shrinks by eta.
  const auto relative_momentum = [](const PairImpact& c) { return (0.5 * c.v1 + c.v2) / c.v1; };
  for (const double eta : {1.0, 0.75, 0.5}) {
    const auto run = simulate(5.0, 0.5, eta, 0.0, 1e-6, 9);
    const double growth = std::abs(relative_momentum(run[8]) / relative_momentum(run[0]));
    // The push is 1e-6, its square is what the law leaves out; eta^-8 <= 256 magnifies it.
    EXPECT_NEAR(growth * std::pow(eta, 8), 1.0, 1e-3) << eta;
    EXPECT_EQ(conditioning({5.0, false}, 0.5, eta),
              eta < 1.0 ? Conditioning::growing : Conditioning::neutral);
  }
}

TEST(Conditioning, NamesTheKind) {
  const FrequencyRatio one{1.0, false}, nine{9.0, false}, ninth{9.0, true};
  EXPECT_EQ(conditioning(nine, 3.0, 1.0), Conditioning::detuning_fragile);
  EXPECT_EQ(conditioning(nine, 0.5, 1.0), Conditioning::neutral);
  EXPECT_EQ(conditioning(nine, 1.0, 1.0), Conditioning::neutral);
  EXPECT_EQ(conditioning(one, 3.0, 1.0), Conditioning::neutral);
  EXPECT_EQ(conditioning(nine, 0.5, 0.9), Conditioning::growing);
  EXPECT_EQ(conditioning(nine, 3.0, 0.0), Conditioning::growing);
  EXPECT_EQ(conditioning(one, 1.0, 0.999), Conditioning::growing);
  // Exchanged roles: the slow mass is mass 2.
  EXPECT_EQ(conditioning(ninth, 0.5, 1.0), Conditioning::detuning_fragile);
  EXPECT_EQ(conditioning(ninth, 2.0, 1.0), Conditioning::neutral);
  EXPECT_EQ(detuning_rate(ninth, 0.25), detuning_rate(nine, 4.0));
}

// The first impact after which a simulation's spacing is off by a tenth.
double lost_after(double X, double r, double eps, int most) {
  const auto list = spacings(X, r, eps, most);
  for (std::size_t k = 0; k < list.size(); ++k)
    if (std::abs(list[k] / std::numbers::pi - 1.0) > lost_synchrony) return double(k + 1);
  return INFINITY;
}

TEST(Conditioning, DetuningLosesSynchronyAboutWhenItSays) {
  // Nothing but detuning, from an undisturbed start: ratios seen, to 1 %.
  const struct {
    double X, r, eps, seen;
  } table[] = {{9.0, 3.0, -8.225e-3, 1.677}, {9.0, 3.0, -5.14e-4, 1.328},
               {9.0, 3.0, 5.14e-4, 1.318},   {5.0, 2.0, 1e-3, 1.414},
               {13.0, 4.0, 1e-3, 1.345},     {3.0, 2.0, 1e-3, 1.533},
               {9.0, 1.5, 1e-3, 1.212}};
  for (const auto& [X, r, eps, seen] : table) {
    const double predicted = impacts_until_detuning({X, false}, r, 1.0, eps);
    const double lost = lost_after(X, r, eps, static_cast<int>(3.0 * predicted));
    EXPECT_NEAR(lost / predicted, seen, 0.01)
        << X << " " << r << " " << eps << " predicted " << predicted;
  }
  EXPECT_EQ(lost_after(9.0, 0.5, 1e-3, 20000), INFINITY);
  EXPECT_EQ(impacts_until_detuning({9.0, false}, 0.5, 1.0, 1e-3), INFINITY);
}

TEST(Conditioning, DispersionLosesSynchronyWhenASolverWasSeenToLoseIt) {
  // average-acceleration Newmark, X = 9, r = 3, steps a fast period. Its
  // frequency is (2/h) atan(omega h/2).
  for (const auto& [steps, seen] :
       {std::pair{20.0, 64.0}, {40.0, 396.0}, {80.0, 2152.0}, {160.0, 10920.0}}) {
    const auto factor = [&](double angle) { return std::atan(angle) / angle; };
    const double angle = std::numbers::pi / steps;
    const double eps = factor(angle) / factor(angle / 9.0) - 1.0;
    EXPECT_NEAR(impacts_until_detuning({9.0, false}, 3.0, 1.0, eps) / seen, 1.0, 0.05) << steps;
  }
}

TEST(Conditioning, APerturbationReachesATenthWhenEtaHasMultipliedItThere) {
  // 0.1/1e-6 = 1e5 lies between 2^16 and 2^17.
  EXPECT_EQ(impacts_until_perturbation(0.5, 1e-6), 17.0);
  EXPECT_EQ(impacts_until_perturbation(1.0, 1e-6), INFINITY);
  // The next impact after it cannot come before it.
  EXPECT_EQ(impacts_until_perturbation(0.0, 1e-6), 1.0);
  EXPECT_EQ(impacts_until_perturbation(1.0, 0.1), 0.0);
  // A simulation whose first mass is pushed by 1e-6 after an impact.
  const auto run = simulate(5.0, 0.5, 0.5, 0.0, 1e-6, 20);
  double spacing = 0.0;
  int lost = 0;
  for (int k = 0; k < 20 && lost == 0; ++k) {
    spacing = run[std::size_t(k)].spacing;
    const double momentum =
        std::abs((0.5 * run[std::size_t(k)].v1 + run[std::size_t(k)].v2) / run[std::size_t(k)].v1);
    // A push of 1e-6 is half of that in momentum.
    if (momentum > 0.5 * lost_synchrony ||
        std::abs(spacing / std::numbers::pi - 1.0) > lost_synchrony)
      lost = k + 1;
  }
  EXPECT_NEAR(lost, 17, 1);
  // Each impact adds the detuning anew, each multiplies it by 1/eta.
  EXPECT_EQ(impacts_until_detuning({9.0, false}, 0.5, 0.5, -1e-6), 17.0);
}

// The impact after which a detuned pair is first spaced wrongly by a tenth, from the exact start
// at t = 0: the gap is sampled 40 times a fast half period, and bisected where it changes its sign.
double sampled_loss(double X, double r, double eta, double eps, int most) {
  const double w = X * (1.0 + eps), step = std::numbers::pi / (40.0 * X);
  const double s = std::fmod(X, 4.0) == 1.0 ? 1.0 : -1.0;
  double a1 = 1.0, b1 = 0.0, a2 = -s * r / X, b2 = 0.0, start = -0.5 * std::numbers::pi;
  for (int k = 1; k <= most; ++k) {
    const auto u1 = [&](double t) { return a1 * std::cos(t) + b1 * std::sin(t); };
    const auto gap = [&](double t) { return u1(t) - a2 * std::cos(w * t) - b2 * std::sin(w * t); };
    double above = step;
    // A graze at the start of a flight is no contact: sampling begins a step after it.
    while (gap(above) > 0.0) above += step;
    double below = above - step;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (below + above);
      (middle > 0.1 * step && gap(middle) <= 0.0 ? above : below) = middle;
    }
    const double u = u1(above);
    const double v1 = b1 * std::cos(above) - a1 * std::sin(above);
    const double v2 = w * (b2 * std::cos(w * above) - a2 * std::sin(w * above));
    const double impulse = -(1.0 + eta) * (v1 - v2) * r / (1.0 + r);
    a1 = a2 = u;
    b1 = v1 + impulse / r;
    b2 = (v2 - impulse) / w;
    if (std::abs((above - start) / std::numbers::pi - 1.0) > lost_synchrony) return k;
    start = 0.0;
  }
  return INFINITY;
}

TEST(Conditioning, DetuningAndRestitutionTogetherLoseSynchronyAsSimulated) {
  const struct {
    double X, r, eta, eps;
  } table[] = {{9.0, 3.0, 0.999999, 0.01}, {9.0, 3.0, 0.999999, 0.001}, {21.0, 3.0, 0.999, 0.01},
               {9.0, 3.0, 0.99, 0.01},     {9.0, 0.5, 0.9, 0.01},       {9.0, 3.0, 0.5, 0.001}};
  for (const auto& [X, r, eta, eps] : table)
    for (const double signed_eps : {eps, -eps}) {
      const double found = impacts_until_detuning({X, false}, r, eta, signed_eps);
      // Detuning alone starts below |eps|: at most 2.6 times later (r < 1: the growth oscillates).
      const double seen = sampled_loss(X, r, eta, signed_eps, 2000);
      EXPECT_LE(found, seen) << X << " " << r << " " << eta << " " << signed_eps;
      EXPECT_GE(found, seen / 2.6) << X << " " << r << " " << eta << " " << signed_eps;
    }
  // Numbers of another simulation: 48, 950, 15, 40.
  EXPECT_NEAR(impacts_until_detuning({9.0, false}, 3.0, 0.999999, 0.01), 48.0, 2.0);
  EXPECT_NEAR(impacts_until_detuning({9.0, false}, 3.0, 0.999999, 0.001), 950.0, 40.0);
  EXPECT_NEAR(impacts_until_detuning({21.0, false}, 3.0, 0.999, 0.01), 15.0, 5.0);
  EXPECT_NEAR(impacts_until_detuning({9.0, false}, 3.0, 0.99, 0.01), 40.0, 2.0);
}

// The same with 90 digits and no sampling, so that no short contact is missed.
double proved_loss(double X, double r, double eps, int most) {
  using testing_oracle::Real;
  const Real w = Real(X) * (1 + Real(eps)), m2 = 1 / Real(r);
  const Real pi(
      "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899");
  const double s = std::fmod(X, 4.0) == 1.0 ? 1.0 : -1.0;
  testing_oracle::ImpactSimulator simulator(
      {1, m2, 1, m2 * w * w, 0, 0, 1, 0, 1, -s * Real(r) / Real(X), 0, 0});
  Real last = -pi / 2;
  for (int k = 1; k <= most; ++k) {
    const auto hit = simulator.next(Real(1e6));
    if (abs((hit->before.t - last) / pi - 1) > lost_synchrony) return k;
    last = hit->before.t;
  }
  return INFINITY;
}

TEST(Conditioning, DetuningNearTheLimitOfAdmissibilityIsLostAsSimulated) {
  const double below_3 = std::nextafter(3.0, 0.0);
  for (const double eps : {-0.01, -0.001, 0.01})
    EXPECT_EQ(impacts_until_detuning({3.0, false}, below_3, 1.0, eps),
              proved_loss(3.0, below_3, eps, 100))
        << eps;
  for (const double eps : {-0.01, 0.01}) {
    const double found = impacts_until_detuning({5.0, false}, 3.9999, 1.0, eps);
    EXPECT_EQ(found, proved_loss(5.0, 3.9999, eps, 100)) << eps;
    EXPECT_EQ(impacts_until_detuning({5.0, true}, 1.0 / 3.9999, 1.0, eps), found) << eps;
  }
  EXPECT_EQ(impacts_until_detuning({5.0, false}, 3.9999, 1.0, -0.01), 1.0);
}

TEST(Conditioning, APlasticPairIsNotLostBeforeItsFirstImpact) {
  for (const double eta : {0.0, 1e-300}) {
    EXPECT_EQ(impacts_until_perturbation(eta, 0x1p-53), 1.0) << eta;
    EXPECT_EQ(impacts_until_detuning({9.0, false}, 3.0, eta, 1e-6), 1.0) << eta;
  }
}

TEST(Conditioning, RefusesSizesThatAreNone) {
  for (const double size : {0.0, 1.0, -2.0, double(NAN)}) {
    EXPECT_THROW(impacts_until_perturbation(0.5, size), InputError);
    EXPECT_THROW(impacts_until_detuning({9.0, false}, 3.0, 1.0, size), InputError);
  }
  EXPECT_THROW(impacts_until_perturbation(0.5, -1e-3), InputError);
}

TEST(Conditioning, RateOfThePapersPairIsThreeHalvesPi) {
  // X = 9, r = 3: sqrt(2 * 72 / 64) = 3/2.
  EXPECT_DOUBLE_EQ(detuning_rate({9.0, false}, 3.0), 1.5 * std::numbers::pi);
}

}  // namespace
}  // namespace clackers::exact
