#include "clackers/record/schematic.hpp"

#include <gtest/gtest.h>

#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/nonlinear_springs.hpp"
#include "clackers/tables/case_summary.hpp"

namespace clackers::record {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

model::ImpactProblem<> problem_of(const MatrixXd& stiffness) {
  model::ImpactProblem<> problem;
  const auto n = stiffness.rows();
  problem.system = {MatrixXd::Identity(n, n), MatrixXd::Zero(n, n), stiffness};
  return problem;
}

// Two storeys, roof first, and one.
model::ImpactProblem<> buildings() {
  MatrixXd k(3, 3);
  k << 1.02, -1.0, 0.0, -1.0, 3.0, 0.0, 0.0, 0.0, 4.0;  // the roof has a weak spring of its own
  auto problem = problem_of(k);
  problem.contacts.push_back({Eigen::Vector3d(-1.0, 0.0, 1.0), -0.5, 1.0});
  return problem;
}

TEST(Schematic, StoreysStandAboveEachOtherAndRoofsSideBySide) {
  const auto drawing = schematic(buildings());
  ASSERT_EQ(drawing.blocks.size(), 3u);
  EXPECT_EQ(drawing.blocks[0].height, 1.0);
  EXPECT_EQ(drawing.blocks[1].height, 0.5);
  EXPECT_EQ(drawing.blocks[2].height, 1.0);
  EXPECT_EQ(drawing.blocks[0].column, 0);
  EXPECT_EQ(drawing.blocks[1].column, 0);
  EXPECT_EQ(drawing.blocks[2].column, 1);
  ASSERT_EQ(drawing.springs.size(), 3u);
  EXPECT_EQ(drawing.springs[0].other, 1);
  EXPECT_EQ(drawing.springs[1].other, -1);
  EXPECT_EQ(drawing.springs[2].one, 2);
  ASSERT_EQ(drawing.contacts.size(), 1u);
  EXPECT_EQ(drawing.contacts[0].left, 0);
  EXPECT_EQ(drawing.contacts[0].right, 2);
  EXPECT_EQ(drawing.contacts[0].gap, 0.5);
}

TEST(Schematic, OneSidedSpringsAreDrawnAsTheContactsTheyStandFor) {
  auto problem = problem_of(MatrixXd::Identity(2, 2));
  problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
      std::vector{model::contact_between(2, 0, 1)}, std::vector{5.0});
  const auto drawing = schematic(problem);
  ASSERT_EQ(drawing.contacts.size(), 1u);
  EXPECT_EQ(drawing.contacts[0].left, 0);
  EXPECT_EQ(drawing.blocks[0].column, 0);
}

TEST(Schematic, TheFirstMassStandsAtTheLeftWhicheverWayIsPositive) {
  auto problem = problem_of(MatrixXd::Identity(3, 3));
  problem.contacts = {{Eigen::Vector3d(1.0, -1.0, 0.0), 0.0, 1.0},
                      {Eigen::Vector3d(0.0, 2.0, -2.0), 0.4, 1.0}};
  const auto drawing = schematic(problem);
  EXPECT_TRUE(drawing.leftward);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(drawing.blocks[std::size_t(i)].column, i);
  EXPECT_EQ(drawing.contacts[1].left, 1);
  EXPECT_EQ(drawing.contacts[1].right, 2);
  EXPECT_EQ(drawing.contacts[1].gap, -0.2);
  problem.contacts = {{Eigen::Vector3d(-1.0, 0.0, 1.0), 0.0, 1.0}};
  EXPECT_FALSE(schematic(problem).leftward);
}

TEST(Schematic, StopsAreWallsAndNothingIsDrawnForOtherContacts) {
  auto problem = problem_of(MatrixXd::Identity(3, 3));
  problem.contacts = {{Eigen::Vector3d(0.0, 1.0, 0.0), 0.0, 1.0},
                      {Eigen::Vector3d(-1.0, 0.0, 0.0), -2.0, 1.0}};
  const auto drawing = schematic(problem);
  EXPECT_EQ(drawing.contacts[0].left, -1);
  EXPECT_EQ(drawing.contacts[0].right, 1);
  EXPECT_EQ(drawing.contacts[1].left, 0);
  EXPECT_EQ(drawing.contacts[1].right, -1);
  EXPECT_EQ(drawing.contacts[1].gap, 2.0);
  problem.contacts.push_back({Eigen::Vector3d(1.0, -1.0, 1.0), 0.0, 1.0});
  EXPECT_TRUE(schematic(problem).blocks.empty());
}

