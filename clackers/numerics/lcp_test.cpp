#include "clackers/numerics/lcp.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

namespace clackers::numerics {
namespace {

using Eigen::Index;

std::vector<std::size_t> all_of(std::size_t n) {
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

// The second way: every set of positive rows is tried.
std::optional<Eigen::VectorXd> by_enumeration(const Eigen::MatrixXd& w, const Eigen::VectorXd& q) {
  const Index n = q.size();
  const double tolerance = 1e-9 * (1.0 + q.cwiseAbs().maxCoeff());
  for (int set = 0; set < (1 << n); ++set) {
    std::vector<Index> rows;
    for (Index i = 0; i < n; ++i)
      if (set >> i & 1) rows.push_back(i);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    if (!rows.empty()) {
      const Eigen::FullPivLU<Eigen::MatrixXd> factors(w(rows, rows));
      if (!factors.isInvertible()) continue;
      z(rows) = factors.solve(-q(rows));
    }
    if (z.minCoeff() >= -tolerance && (w * z + q).minCoeff() >= -tolerance) return z;
  }
  return std::nullopt;
}

// Random matrices B B^T with `rank` columns; entries are small whole numbers, so that degenerate
// problems are frequent and exact.
Eigen::MatrixXd gram(std::mt19937& random, Index n, Index rank) {
  std::uniform_int_distribution<int> entry(-2, 2);
  Eigen::MatrixXd b(n, rank);
  for (auto& x : b.reshaped()) x = entry(random);
  return b * b.transpose();
}

Eigen::VectorXd whole_numbers(std::mt19937& random, Index n) {
  std::uniform_int_distribution<int> entry(-2, 2);
  Eigen::VectorXd q(n);
  for (auto& x : q) x = entry(random);
  return q;
}

TEST(Lcp, FindsTheUniqueSolutionThatEnumerationFinds) {
  std::mt19937 random(1);
  int degenerate = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = 1 + trial % 6;
    const Eigen::MatrixXd w = gram(random, n, n) + Eigen::MatrixXd::Identity(n, n);
    const auto q = whole_numbers(random, n);
    const auto expected = by_enumeration(w, q);
    ASSERT_TRUE(expected);
    LcpSolver solver(8);
    Eigen::VectorXd z;
    ASSERT_TRUE(solver.solve(w, q, all_of(std::size_t(n)), z)) << "trial " << trial;
    // Condition numbers below 200.
    EXPECT_LT((z - *expected).cwiseAbs().maxCoeff(), 1e-12) << "trial " << trial;
    const Eigen::VectorXd slack = w * *expected + q;
    for (Index i = 0; i < n; ++i)
      if (std::abs(slack[i]) < 1e-9 && std::abs((*expected)[i]) < 1e-9) ++degenerate;
  }
  EXPECT_GT(degenerate, 100);
}

TEST(Lcp, SolvesSemidefiniteProblemsWhereASolutionExists) {
  std::mt19937 random(2);
  int solved = 0, unsolvable = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index n = 2 + trial % 5;
    const auto w = gram(random, n, 1 + trial % 3);
    const auto q = whole_numbers(random, n);
    const auto expected = by_enumeration(w, q);
    LcpSolver solver(8);
    Eigen::VectorXd z;
    const bool found = solver.solve(w, q, all_of(std::size_t(n)), z);
    ASSERT_EQ(found, expected.has_value()) << "trial " << trial;
    if (!found) {
      ++unsolvable;
      EXPECT_TRUE(z.isZero(0.0));
      continue;
    }
    ++solved;
    EXPECT_GE(z.minCoeff(), 0.0);
    // Not z, but W z is unique.
    EXPECT_LT((w * (z - *expected)).cwiseAbs().maxCoeff(), 1e-12) << "trial " << trial;
  }
  EXPECT_GT(solved, 200);
  EXPECT_GT(unsolvable, 200);
}

TEST(Lcp, SolvesChainsOfHundredsOfRows) {
  // The Delassus matrix of a row of n + 1 masses, all contacts closed, one end struck.
  for (const Index n : {2, 50, 300}) {
    Eigen::VectorXd m = Eigen::VectorXd::LinSpaced(n + 1, 1.0, 3.0), q = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      w(i, i) = 1.0 / m[i] + 1.0 / m[i + 1];
      if (i > 0) w(i, i - 1) = w(i - 1, i) = -1.0 / m[i];
    }
    q[0] = -2.0;
    LcpSolver solver(static_cast<std::size_t>(n));
    Eigen::VectorXd z;
    ASSERT_TRUE(solver.solve(w, q, all_of(std::size_t(n)), z));
    // All move on together: the momentum through a contact is that of the masses behind it.
    const double v = 2.0 * m[0] / m.sum();
    for (Index i = 0; i < n; ++i)
      EXPECT_NEAR(z[i], v * m.tail(n - i).sum(), 1e-12 * double(n)) << n;
  }
}

