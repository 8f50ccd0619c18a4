// The paper's systems, end to end: what `clackers verify` says of methods on Eq. (19), (21), (25).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

// Coarsest step with `per_period` steps in a period of the fast mass.
VerifyRequest request(double N, double xi1, std::vector<std::string> methods, double per_period,
                      RefinementRequest plan) {
  VerifyRequest request;
  request.cases = {"three-parameter"};
  request.settings = {{"N", N}, {"xi1", xi1}, {"a_t", 1.0}};
  request.methods = std::move(methods);
  const double fast = (4.0 * N + 1.0) * std::sqrt(1.0 - xi1 * xi1);
  plan.coarsest = 2.0 * std::numbers::pi / fast / per_period;
  request.plan = plan;
  return request;
}

struct PaperSystem {
  double N, xi1;
};

class PaperSystems : public testing::TestWithParam<PaperSystem> {};

TEST_P(PaperSystems, Rk4WithLocatedImpactsIsProperAtFour) {
  const auto [N, xi1] = GetParam();
  const auto record = verify(request(N, xi1, {"rk4"}, 20.0, {.levels = 5, .samples_per_level = 3}));
  const auto& assessment = record.cases.at(0).subjects.at(0).assessment;
  EXPECT_EQ(assessment.displacement.behaviour, Behaviour::proper) << assessment.displacement.reason;
  EXPECT_NEAR(assessment.displacement.order, 4.0, 0.4) << assessment.displacement.reason;
  EXPECT_EQ(assessment.verdict, Verdict::agrees) << assessment.displacement.reason;
  EXPECT_EQ(exit_code(record), 0);
  // T = pi / sqrt(1 - xi1^2): the last impact before 20 s is number floor(20/T + 1/2).
  const auto expected =
      std::llround(std::floor(20.0 * std::sqrt(1.0 - xi1 * xi1) / std::numbers::pi + 0.5));
  EXPECT_EQ(record.cases.at(0).problem.impact_count, expected);
  for (const auto& run : record.cases.at(0).subjects.at(0).levels.back().runs) {
    ASSERT_TRUE(run.score.impacts.has_value());
    EXPECT_EQ(run.score.impacts->found, expected);
    EXPECT_EQ(run.score.impacts->matched, expected);
    EXPECT_EQ(run.score.impacts->missed + run.score.impacts->extra, 0);
  }
}

TEST_P(PaperSystems, NewmarkWithLocatedImpactsIsProperAtTwo) {
  const auto [N, xi1] = GetParam();
  const auto record =
      verify(request(N, xi1, {"newmark"}, 80.0, {.levels = 5, .samples_per_level = 3}));
  const auto& assessment = record.cases.at(0).subjects.at(0).assessment;
  EXPECT_EQ(assessment.displacement.behaviour, Behaviour::proper) << assessment.displacement.reason;
  EXPECT_NEAR(assessment.displacement.order, 2.0, 0.2) << assessment.displacement.reason;
  EXPECT_EQ(assessment.verdict, Verdict::agrees) << assessment.displacement.reason;
}

constexpr PaperSystem systems[] = {{0, 0.0},  {0, 0.05}, {0, 0.25}, {1, 0.0},   {1, 0.05},
                                   {1, 0.25}, {2, 0.0},  {2, 0.05}, {2, 0.25},  {5, 0.0},
                                   {5, 0.05}, {5, 0.25}, {20, 0.0}, {20, 0.05}, {20, 0.25}};

INSTANTIATE_TEST_SUITE_P(Eq25, PaperSystems, testing::ValuesIn(systems), [](const auto& entry) {
  return "N" + std::to_string(int(entry.param.N)) + "xi" +
         std::to_string(int(entry.param.xi1 * 100));
});

TEST(PaperSystem, ThePanelBehavesAsEachMethodClaimsOnTheDefaultCase) {
  const auto record = verify({});
  const auto behaviour = [&](std::size_t i) {
    return record.cases.at(0).subjects.at(i).assessment.displacement.behaviour;
  };
  for (const auto& method : record.cases.at(0).subjects)
    EXPECT_EQ(method.assessment.verdict, Verdict::agrees)
        << method.name << ": " << method.assessment.displacement.reason;
  EXPECT_EQ(behaviour(0), Behaviour::proper);      // newmark
  EXPECT_EQ(behaviour(1), Behaviour::proper);      // central-difference
  EXPECT_EQ(behaviour(2), Behaviour::proper);      // rk4
  EXPECT_EQ(behaviour(3), Behaviour::proper);      // generalized-alpha
  EXPECT_EQ(behaviour(4), Behaviour::irregular);   // newmark+reversal
  EXPECT_EQ(behaviour(5), Behaviour::stagnating);  // newmark+penalty
  EXPECT_EQ(behaviour(6), Behaviour::irregular);   // moreau-jean
  EXPECT_EQ(record.cases.at(0).subjects[5].assessment.displacement.reason, "contact-stiffness");
  EXPECT_EQ(exit_code(record), 0);
}

}  // namespace
}  // namespace clackers::study
