#include "clackers/solvers/program.hpp"

#include <gtest/gtest.h>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::solvers {
namespace {

using Numbers = std::vector<double>;

TEST(ProgramTolerances, AreOneADecadeWithBothEnds) {
  EXPECT_EQ(tolerances_from("1e-3:1e-6"), (Numbers{1e-3, 1e-4, 1e-5, 1e-6}));
  EXPECT_EQ(tolerances_from("1e-1:5e-3"), (Numbers{1e-1, 1e-2}));
  EXPECT_EQ(tolerances_from("1e-3:1e-12").size(), 10u);
}

TEST(ProgramTolerances, AreAListInAnyOrder) {
  EXPECT_EQ(tolerances_from("1e-6,1e-2,1e-4"), (Numbers{1e-2, 1e-4, 1e-6}));
  EXPECT_EQ(tolerances_from("0.5"), Numbers{0.5});
}

TEST(ProgramTolerances, AreRefusedWhereTheyAreNone) {
  for (const auto* text : {"", "x", "1e-3:", "1e-6:1e-3", "1e-3:1e-3", "0", "2", "nan",
                           "1e-3,,1e-4", "1e-3:1e-6:1e-9", "1e-3,1e-3"}) {
    SCOPED_TRACE(text);
    EXPECT_REFUSED(tolerances_from(text), "bad-syntax", "--tolerances");
  }
}

}  // namespace
}  // namespace clackers::solvers
