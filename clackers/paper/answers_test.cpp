#include "clackers/paper/answers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clackers::paper {
namespace {

constexpr double pi = std::numbers::pi;

// What the answers and proofs on the page state as formulas, checked without the library.

TEST(Answers, AreFourWithProof) {
  const auto all = answers();
  ASSERT_EQ(all.size(), 4u);
  for (const auto& one : all) {
    EXPECT_TRUE(one.question.ends_with("?"));
    EXPECT_FALSE(one.proof.empty());
  }
}

TEST(Answers, LimitsOfTheMassRatioAreThoseOfAScan) {
  std::string expected = "r* = ";
  for (const double X : {5.0, 9.0, 21.0, 41.0, 81.0}) {
    double least = 0.0;
    for (int i = 1; i < 400'000; ++i) {
      const double theta = 0.5 * pi * i / 400'000;
      least = std::min(least, std::sin(X * theta) / (X * std::sin(theta)));
    }
    char text[32];
    std::snprintf(text, sizeof text, "%s%.4f", X == 5.0 ? "" : ", ", -1.0 / least);
    expected += text;
  }
  EXPECT_NE(answers().at(3).answer.find(expected), std::string::npos) << expected;
}

TEST(Answers, HighestHarmonicAndThresholdFollowFromTheAmplitudes) {
  for (const double X : {5.0, 9.0, 21.0, 81.0})
    for (const double eps : {0.3, 0.1, 0.05, 0.001}) {
      int highest = 0;
      for (int n = 1; n < 3000; ++n)
        if (1.0 / std::abs(X * X - 4.0 * n * n) >= eps / (2.0 * X - 1.0)) highest = n;
      EXPECT_EQ(highest, int(0.5 * std::sqrt(X * X + (2.0 * X - 1.0) / eps)));
      EXPECT_EQ(highest <= X, eps > (2.0 * X - 1.0) / ((3.0 * X + 2.0) * (X + 2.0)));
    }
}

TEST(Answers, NameTheHarmonicsOfTwoThresholds) {
  const auto text = answers().at(1).answer;
  // floor(sqrt(81 + 17/0.1)/2) = 7 and floor(sqrt(81 + 17/0.001)/2) = 65
  EXPECT_NE(text.find("N = 2: 9 ≥ 7"), std::string::npos) << text;
  EXPECT_NE(text.find("N = 2: 9 < 65"), std::string::npos) << text;
  // For N = 0 eps = 0.1 is below 1/5: floor(sqrt(31)/2) = 2
  EXPECT_NE(text.find("N = 0: 1 < 2"), std::string::npos) << text;
}

TEST(Answers, TheIdentityOfTheProofOfEq18Holds) {
  for (const double x : {3.2, 4.0, 5.5, 7.8}) {
    const double y = std::pow(std::sin(x / 5.0), 2);
    EXPECT_NEAR(5.0 * std::sin(x / 5.0) + 3.0 * std::sin(x),
                std::sin(x / 5.0) * (48.0 * y * y - 60.0 * y + 20.0), 1e-13);
  }
}

}  // namespace
}  // namespace clackers::paper
