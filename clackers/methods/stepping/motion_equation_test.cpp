#include "clackers/methods/stepping/motion_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "clackers/methods/testing/runs.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::methods {
namespace {

// Springs whose tangent is a matrix only.
class AsMatrix : public model::NonlinearForce<model::any_dof> {
 public:
  explicit AsMatrix(model::OneSidedSprings springs) : springs_(std::move(springs)) {}
  void add(const Eigen::VectorXd& u, const Eigen::VectorXd& v, Eigen::VectorXd& p) const override {
    springs_.add(u, v, p);
  }
  void add_tangent(const Eigen::VectorXd& u, const Eigen::VectorXd& v, Eigen::MatrixXd& dp_du,
                   Eigen::MatrixXd& dp_dv) const override {
    springs_.add_tangent(u, v, dp_du, dp_dv);
  }
  bool has_kinks() const override { return true; }

 private:
  model::OneSidedSprings springs_;
};

// Eight masses in a chain between springs that push at both ends.
model::ImpactProblem<> chain(bool by_rows) {
  constexpr Eigen::Index n = 8;
  model::ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd::Identity(n, n);
  p.system.stiffness = 2.0 * Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    p.system.stiffness(i, i + 1) = p.system.stiffness(i + 1, i) = -1.0;
  p.system.damping = 0.01 * p.system.stiffness;
  const model::OneSidedSprings springs(
      {{Eigen::VectorXd::Unit(n, 0), -0.1, 1.0},
       {-Eigen::VectorXd::Unit(n, n - 1), -0.2, 1.0},
       {Eigen::VectorXd::Unit(n, 1) - Eigen::VectorXd::Unit(n, 2), -0.3, 1.0}},
      {50.0, 80.0, 20.0});
  if (by_rows)
    p.system.nonlinear = std::make_shared<model::OneSidedSprings>(springs);
  else
    p.system.nonlinear = std::make_shared<AsMatrix>(springs);
  p.start = {0.0, Eigen::VectorXd::LinSpaced(n, 0.0, 0.1),
             Eigen::VectorXd::LinSpaced(n, -1.0, 1.0)};
  p.end = 20.0;
  return p;
}

// Newton's iteration is the same: the formula of Sherman and Morrison changes roundings alone. Stages, which take
// matrices, lose no part of the tangent.
TEST(MotionEquation, TangentsByRowsAreThoseByMatrices) {
  for (const auto* name : {"newmark", "implicit-midpoint", "generalized-alpha", "bdf2", "sdirk2",
                           "radau-iia-3", "radau-iia-5"}) {
    const auto [rows, by_rows] = runs::run(name, chain(true), 0.02);
    const auto [matrix, by_matrix] = runs::run(name, chain(false), 0.02);
    ASSERT_TRUE(by_rows.finished && by_matrix.finished) << name;
    double worst = 0.0;
    for (std::size_t i = 0; i < rows.u.size(); ++i)
      worst = std::max(worst, std::abs(rows.u[i] - matrix.u[i]));
    EXPECT_LT(worst, 1e-12) << name;
    const auto iterations = double(by_matrix.work.newton_iterations);
    EXPECT_GT(iterations, 500.0) << name;
    EXPECT_NEAR(double(by_rows.work.newton_iterations), iterations, 0.01 * iterations) << name;
  }
}

}  // namespace
}  // namespace clackers::methods
