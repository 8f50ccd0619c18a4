#include "clackers/cases/admissibility.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::cases {
namespace {

TEST(Admissibility, ToldForRatiosOnBothSidesOfTheLimit) {
  // r*(3) = 3 exactly, docs/manual/derivations/admissibility.md. 1 - r/3 is rounded twice.
  EXPECT_EQ(admissibility(3.0, 1.5).r_star, 3.0);
  EXPECT_NEAR(admissibility(3.0, 1.5).margin, 0.5, 2e-16);
  EXPECT_NEAR(admissibility(3.0, 6.0).margin, -1.0, 4e-16);
  EXPECT_EQ(admissibility(3.0, 3.0).margin, 0.0);
}

TEST(Admissibility, ExchangedRolesTakeTheInverseMassRatio) {
  EXPECT_EQ(admissibility(1.0 / 3.0, 0.5).r_star, 3.0);
  EXPECT_NEAR(admissibility(1.0 / 3.0, 0.5).margin, 1.0 / 3.0, 2e-16);
  EXPECT_NEAR(admissibility(1.0 / 3.0, 0.25).margin, -1.0 / 3.0, 3e-16);
}

TEST(Admissibility, EqualFrequenciesHaveNoLimit) {
  EXPECT_EQ(admissibility(1.0, 7.0).r_star, HUGE_VAL);
  EXPECT_EQ(admissibility(1.0, 7.0).margin, 8.0);
}

TEST(Admissibility, IsRefusedOutsideTheClass) {
  for (const double X : {2.0, 0.4, 0.0, -3.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(admissibility(X, 1.0), InputError) << "X = " << X;
  for (const double r : {0.0, -1.0, 1e61, double(NAN), double(INFINITY)})
    EXPECT_THROW(admissibility(3.0, r), InputError) << "r = " << r;
}

}  // namespace
}  // namespace clackers::cases
