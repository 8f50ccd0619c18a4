#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/wrong_solvers.hpp"

// Velocities that converge more slowly than displacements, in histories of many cases.
namespace clackers::diagnose::testing {
namespace {

// Rows of a solver at six steps, halved from `turn` radians on, with velocities of which `change` makes those of the file.
Files files_with(const cases::Case& test_case, const std::string& solver, double turn,
                 const auto& change) {
  Files files{test_case};
  const double end = test_case.problem.end;
  double h = turn / fastest(test_case);
  for (int i = 0; i < 6; ++i, h /= 2.0) {
    const double exact_step = end / std::ceil(end / h);
    auto rows = history_of(solver, test_case.problem, exact_step);
    change(rows, exact_step);
    files.add(rows, exact_step);
  }
  files.fit();
  return files;
}

// v(t) + share h a(t), as velocities of one stage of a step are.
auto ahead(const cases::Case& test_case, double share) {
  return [&test_case, share](model::Trajectory& rows, double h) {
    const auto dof = Eigen::Index(rows.dof);
    for (std::size_t i = 0; i < rows.u.size(); i += std::size_t(dof)) {
      Eigen::Map<Eigen::VectorXd> v(rows.v.data() + i, dof);
      const Eigen::Map<const Eigen::VectorXd> u(rows.u.data() + i, dof);
      const auto& s = test_case.problem.system;
      v -= share * h * s.mass.llt().solve(s.damping * v + s.stiffness * u);
    }
  };
}

TEST(VelocityOrder, OneIsNamedWhereDisplacementsHaveMore) {
  int all = 0;
  for (const auto& test_case : assorted_cases())
    for (const auto* solver : {"method=newmark", "method=rk4"})
      for (const double share : {0.3, -0.3}) {
        ++all;
        // Fine enough for the term of order one to rule the errors of phase, (w h)^2/12 w t.
        const auto files = files_with(test_case, solver, 0.02, ahead(test_case, share));
        const auto causes = file_causes(files.question());
        ASSERT_EQ(codes(causes), "velocity-order-lower")
            << name_of(test_case) << ' ' << share << ": " << files.velocity.order << " +- "
            << files.velocity.spread;
        EXPECT_NEAR(causes[0].value, 1.0, 0.1 + files.velocity.spread);
        EXPECT_EQ(causes[0].fact("expected"), files.displacement.order);
      }
  EXPECT_GE(all, 20);
}

TEST(VelocityOrder, OfTheMethodsOwnVelocitiesIsNoCause) {
  int all = 0;
  for (const auto& test_case : assorted_cases())
    for (const auto* solver : {"method=newmark", "method=rk4", "method=newmark beta=0",
                               "method=implicit-euler", "method=bathe"}) {
      ++all;
      const auto files = files_with(test_case, solver, 0.1, [](model::Trajectory&, double) {});
      EXPECT_EQ(codes(file_causes(files.question())), "") << name_of(test_case);
    }
  EXPECT_GE(all, 20);
}

}  // namespace
}  // namespace clackers::diagnose::testing
