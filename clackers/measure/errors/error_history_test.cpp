#include "clackers/measure/errors/error_history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::measure {
namespace {

using Values = std::vector<double>;

TEST(ErrorHistory, KeepsTheLargestErrorOfEachMassInEachInterval) {
  ErrorHistory history(4, 2, 1.0, 3.0);
  history.take(1.0, Values{0.1, 0.2});
  history.take(1.4, Values{0.3, 0.1});
  history.take(2.6, Values{0.0, 0.7});
  EXPECT_EQ(history.times(), (Values{1.25, 2.75}));
  EXPECT_EQ(history.largest(0), (Values{0.3, 0.0}));
  EXPECT_EQ(history.largest(1), (Values{0.2, 0.7}));
}

TEST(ErrorHistory, TheEndBelongsToTheLastInterval) {
  ErrorHistory history(2, 1, 0.0, 1.0);
  history.take(1.0, Values{5.0});
  history.take(1.0 + 1e-12, Values{6.0});
  EXPECT_EQ(history.times(), Values{0.75});
  EXPECT_EQ(history.largest(0), Values{6.0});
}

TEST(ErrorHistory, AnErrorThatIsNoNumberStaysVisible) {
  ErrorHistory history(1, 1, 0.0, 1.0);
  history.take(0.1, Values{1.0});
  history.take(0.2, Values{NAN});
  history.take(0.3, Values{2.0});
  EXPECT_TRUE(std::isnan(history.largest(0)[0]));
}

TEST(ErrorHistory, WithoutIntervalsNothingIsKept) {
  ErrorHistory history(0, 2, 0.0, 1.0);
  history.take(0.5, Values{1.0, 1.0});
  EXPECT_TRUE(history.times().empty());
  EXPECT_THROW(ErrorHistory(-1, 2, 0.0, 1.0), InputError);
}

}  // namespace
}  // namespace clackers::measure