TEST(Lcp, SolvesRandomProblemsOfHundredsOfRows) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const Index n : {20, 100, 200}) {
    Eigen::MatrixXd b(n, n);
    Eigen::VectorXd q(n);
    for (auto& x : b.reshaped()) x = normal(random);
    for (auto& x : q) x = normal(random);
    const Eigen::MatrixXd w = b * b.transpose();
    LcpSolver solver(static_cast<std::size_t>(n));
    Eigen::VectorXd z;
    ASSERT_TRUE(solver.solve(w, q, all_of(std::size_t(n)), z)) << n;
    const Eigen::VectorXd slack = w * z + q;
    const double unit =
        8.0 * double(n) * std::numeric_limits<double>::epsilon() * double(n) * z.sum() * 4.0;
    for (Index i = 0; i < n; ++i) {
      EXPECT_GE(z[i], 0.0);
      EXPECT_GT(slack[i], -unit);
      EXPECT_TRUE(z[i] == 0.0 || slack[i] < unit);
    }
  }
}

// z and w vanish together in many rows, and rounding decides which of them is positive.
TEST(Lcp, SolvesDegenerateProblemsWithRounding) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 2 + trial % 12;
    Eigen::MatrixXd b(n, n);
    for (auto& x : b.reshaped()) x = normal(random);
    const Eigen::MatrixXd w = b * b.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd expected(n), z;
    for (auto& x : expected) x = std::max(0.0, normal(random));
    LcpSolver solver(static_cast<std::size_t>(n));
    ASSERT_TRUE(solver.solve(w, -(w * expected), all_of(std::size_t(n)), z)) << trial;
    // Condition numbers below 1000.
    EXPECT_LT((z - expected).cwiseAbs().maxCoeff(), 1e-12) << trial;
    EXPECT_GE(z.minCoeff(), 0.0);
  }
}

TEST(Lcp, DoesNotDependOnTheScaleOfItsRows) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Index n = 5;
    const Eigen::MatrixXd w = gram(random, n, n) + Eigen::MatrixXd::Identity(n, n);
    const auto q = whole_numbers(random, n);
    Eigen::VectorXd scale(n);
    for (Index i = 0; i < n; ++i) scale[i] = std::ldexp(1.0, 12 * int(i) - 20);
    LcpSolver solver(5);
    Eigen::VectorXd z, scaled;
    ASSERT_TRUE(solver.solve(w, q, all_of(5), z));
    ASSERT_TRUE(solver.solve(scale.asDiagonal() * w * scale.asDiagonal(), scale.cwiseProduct(q),
                             all_of(5), scaled));
    EXPECT_LT((z - scale.cwiseProduct(scaled)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Lcp, SolvesForTheGivenRowsAlone) {
  const Eigen::MatrixXd w = (Eigen::Matrix3d() << 2, -1, 0, -1, 2, -1, 0, -1, 2).finished();
  const Eigen::VectorXd q = Eigen::Vector3d(-2, -5, -4);
  LcpSolver solver(3);
  Eigen::VectorXd z;
  for (const auto& rows : {std::vector<std::size_t>{0, 2}, {0}, {2}, {}}) {
    ASSERT_TRUE(solver.solve(w, q, rows, z));
    for (Index i = 0; i < 3; ++i)
      EXPECT_NEAR(z[i], std::count(rows.begin(), rows.end(), i) ? -q[i] / 2 : 0.0, 1e-15);
  }
}

TEST(Lcp, FindsNothingInWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LcpSolver solver(2);
  Eigen::VectorXd z;
  Eigen::MatrixXd w = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(solver.solve(w, Eigen::Vector2d(nan, 1.0), all_of(2), z));
  EXPECT_FALSE(solver.solve(w, Eigen::Vector2d(nan, 1.0), all_of(1), z));
  w(0, 1) = w(1, 0) = nan;
  EXPECT_FALSE(solver.solve(w, Eigen::Vector2d(-1.0, 1.0), all_of(2), z));
}

TEST(PrincipalCholesky, SolvesWithTheRowsOfASubmatrix) {
  const Eigen::MatrixXd a = (Eigen::Matrix3d() << 4, 9, 2, 9, 9, 9, 2, 9, 5).finished();
  PrincipalCholesky factors(3);
  const std::vector<std::size_t> rows{0, 2};
  EXPECT_EQ(factors.compute(a, rows), 2u);
  Eigen::VectorXd x = Eigen::Vector3d(6.0, 7.0, 1.0);
  factors.solve_in_place(x);
  EXPECT_NEAR(4 * x[0] + 2 * x[1], 6.0, 1e-14);
  EXPECT_NEAR(2 * x[0] + 5 * x[1], 7.0, 1e-14);
  EXPECT_EQ(x[2], 1.0);
}

TEST(PrincipalCholesky, StopsAtTheFirstDependentRow) {
  // Rows of B: (1, -1, 0), (0, 1, -1), their sum, and (0, 0, 1) in an order of its own.
  const Eigen::MatrixXd b =
      (Eigen::Matrix<double, 4, 3>() << 1, -1, 0, 0, 1, -1, 1, 0, -1, 0, 0, 1).finished();
  const Eigen::MatrixXd w = b * Eigen::Vector3d(1.0, 1e-9, 0.3).asDiagonal() * b.transpose();
  PrincipalCholesky factors(4);
  EXPECT_EQ(factors.compute(w, all_of(4)), 2u);
  EXPECT_EQ(factors.compute(w, std::vector<std::size_t>{0, 2, 3, 1}), 3u);
  EXPECT_EQ(factors.compute(w, std::vector<std::size_t>{0, 2, 3}), 3u);
}

}  // namespace
}  // namespace clackers::numerics
