#include "clackers/numerics/modal_flight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace clackers::numerics {
namespace {

using Complex = std::complex<long double>;

// By the two roots of the characteristic equation, in complex long double.
ModalState by_roots(double sigma, double square, double y, double rate, double s) {
  const Complex root = std::sqrt(Complex((long double)(sigma)*sigma - square));
  const Complex a = -Complex(sigma) + root, b = -Complex(sigma) - root;
  const Complex p = (Complex(rate) - b * Complex(y)) / (a - b), q = Complex(y) - p;
  const Complex ea = std::exp(a * Complex(s)), eb = std::exp(b * Complex(s));
  return {double((p * ea + q * eb).real()), double((a * p * ea + b * q * eb).real())};
}

TEST(ModalFlight, FollowsTheCharacteristicRootsForEveryKindOfDamping) {
  for (const auto& [sigma, square] :
       {std::array{0.05, 1.0}, {0.0, 81.0}, {-0.03, 4.0}, {3.0, 2.0}, {0.7, 0.0}, {200.0, 1.0}})
    for (const double s : {0.0, 0.01, 1.0, 7.3}) {
      const auto now = advance(Mode(sigma, square), {0.3, -1.1}, s);
      const auto known = by_roots(sigma, square, 0.3, -1.1, s);
      // Phases of up to 66 radians, each rounded to 2^-53 of itself.
      const double size = std::hypot(known.y, known.rate) + 1e-3;
      EXPECT_NEAR(now.y, known.y, 1e-14 * size * (1.0 + s * std::sqrt(square))) << sigma << s;
      EXPECT_NEAR(now.rate, known.rate, 1e-13 * size * (1.0 + s * square)) << sigma << s;
    }
}

TEST(ModalFlight, CriticalAndFreeMotionsAreTheirPolynomials) {
  const auto critical = advance(Mode(2.0, 4.0), {0.5, 0.25}, 1.5);
  EXPECT_NEAR(critical.y, std::exp(-3.0) * (0.5 + 1.25 * 1.5), 1e-16);
  EXPECT_NEAR(critical.rate, std::exp(-3.0) * (0.25 - 2.0 * 1.25 * 1.5), 1e-15);
  const auto free = advance(Mode(0.0, 0.0), {0.5, 0.25}, 8.0);
  EXPECT_EQ(free.y, 2.5);
  EXPECT_EQ(free.rate, 0.25);
}

TEST(ModalFlight, CoupledMassesObeyTheirEquationOfMotion) {
  Eigen::MatrixXd mass(2, 2), stiffness(2, 2);
  mass << 2.0, 0.3, 0.3, 1.0;
  stiffness << 30.0, -7.0, -7.0, 9.0;
  const Eigen::MatrixXd damping = 0.1 * mass + 0.02 * stiffness;
  const auto system = ModalSystem::make(mass, damping, stiffness);
  ASSERT_TRUE(system);
  const std::vector<double> u0{0.3, -0.2}, v0{1.0, 0.4};
  std::vector<ModalState> modes(2);
  system->to_modes(u0, v0, modes);
  const auto at = [&](double s) {
    std::array<Eigen::VectorXd, 2> state{Eigen::VectorXd(2), Eigen::VectorXd(2)};
    system->sample(modes, s, {state[0].data(), 2}, {state[1].data(), 2});
    return state;
  };
  EXPECT_NEAR(at(0.0)[0][1], -0.2, 1e-15);
  EXPECT_NEAR(at(0.0)[1][0], 1.0, 1e-15);
  const double h = 1e-4;  // central differences err by h^2/6 times u'''' of 100, rounding by 1e-12
  for (const double t : {0.4, 1.7, 5.0}) {
    const auto [u, v] = at(t);
    const Eigen::VectorXd a = (at(t + h)[1] - at(t - h)[1]) / (2.0 * h);
    EXPECT_LT((mass * a + damping * v + stiffness * u).cwiseAbs().maxCoeff(), 1e-5) << t;
    EXPECT_LT(((at(t + h)[0] - at(t - h)[0]) / (2.0 * h) - v).cwiseAbs().maxCoeff(), 1e-6) << t;
  }
}

TEST(ModalFlight, RefusesDampingThatCouplesModes) {
  Eigen::MatrixXd stiffness(2, 2), damping = Eigen::MatrixXd::Zero(2, 2);
  stiffness << 30.0, -7.0, -7.0, 9.0;
  damping(0, 0) = 0.5;
  EXPECT_FALSE(ModalSystem::make(Eigen::MatrixXd::Identity(2, 2), damping, stiffness));
  const Eigen::MatrixXd uncoupled = stiffness.diagonal().asDiagonal();
  EXPECT_TRUE(ModalSystem::make(Eigen::MatrixXd::Identity(2, 2), damping, uncoupled));
  EXPECT_FALSE(ModalSystem::make(-Eigen::MatrixXd::Identity(2, 2), damping, uncoupled));
}

TEST(FirstRoot, FindsTheFirstOfTwoNearbyRoots) {
  // cos s + 1 - dip is below 0 for sqrt(8 dip) around pi.
  for (const double dip : {1e-3, 1e-6, 1e-9}) {
    const auto f = [&](double s) {
      return LocalBound{std::cos(s) + 1.0 - dip, -std::sin(s), 1.0, 1e9};
    };
    const auto root = first_root(f, 0.0, 100.0, 1e-9, 100000);
    ASSERT_EQ(root.status, FirstRoot::Status::found);
    const double known = std::numbers::pi - std::acos(1.0 - dip);
    // The slope there is sqrt(2 dip); f is rounded to 2^-52.
    EXPECT_NEAR(root.s, known, 4.0 * 0x1p-52 / std::sqrt(2.0 * dip) + 1e-15) << dip;
  }
}

TEST(FirstRoot, SaysWhetherThereIsNone) {
  const auto above = [](double s) {
    return LocalBound{std::cos(s) + 1.01, -std::sin(s), 1.0, 1e9};
  };
  EXPECT_EQ(first_root(above, 0.0, 50.0, 1e-9, 100000).status, FirstRoot::Status::none);
  EXPECT_EQ(first_root(above, 0.0, 50.0, 1e-9, 3).status, FirstRoot::Status::undecided);
  const auto line = [](double s) { return LocalBound{1.0 - s, -1.0, 0.0, 0.3}; };
  EXPECT_NEAR(first_root(line, 0.0, 50.0, 1e-9, 100).s, 1.0, 1e-15);
  EXPECT_EQ(first_root(line, 0.0, 0.9, 1e-9, 100).status, FirstRoot::Status::none);
}

}  // namespace
}  // namespace clackers::numerics
