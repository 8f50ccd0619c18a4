#include "clackers/exact/quantities/variation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/synchronized_pair.hpp"

namespace clackers::exact {
namespace {

using model::Side;

// Free flight of mass i over t, as a matrix on (u, v).
Eigen::Matrix2d flight(const model::ImpactProblem<>& p, Eigen::Index i, double t) {
  const double s = p.system.damping(i, i) / (2.0 * p.system.mass(i, i));
  const double square = p.system.stiffness(i, i) / p.system.mass(i, i),
               w = std::sqrt(square - s * s);
  const double c = std::cos(w * t), n = std::sin(w * t) / w;
  Eigen::Matrix2d f;
  f << c + s * n, n, -square * n, c - s * n;
  return std::exp(-s * t) * f;
}

Eigen::Matrix4d flights(const model::ImpactProblem<>& p, double t) {
  Eigen::Matrix4d all = Eigen::Matrix4d::Zero();
  for (Eigen::Index i = 0; i < 2; ++i) {
    const auto f = flight(p, i, t);
    all(i, i) = f(0, 0);
    all(i, i + 2) = f(0, 1);
    all(i + 2, i) = f(1, 0);
    all(i + 2, i + 2) = f(1, 1);
  }
  return all;
}

TEST(FirstVariation, IsFlightsAndSaltationMatricesMultipliedOneByOne) {
  const double r = 1.5, eta = 0.75;
  const SynchronizedPair motion({.m1 = 2.0, .k1 = 3.0, .xi1 = 0.1, .X = 3.0, .r = r, .eta = eta});
  const auto problem = motion.problem();
  const double T = motion.constants().period;
  Eigen::Matrix2d J;
  J << 1.0 - (1.0 + eta) / (1.0 + r), (1.0 + eta) / (1.0 + r), (1.0 + eta) * r / (1.0 + r),
      1.0 - (1.0 + eta) * r / (1.0 + r);
  Eigen::Matrix4d jump = Eigen::Matrix4d::Zero();
  jump.topLeftCorner(2, 2) = jump.bottomRightCorner(2, 2) = J;
  EXPECT_EQ(first_variation(motion, 0.0, Side::right), Eigen::Matrix4d::Identity());
  for (const double t : {0.3 * T, 0.7 * T, 1.9 * T, 3.2 * T}) {
    Eigen::Matrix4d product = flights(problem, std::min(t, 0.5 * T));
    for (double now = 0.5 * T; now < t; now += T)
      product = flights(problem, std::min(T, t - now)) * jump * product;
    // Some hundred roundings of numbers up to X omega ~ 4.
    EXPECT_LE((first_variation(motion, t, Side::right) - product).norm(), 1e-13 * product.norm())
        << t;
  }
  EXPECT_THROW(first_variation(motion, 21.0, Side::left), InputError);
}

TEST(FirstVariation, OfAnElasticPairNeitherGrowsNorShrinksButByDamping) {
  // J^2 = 1 and a flight over T is -e: two periods on it is e^2 times itself.
  const SynchronizedPair motion({.xi1 = 0.03, .t_end = 700.0});
  const double T = motion.constants().period, sigma = motion.constants().sigma;
  const double t = 2.3;
  const auto now = first_variation(motion, t, Side::right);
  const auto later = first_variation(motion, t + 200.0 * T, Side::right);
  // t + 200 T is rounded to 2^-44, times X omega.
  EXPECT_LE((later - std::exp(-200.0 * sigma * T) * now).norm(), 1e-11 * later.norm());
}

}  // namespace
}  // namespace clackers::exact
