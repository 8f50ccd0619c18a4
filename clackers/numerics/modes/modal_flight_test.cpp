#include "clackers/numerics/modes/modal_flight.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "clackers/numerics/linear_algebra.hpp"

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

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// e^(A s) by squaring a Taylor series, in long double.
Matrix exponential(Matrix a, double s) {
  const int squarings = 20;
  a *= (long double)(s) / std::exp2((long double)squarings);
  Matrix sum = Matrix::Identity(a.rows(), a.rows()), term = sum;
  for (int k = 1; k <= 8; ++k) sum += term = term * a / (long double)k;
  for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
  return sum;
}

void expect_follows_exponential(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
                                const Eigen::MatrixXd& stiffness) {
  const auto system = ModalSystem::make(mass, damping, stiffness);
  ASSERT_TRUE(system);
  const auto n = mass.rows();
  Matrix a = Matrix::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  const Matrix inverse = mass.cast<long double>().inverse();
  a.bottomLeftCorner(n, n) = -inverse * stiffness.cast<long double>();
  a.bottomRightCorner(n, n) = -inverse * damping.cast<long double>();
  Eigen::VectorXd start(2 * n), u(n), v(n);
  for (Eigen::Index i = 0; i < 2 * n; ++i) start[i] = std::cos(1.7 * double(i));
  std::vector<ModalState> modes{std::size_t(n)};
  const auto size = std::size_t(n);
  system->to_modes({start.data(), size}, {start.data() + n, size}, modes);
  for (const double s : {0.0, 0.3, 2.0, 6.0}) {
    system->sample(modes, s, {u.data(), size}, {v.data(), size});
    const Eigen::VectorXd known = (exponential(a, s) * start.cast<long double>()).cast<double>();
    // The condition of the eigenvectors and phases of up to 40 radians, in units of 2^-53.
    const double allowed = 3e-13 * std::max(1.0, known.cwiseAbs().maxCoeff());
    EXPECT_LT((u - known.head(n)).cwiseAbs().maxCoeff(), allowed) << s;
    EXPECT_LT((v - known.tail(n)).cwiseAbs().maxCoeff(), allowed * 7.0) << s;
  }
}

Eigen::MatrixXd matrix(std::initializer_list<double> entries) {
  const auto n = Eigen::Index(std::lround(std::sqrt(double(entries.size()))));
  Eigen::MatrixXd made(n, n);
  auto entry = entries.begin();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) made(i, j) = *entry++;
  return made;
}

TEST(ModalFlight, DampingThatCouplesModesHasComplexOnes) {
  const auto mass = matrix({2, 0.3, 0, 0.3, 1, 0, 0, 0, 0.7});
  const auto stiffness = matrix({30, -7, 0, -7, 9, -2, 0, -2, 8});
  expect_follows_exponential(mass, matrix({0.5, 0, 0, 0, 0, 0, 0, 0, 0.1}), stiffness);
  // One mass overdamped, the others not.
  expect_follows_exponential(mass, matrix({0.5, -0.2, 0, -0.2, 20, 0, 0, 0, 0.1}), stiffness);
  // All overdamped.
  expect_follows_exponential(mass, matrix({25, -2, 0, -2, 30, 0, 0, 0, 40}), stiffness);
  // Growing.
  expect_follows_exponential(mass, matrix({-0.2, 0, 0, 0, 0.3, 0, 0, 0, 0.1}), stiffness);
}

TEST(ModalFlight, RigidBodiesEqualFrequenciesAndUnstableEquilibriaAreSumsOfModes) {
  // Two free masses with a dashpot and a spring between them, and a third on its own.
  expect_follows_exponential(matrix({2, 0, 0, 0, 1, 0, 0, 0, 3}),
                             matrix({1, -1, 0, -1, 1, 0, 0, 0, 0.2}),
                             matrix({5, -5, 0, -5, 5, 0, 0, 0, 4}));
  // A dashpot alone.
  expect_follows_exponential(matrix({2, 0, 0, 1}), matrix({1, -1, -1, 1}), matrix({0, 0, 0, 0}));
  // Equal frequencies that damping tells apart.
  expect_follows_exponential(matrix({1, 0, 0, 0, 1, 0, 0, 0, 1}),
                             matrix({0.5, -0.2, 0, -0.2, 0.9, 0.3, 0, 0.3, 0.4}),
                             matrix({4, 0, 0, 0, 4, 0, 0, 0, 4}));
  expect_follows_exponential(matrix({1, 0, 0, 1}), matrix({0.1, 0, 0, 0.1}),
                             matrix({-0.5, 0.2, 0.2, 3}));
}

TEST(ModalFlight, RefusesWhatIsNoSumOfModes) {
  const auto one = matrix({1, 0, 0, 1});
  EXPECT_FALSE(ModalSystem::make(-one, one, one));
  EXPECT_FALSE(ModalSystem::make(one, one, matrix({1, 0, 0, std::nan("")})));
  // Two masses of equal frequencies, of which damping couples one with the other: critical coupled
  // damping, found where two eigenvalues of the first-order equations meet.
  const auto stiffness = matrix({1, 0, 0, 4});
  const auto closest = [&](double c) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 4);
    a.topRightCorner(2, 2).setIdentity();
    a.bottomLeftCorner(2, 2) = -stiffness;
    a.bottomRightCorner(2, 2) = -matrix({c, -1, -1, 1});
    return eigenvalues(a).imag().cwiseAbs().minCoeff() > 0.0;
  };
  double oscillating = 1.5, damped = 50.0;
  ASSERT_TRUE(closest(oscillating));
  ASSERT_FALSE(closest(damped));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (oscillating + damped);
    (closest(middle) ? oscillating : damped) = middle;
  }
  EXPECT_FALSE(ModalSystem::make(one, matrix({damped, -1, -1, 1}), stiffness));
  EXPECT_TRUE(ModalSystem::make(one, matrix({1.01 * damped, -1, -1, 1}), stiffness));
}

TEST(ModalFlight, OfNoDegreesOfFreedomIsEmpty) {
  const Eigen::MatrixXd none(0, 0);
  const auto system = ModalSystem::make(none, none, none);
  ASSERT_TRUE(system);
  EXPECT_EQ(system->dof(), 0);
}

}  // namespace
}  // namespace clackers::numerics
