#include "clackers/base/constants.hpp"
#include "clackers/measure/impacts/impact_finder.hpp"

#include <gtest/gtest.h>

namespace clackers::measure {
namespace {

using List = std::vector<double>;

// One mass; u is 10 t, v is 100 t.
model::Trajectory history(List times, std::vector<model::Impact> impacts) {
  model::Trajectory history;
  history.dof = 1;
  for (const double t : times) {
    history.t.push_back(t);
    history.u.push_back(10.0 * t);
    history.v.push_back(100.0 * t);
  }
  history.impacts = std::move(impacts);
  return history;
}

TEST(JumpLimits, StandBetweenTheRowsAroundThem) {
  const auto wide = with_jump_limits(history(
      {0.0, 1.0, 2.0}, {{1.5, 0, {7.0}, {-3.0}, {4.0}, nan}, {0.5, 0, {6.0}, {1.0}, {2.0}, nan}}));
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(wide->t, (List{0.0, 0.5, 0.5, 1.0, 1.5, 1.5, 2.0}));
  EXPECT_EQ(wide->u, (List{0.0, 6.0, 6.0, 10.0, 7.0, 7.0, 20.0}));
  EXPECT_EQ(wide->v, (List{0.0, 1.0, 2.0, 100.0, -3.0, 4.0, 200.0}));
  EXPECT_EQ(wide->dof, 1);
  EXPECT_EQ(wide->impacts->size(), 2u);
}

TEST(JumpLimits, ReplaceARowAloneAtTheirTime) {
  const auto wide =
      with_jump_limits(history({0.0, 1.0, 2.0}, {{1.0, 0, {7.0}, {-3.0}, {4.0}, nan}}));
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(wide->t, (List{0.0, 1.0, 1.0, 2.0}));
  EXPECT_EQ(wide->v, (List{0.0, -3.0, 4.0, 200.0}));
}

TEST(JumpLimits, AtTheEndsReplaceRowsToo) {
  const auto wide = with_jump_limits(history(
      {0.0, 1.0}, {{0.0, 0, {7.0}, {-3.0}, {4.0}, nan}, {1.0, 0, {8.0}, {-5.0}, {6.0}, nan}}));
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(wide->t, (List{0.0, 0.0, 1.0, 1.0}));
  EXPECT_EQ(wide->v, (List{-3.0, 4.0, -5.0, 6.0}));
}

TEST(JumpLimits, OfImpactsAtOneTimeAreTheFirstAndTheLast) {
  const auto wide = with_jump_limits(history(
      {0.0, 2.0}, {{1.0, 0, {7.0}, {-3.0}, {4.0}, nan}, {1.0, 0, {7.0}, {4.0}, {9.0}, nan}}));
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(wide->t, (List{0.0, 1.0, 1.0, 2.0}));
  EXPECT_EQ(wide->v, (List{0.0, -3.0, 9.0, 200.0}));
}

TEST(JumpLimits, LeaveTwoRowsOfTheHistoryAsTheyAre) {
  EXPECT_FALSE(
      with_jump_limits(history({0.0, 1.0, 1.0, 2.0}, {{1.0, 0, {7.0}, {-3.0}, {4.0}, nan}})));
  const auto wide =
      with_jump_limits(history({0.0, 1.0, 1.0, 2.0}, {{1.0, 0, {7.0}, {-3.0}, {4.0}, nan},
                                                      {1.5, 0, {7.0}, {-3.0}, {4.0}, nan}}));
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(wide->t, (List{0.0, 1.0, 1.0, 1.5, 1.5, 2.0}));
  EXPECT_EQ(wide->v, (List{0.0, 100.0, 100.0, -3.0, 4.0, 200.0}));
}

TEST(JumpLimits, AreNotMadeOfWhatIsUnknown) {
  for (const auto& impact : std::vector<model::Impact>{{1.0, 0, {}, {-3.0}, {4.0}, nan},
                                                       {1.0, 0, {7.0}, {}, {4.0}, nan},
                                                       {1.0, 0, {7.0}, {-3.0}, {nan}, nan},
                                                       {2.5, 0, {7.0}, {-3.0}, {4.0}, nan},
                                                       {-0.5, 0, {7.0}, {-3.0}, {4.0}, nan}})
    EXPECT_FALSE(with_jump_limits(history({0.0, 2.0}, {impact})));
  auto given = history({0.0, 2.0}, {{1.0, 0, {7.0}, {-3.0}, {4.0}, nan}});
  EXPECT_TRUE(with_jump_limits(given));
  auto changed = given;
  changed.a = {0.0, 0.0};
  EXPECT_FALSE(with_jump_limits(changed));
  changed = given;
  changed.v.clear();
  EXPECT_FALSE(with_jump_limits(changed));
  changed = given;
  changed.impacts.reset();
  EXPECT_FALSE(with_jump_limits(changed));
}

}  // namespace
}  // namespace clackers::measure
