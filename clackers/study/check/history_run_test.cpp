#include "clackers/study/check/history_run.hpp"

#include <gtest/gtest.h>

namespace clackers::study {
namespace {

TEST(StepInName, FollowsAnHThatBeginsAWord) {
  EXPECT_EQ(step_in_name("h0.01.csv"), 0.01);
  EXPECT_EQ(step_in_name("/data/h5/run-h=1e-3.txt"), 1e-3);
  EXPECT_EQ(step_in_name("disp_h_0.005.out"), 0.005);
  EXPECT_EQ(step_in_name("h.25"), 0.25);
  EXPECT_EQ(step_in_name("hh0.5-h0.25.csv"), 0.25);
  EXPECT_FALSE(step_in_name("/h0.1/run.csv"));
  EXPECT_FALSE(step_in_name("graph0.1.csv"));
  EXPECT_FALSE(step_in_name("h0.csv"));
  EXPECT_FALSE(step_in_name("history.csv"));
}

}  // namespace
}  // namespace clackers::study
