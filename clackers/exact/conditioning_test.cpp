#include "clackers/exact/conditioning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace clackers::exact {
namespace {

// One collision of a simulation: time since the one before, and the velocities just after it.
struct Collision {
  double spacing, v1, v2;
};

// Collisions of an undamped pair, slow mass m1 = r and fast m2 = 1, started just after a collision
// with velocities (1 + push, -r); frequencies 1 and X (1 + eps). Knows no closed form: Newton's
// method finds each contact on the free flights.
std::vector<Collision> simulate(double X, double r, double eta, double eps, double push,
                                int count) {
  const double w = X * (1.0 + eps);
  double u = 0.0, v1 = 1.0 + push, v2 = -r;
  std::vector<Collision> list;
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
  for (const auto& collision : simulate(X, r, 1.0, eps, 0.0, count))
    list.push_back(collision.spacing);
  return list;
}

// cosh of the growth over `stride` collisions: differences d of every second spacing obey
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

TEST(Conditioning, ARelativeErrorGrowsByOneOverEtaAtEachCollision) {
  // The total momentum should be zero. An impact keeps it and half a period turns it round, while
  // the motion itself shrinks by eta.
  const auto relative_momentum = [](const Collision& c) { return (0.5 * c.v1 + c.v2) / c.v1; };
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

TEST(Conditioning, RateOfThePapersPairIsThreeHalvesPi) {
  // X = 9, r = 3: sqrt(2 * 72 / 64) = 3/2.
  EXPECT_DOUBLE_EQ(detuning_rate({9.0, false}, 3.0), 1.5 * std::numbers::pi);
}

}  // namespace
}  // namespace clackers::exact
