#include "clackers/numerics/spd_solver.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace clackers::numerics {
namespace {

TEST(SpdSolver, SolvesOneUnknown) {
  SpdSolver<1> solver;
  ASSERT_TRUE(solver.compute(Eigen::Matrix<double, 1, 1>(4.0)));
  Eigen::Matrix<double, 1, 1> x(3.0);
  solver.solve_in_place(x);
  EXPECT_EQ(x[0], 0.75);
}

TEST(SpdSolver, SolvesTwoUnknowns) {
  Eigen::Matrix2d a;
  a << 4.0, 1.0, 1.0, 0.75;  // determinant 2: every number below is exact
  SpdSolver<2> solver;
  ASSERT_TRUE(solver.compute(a));
  Eigen::Vector2d x = a * Eigen::Vector2d(3.0, -5.0);
  solver.solve_in_place(x);
  EXPECT_EQ(x, Eigen::Vector2d(3.0, -5.0));
}

TEST(SpdSolver, SolvesManyUnknownsAndSeveralColumns) {
  Eigen::MatrixXd a(3, 3), x(3, 2);
  a << 4, 2, 2, 2, 5, 3, 2, 3, 6;
  x << 1, -2, 3, 0, -1, 4;
  SpdSolver<Eigen::Dynamic> solver;
  ASSERT_TRUE(solver.compute(a));
  Eigen::MatrixXd b = a * x;
  solver.solve_in_place(b);
  EXPECT_LT((b - x).norm(), 1e-13);  // condition 8 times a few units of 2^-53 times |x| = 6
}

// Within the band where both matrices are narrow, of widths 2 and 1, and in full where one is not.
TEST(SpdSolver, SolvesASumOfMatrices) {
  for (const bool is_narrow : {true, false})
    for (const bool swapped : {false, true}) {
      const Eigen::Index n = 24;
      Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b = a, whole(n, n), x(n, 1);
      for (Eigen::Index i = 0; i < n; ++i) {
        a(i, i) = 6.0 + 0.125 * double(i);
        b(i, i) = 3.0 - 0.0625 * double(i);
        if (i >= 1) a(i, i - 1) = a(i - 1, i) = -1.0 - 0.0625 * double(i);
        if (i >= 2) a(i, i - 2) = a(i - 2, i) = 0.25;
        if (i >= 1) b(i, i - 1) = b(i - 1, i) = 0.5;
        x(i, 0) = double(i % 5) - 2.0;
      }
      if (!is_narrow) b(n - 1, 0) = b(0, n - 1) = 0.375;
      BandedMatrix<Eigen::Dynamic> first, second;
      first = a;
      second = b;
      EXPECT_EQ(second.width(), is_narrow ? 1 : -1);
      SpdSolver<Eigen::Dynamic> solver;
      ASSERT_TRUE(swapped ? solver.compute({{0.5, second}, {2.0, first}}, whole)
                          : solver.compute({{2.0, first}, {0.5, second}}, whole));
      Eigen::MatrixXd y = (2.0 * a + 0.5 * b) * x;
      solver.solve_in_place(y);
      EXPECT_LT((y - x).norm(), 1e-13);
      EXPECT_FALSE(solver.compute({{-2.0, first}, {0.5, second}}, whole));
    }
}

TEST(SpdSolver, TellsWhenAMatrixIsNotPositiveDefinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    Eigen::Matrix2d two = Eigen::Matrix2d::Identity();
    Eigen::MatrixXd many = Eigen::MatrixXd::Identity(3, 3);
    two(0, 0) = bad;
    many(1, 1) = bad;
    EXPECT_FALSE(SpdSolver<1>{}.compute(Eigen::Matrix<double, 1, 1>(bad))) << bad;
    EXPECT_FALSE(SpdSolver<2>{}.compute(two)) << bad;
    EXPECT_FALSE(SpdSolver<Eigen::Dynamic>{}.compute(many)) << bad;
  }
  Eigen::Matrix2d indefinite, negative;
  indefinite << 1, 2, 2, 1;
  negative << -1, 0, 0, -1;
  EXPECT_FALSE(SpdSolver<2>{}.compute(indefinite));
  EXPECT_FALSE(SpdSolver<2>{}.compute(negative));
}

}  // namespace
}  // namespace clackers::numerics
