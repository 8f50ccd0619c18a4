#include "clackers/numerics/linear_algebra.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::numerics {
namespace {

std::vector<Eigen::MatrixXd> iterates(const Eigen::MatrixXd& map, const Eigen::MatrixXd& outputs,
                                      Eigen::MatrixXd state, int count) {
  std::vector<Eigen::MatrixXd> samples;
  for (int k = 0; k < count; ++k) {
    samples.push_back(outputs * state);
    state = map * state;
  }
  return samples;
}

double distance(const std::vector<std::complex<double>>& found, std::complex<double> eigenvalue) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& one : found) least = std::min(least, std::abs(one - eigenvalue));
  return least;
}

Eigen::MatrixXd coupled_mass() {
  Eigen::MatrixXd mass(3, 3);
  mass << 2.0, 0.5, 0.0, 0.5, 1.0, 0.25, 0.0, 0.25, 3.0;
  return mass;
}

TEST(Cholesky, SolvesAndKnowsWhatIsDefinite) {
  const auto mass = coupled_mass();
  const Cholesky factors(mass);
  EXPECT_TRUE((mass * factors.solve(Eigen::MatrixXd::Identity(3, 3))).isIdentity(1e-15));
  EXPECT_TRUE(factors.is_definite(mass, 1e-15));
  EXPECT_FALSE(factors.is_definite(mass, 0.999));  // the last pivot is 0.976 of its entry
  Eigen::MatrixXd indefinite = mass;
  indefinite(2, 2) = 0.0;
  EXPECT_FALSE(Cholesky(indefinite).is_definite(indefinite, 1e-15));
}

TEST(ShortestSolution, HasNoPartThatTheMatrixDoesNotSee) {
  Eigen::MatrixXd twice(2, 2), right(2, 1);
  twice << 1.0, 1.0, 1.0, 1.0;
  right << 2.0, 4.0;
  EXPECT_TRUE(shortest_solution(twice, right).isApprox(Eigen::Vector2d(1.5, 1.5), 1e-15));
}

TEST(UnseenDirections, AreOrthonormalInTheMassAndNotSeen) {
  const auto mass = coupled_mass();
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(3, 3) + Eigen::MatrixXd::Ones(3, 3);
  for (Eigen::Index count = 1; count <= 3; ++count) {
    const Eigen::MatrixXd rows = all.topRows(count);
    const auto z = unseen_directions(rows, mass);
    ASSERT_EQ(z.rows(), 3);
    ASSERT_EQ(z.cols(), 3 - count);
    if (count == 3) continue;
    EXPECT_LT((rows * z).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_TRUE((z.transpose() * mass * z).isIdentity(1e-14));
  }
}

TEST(Realization, FindsTheEigenvaluesOfAMapThatIsSeenInPart) {
  // A rotation by 1 radian that shrinks by 0.9, and two real modes, behind a change of basis.
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(4, 4);
  modes.topLeftCorner(2, 2) << 0.9 * std::cos(1.0), -0.9 * std::sin(1.0), 0.9 * std::sin(1.0),
      0.9 * std::cos(1.0);
  modes(2, 2) = -0.5;
  modes(3, 3) = 0.1;
  Eigen::MatrixXd basis(4, 4), outputs(2, 4), starts(4, 2);
  basis << 1, 2, 0, 1, 0, 1, 3, 1, 2, 0, 1, 1, 1, 1, 1, 3;
  outputs << 1, 0, 0, 0, 0, 1, 0, 0;
  starts << 1, 0, 0, 1, 1, 1, 0, 1;
  const auto found =
      eigenvalues_of_iterates(iterates(basis * modes * basis.inverse(), outputs, starts, 15));
  EXPECT_EQ(found.size(), 4u);
  for (const auto& one : {std::polar(0.9, 1.0), std::polar(0.9, -1.0),
                          std::complex<double>(-0.5, 0.0), std::complex<double>(0.1, 0.0)})
    EXPECT_LT(distance(found, one), 1e-9) << one;
}

TEST(Realization, FindsNothingInZeros) {
  EXPECT_TRUE(eigenvalues_of_iterates(std::vector(5, Eigen::MatrixXd(Eigen::MatrixXd::Zero(2, 2))))
                  .empty());
}

TEST(Realization, RefusesTooFewUnlikeAndInfiniteSamples) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2),
                        wide = Eigen::MatrixXd::Identity(2, 3),
                        infinite = one * std::numeric_limits<double>::infinity();
  for (const auto& samples : {std::vector{one, one}, {one, one, wide}, {one, one, infinite}})
    EXPECT_REFUSED(eigenvalues_of_iterates(samples), "out-of-range", "three finite matrices");
}

}  // namespace
}  // namespace clackers::numerics
