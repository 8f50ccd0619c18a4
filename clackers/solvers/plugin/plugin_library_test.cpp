#include "clackers/solvers/plugin/plugin_library.hpp"

#include <gtest/gtest.h>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::solvers {
namespace {

TEST(PluginProblem, HasRowsOfMatricesAndAContactARow) {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::MatrixXd{{1.0, 2.0}, {3.0, 4.0}};
  problem.system.damping = Eigen::MatrixXd{{0.1, 0.2}, {0.3, 0.4}};
  problem.system.stiffness = Eigen::MatrixXd{{10.0, 20.0}, {30.0, 40.0}};
  problem.contacts.push_back({Eigen::VectorXd{{1.0, -1.0}}, -0.25, 0.5});
  problem.contacts.push_back({Eigen::VectorXd{{0.0, 2.0}}, -1.0, 1.0});
  problem.start = {0.5, Eigen::VectorXd{{5.0, 6.0}}, Eigen::VectorXd{{7.0, 8.0}}};
  problem.end = 20.0;
  const PluginProblem handed(problem);
  const auto& p = *handed.get();
  const auto values = [](const double* first, int count) {
    return std::vector<double>(first, first + count);
  };
  using Numbers = std::vector<double>;
  EXPECT_EQ(p.dof, 2);
  EXPECT_EQ(p.contacts, 2);
  EXPECT_EQ(values(p.M, 4), (Numbers{1.0, 2.0, 3.0, 4.0}));
  EXPECT_EQ(values(p.C, 4), (Numbers{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(values(p.K, 4), (Numbers{10.0, 20.0, 30.0, 40.0}));
  EXPECT_EQ(values(p.direction, 4), (Numbers{1.0, -1.0, 0.0, 2.0}));
  EXPECT_EQ(values(p.gap, 2), (Numbers{-0.25, -1.0}));
  EXPECT_EQ(values(p.restitution, 2), (Numbers{0.5, 1.0}));
  EXPECT_EQ(values(p.u, 2), (Numbers{5.0, 6.0}));
  EXPECT_EQ(values(p.v, 2), (Numbers{7.0, 8.0}));
  EXPECT_EQ(p.start, 0.5);
  EXPECT_EQ(p.end, 20.0);
}

TEST(PluginProblem, WithoutContactsHasNoArraysOfThem) {
  model::ImpactProblem<> problem;
  for (auto* matrix : {&problem.system.mass, &problem.system.damping, &problem.system.stiffness})
    *matrix = Eigen::MatrixXd::Identity(1, 1);
  problem.start.u = problem.start.v = Eigen::VectorXd::Zero(1);
  const PluginProblem handed(problem);
  EXPECT_EQ(handed.get()->contacts, 0);
  EXPECT_EQ(handed.get()->direction, nullptr);
  EXPECT_EQ(handed.get()->gap, nullptr);
  EXPECT_EQ(handed.get()->restitution, nullptr);
}

TEST(PluginLibrary, RefusesAFileThatIsNone) {
  EXPECT_REFUSED(load_plugin("/nowhere/mine.so"), "not-a-plugin", "/nowhere/mine.so",
                 "a shared library");
}

}  // namespace
}  // namespace clackers::solvers
