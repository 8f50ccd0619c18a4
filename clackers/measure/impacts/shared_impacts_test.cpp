#include "clackers/measure/impacts/shared_impacts.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "clackers/exact/assembly/assemblies.hpp"
#include "clackers/exact/assembly/assembly.hpp"

namespace clackers::measure {
namespace {

TEST(SharedImpacts, AreThoseOfContactsWithCommonMasses) {
  exact::RowParameters row;
  const auto motion = exact::make_row(row);
  const auto found = first_shared_instant(*motion, exact::row_problem(row, *motion));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->contacts, 4);
  EXPECT_NEAR(found->t, 1.5707963267948966, 1e-15);
  row.masses = 2.0;
  row.fast = 0.0;
  const auto pair = exact::make_row(row);
  EXPECT_FALSE(first_shared_instant(*pair, exact::row_problem(row, *pair)));
}

TEST(SharedImpacts, AreNoneOfContactsThatTakeTurnsOrLeaveEachOtherAlone) {
  const auto turns = exact::make_alternating({});
  EXPECT_FALSE(first_shared_instant(*turns, exact::alternating_problem({}, *turns)));
  const auto pairs = exact::make_assembly({});
  ASSERT_EQ(pairs->impact(1).t, pairs->impact(2).t);
  EXPECT_FALSE(first_shared_instant(*pairs, exact::assembly_problem({}, *pairs)));
}

TEST(SharedImpacts, ErrorsAreLargestBeforeAndInAsMuchTimeAfter) {
  const std::vector<double> t{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5};
  // The interval that holds the instant counts on neither side, and the last one is too late.
  const std::vector<std::vector<double>> errors{{1, 2, 9, 4, 0, 3, 8}, {2, 1, 9, 0, 5, 1, 8}};
  const auto found = at_shared_instant({3.0, 2}, 0.0, t, errors);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->error_before, 2.0);
  EXPECT_EQ(found->error_after, 5.0);
  EXPECT_FALSE(at_shared_instant({0.9, 2}, 0.0, t, errors));
  EXPECT_FALSE(at_shared_instant({6.0, 2}, 0.0, t, errors));
  EXPECT_FALSE(at_shared_instant({3.0, 2}, 0.0, {}, {}));
}

}  // namespace
}  // namespace clackers::measure