TEST(Schematic, CircularContactsAndFreeMassesAreDrawnAllTheSame) {
  auto problem = problem_of(MatrixXd::Zero(2, 2));
  problem.contacts = {{Eigen::Vector2d(1.0, -1.0), -1.0, 1.0},
                      {Eigen::Vector2d(-1.0, 1.0), -1.0, 1.0}};
  const auto drawing = schematic(problem);
  EXPECT_NE(drawing.blocks[0].column, drawing.blocks[1].column);
  EXPECT_TRUE(drawing.springs.empty());
}

TEST(Schematic, PendulaHaveTheirLengths) {
  using Springs = model::NonlinearSprings;
  const Eigen::Vector2d e1(1.0, 0.0), e2(0.0, 2.0), both(1.0, 1.0);
  auto problem = problem_of(MatrixXd::Zero(2, 2));
  const auto lengths = [&](std::vector<Springs::Row> rows) {
    problem.system.nonlinear = std::make_shared<Springs>(std::move(rows));
    return schematic(problem).lengths;
  };
  const Springs::Row first{e1, Springs::Law::sine, 1.0, 0.5};
  EXPECT_EQ(lengths({first, {e2, Springs::Law::sine, 1.0, 3.0}}), (std::vector{0.5, 1.5}));
  EXPECT_EQ(lengths({first}).size(), 0u);  // mass 2 hangs on nothing
  EXPECT_EQ(lengths({first, {both, Springs::Law::sine, 1.0, 3.0}}).size(), 0u);
  EXPECT_EQ(lengths({first, {e2, Springs::Law::cubic, 1.0, 3.0}}).size(), 0u);
  problem.system.stiffness(0, 0) = 1.0;
  EXPECT_EQ(lengths({first, {e2, Springs::Law::sine, 1.0, 3.0}}).size(), 0u);
}

TEST(Schematic, CasesWithABodyInThePlaneSaySo) {
  const auto plane = [](const char* name) {
    return tables::summary_of(cases::make(name)).drawing.plane;
  };
  EXPECT_EQ(plane("oblique-disk"), 0.0);
  EXPECT_EQ(plane("billiard"), 0.0);
  EXPECT_EQ(plane("circle-billiard"), 1.0);
  EXPECT_EQ(plane("two-pendula"), std::nullopt);
}

TEST(Schematic, StringsHaveTheirNodesFromEndToEnd) {
  const auto drawing = [](const char* name) {
    return tables::summary_of(cases::make(name, {{"elements", 4.0}})).drawing;
  };
  const auto expect_nodes = [](const std::vector<Schematic::Node>& string,
                               const std::vector<std::pair<double, int>>& expected) {
    ASSERT_EQ(string.size(), expected.size());
    for (std::size_t i = 0; i < string.size(); ++i) {
      EXPECT_EQ(string[i].x, expected[i].first);
      EXPECT_EQ(string[i].mass, expected[i].second);
    }
  };
  expect_nodes(drawing("string-on-obstacle").string,
               {{0.0, -1}, {0.25, 0}, {0.5, 1}, {0.75, 2}, {1.0, -1}});
  // The half to the right, without a mass in the middle.
  expect_nodes(drawing("string-over-point").string, {{-0.5, -1},
                                                     {-0.375, 2},
                                                     {-0.25, 1},
                                                     {-0.125, 0},
                                                     {0.125, 0},
                                                     {0.25, 1},
                                                     {0.375, 2},
                                                     {0.5, -1}});
  EXPECT_TRUE(drawing("bar-wall").string.empty());
}

TEST(Schematic, IsEmptyForMoreMassesThanAreDrawn) {
  EXPECT_EQ(schematic(problem_of(MatrixXd::Identity(most_blocks, most_blocks))).blocks.size(),
            std::size_t(most_blocks));
  EXPECT_TRUE(
      schematic(problem_of(MatrixXd::Identity(most_blocks + 1, most_blocks + 1))).blocks.empty());
}

}  // namespace
}  // namespace clackers::record
