#include "clackers/study/check/check_start.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

cases::Case pair() { return cases::make("three-parameter"); }

FirstRow start_of(const cases::Case& which) {
  const auto now = which.motion->at(0.0, model::Side::right);
  return {0.0, {now.u[0], now.u[1]}, {now.v[0], now.v[1]}};
}

TEST(CheckStart, MeasuresByTheEnvelopes) {
  const auto which = pair();
  auto row = start_of(which);
  EXPECT_EQ(start_error(row, which), 0.0);
  row.u[1] += 0.01;  // of an envelope of 1/3
  EXPECT_NEAR(start_error(row, which), 0.03, 1e-4);
  row.u[1] = std::nan("");
  EXPECT_EQ(start_error(row, which), 0.0);
}

TEST(CheckStart, NamesTheParameterThatGivesTheState) {
  const auto N3 = start_of(cases::make("three-parameter", {{"N", 3.0}}));
  EXPECT_EQ(other_start(N3, pair()),
            "u2 starts at -0.230769, and that of three-parameter at -0.333333. With --set N=3 the "
            "case starts as the history does.");
  const auto general = cases::make("synchronized-pair");
  const auto wanted = [&](const char* name, double value) {
    return other_start(start_of(cases::make("synchronized-pair", {{name, value}})), general);
  };
  EXPECT_NE(wanted("A", 2.5).find("--set A=2.5 "), std::string::npos) << wanted("A", 2.5);
  // u2 starts at -r/X: both could mend it.
  EXPECT_NE(wanted("X", 11.0).find("--set X=11 "), std::string::npos) << wanted("X", 11.0);
  EXPECT_NE(wanted("r", 2.5).find("--set r=2.5 "), std::string::npos) << wanted("r", 2.5);
  EXPECT_NE(wanted("xi1", 0.123).find("--set xi1=0.123 "), std::string::npos)
      << wanted("xi1", 0.123);
}

TEST(CheckStart, SaysWhatSetsTheValueWhereNoneGivesTheState) {
  FirstRow row = start_of(pair());
  row.u[1] = 0.7;
  const auto text = other_start(row, pair());
  EXPECT_NE(text.find("u2 starts at 0.7"), std::string::npos) << text;
  EXPECT_NE(text.find("It is set by N, none of which alone"), std::string::npos) << text;
}

}  // namespace
}  // namespace clackers::study
