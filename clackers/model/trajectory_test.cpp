#include "clackers/model/trajectory.hpp"

#include <gtest/gtest.h>

namespace clackers::model {
namespace {

TEST(TrajectorySink, KeepsBlocksInOrder) {
  TrajectorySink sink(true);
  const double t1[] = {0.0, 0.5}, u1[] = {1, 2, 3, 4}, v1[] = {5, 6, 7, 8};
  const double t2[] = {1.0}, u2[] = {9, 10}, v2[] = {11, 12};
  EXPECT_TRUE(sink.take(SampleBlock{2, t1, u1, v1}));
  EXPECT_TRUE(sink.take(SampleBlock{2, t2, u2, v2}));
  const auto& path = sink.trajectory();
  EXPECT_EQ(path.dof, 2);
  EXPECT_EQ(path.t, (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(path.u, (std::vector<double>{1, 2, 3, 4, 9, 10}));
  EXPECT_EQ(path.v, (std::vector<double>{5, 6, 7, 8, 11, 12}));
  EXPECT_TRUE(path.a.empty());
}

TEST(TrajectorySink, KnowsNoImpactsFromImpactsNotReported) {
  EXPECT_FALSE(TrajectorySink(false).trajectory().impacts.has_value());
  ASSERT_TRUE(TrajectorySink(true).trajectory().impacts.has_value());
  EXPECT_TRUE(TrajectorySink(true).trajectory().impacts->empty());
}

TEST(TrajectorySink, KeepsAllOfAnImpact) {
  TrajectorySink sink(false);
  const double u[] = {1, 2}, before[] = {3, 4}, after[] = {5, 6};
  EXPECT_TRUE(sink.take(ReportedImpact{0.25, 1, u, before, after, 7.0}));
  ASSERT_TRUE(sink.trajectory().impacts.has_value());
  const auto& impact = sink.trajectory().impacts->at(0);
  EXPECT_EQ(impact.t, 0.25);
  EXPECT_EQ(impact.contact, 1);
  EXPECT_EQ(impact.u, (std::vector<double>{1, 2}));
  EXPECT_EQ(impact.v_before, (std::vector<double>{3, 4}));
  EXPECT_EQ(impact.v_after, (std::vector<double>{5, 6}));
  EXPECT_EQ(impact.impulse, 7.0);
}

}  // namespace
}  // namespace clackers::model
