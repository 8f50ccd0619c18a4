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
