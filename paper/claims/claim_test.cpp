#include "paper/claims/claim.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "clackers/cases/case.hpp"
#include "paper/catalogue.hpp"

namespace clackers::paper {
namespace {

Judged judge(const char* criterion, const std::vector<double>& values) {
  return judged(criterion, values, [](const std::string& name) {
    return name == "other one" ? std::vector{1.0, 2.0} : throw std::logic_error(name);
  });
}

TEST(Judged, CriteriaAreMetOnOneSideOnlyAndShowWhatDecides) {
  struct Row {
    const char* criterion;
    std::vector<double> met, not_met;
    const char* shows;
  };
  const Row rows[] = {{"< 3", {1, 2}, {1, 3}, "2"},
                      {"> 1", {2, 3}, {1, 3}, "2"},
                      {"some 2", {1, 3}, {2, 3}, "1"},
                      {"= 1 2.5", {1, 2.5}, {1, 2}, "1, 2.5"},
                      {"within 1 2", {1, 2}, {1, 2.1}, "1, 2"},
                      {"beyond 1 2", {0.5, 2}, {1, 2}, "0.5, 2"},
                      {"rising", {1, 2}, {1, 1}, "1, 2"},
                      {"falling", {2, 1}, {1, 1}, "2, 1"},
                      {"same", {3, 3}, {3, 3.001}, "3, 3"},
                      {"sum", {1, 2}, {1, -1e9}, "3"},
                      {"near 0.1 other one", {1, 2.1}, {1, 2.3}, "0.05"},
                      {"unlike 0.1 other one", {1, 2.5}, {1, 2}, "0.25"}};
  for (const auto& [criterion, met, not_met, shows] : rows) {
    EXPECT_TRUE(judge(criterion, met).met) << criterion;
    EXPECT_FALSE(judge(criterion, not_met).met) << criterion;
    EXPECT_EQ(judge(criterion, met).values, shows) << criterion;
  }
  EXPECT_EQ(judge("list", {2000005.0, 1.0 / 3.0, 1e-20}).values, "2000005, 0.3333, 1e-20");
  for (const auto* criterion : {"< 3", "> -1", "list", "rising", "unlike 0.1 other one"}) {
    EXPECT_FALSE(judge(criterion, {std::nan("")}).met) << criterion;
    EXPECT_FALSE(judge(criterion, {}).met) << criterion;
  }
  EXPECT_THROW(judge("about 3", {3}), std::logic_error);
  EXPECT_THROW(judge("<", {3}), std::exception);
}

// The library's constants of Eq. (25) are formed with more digits and by other formulas.
TEST(Pair, IsTheSystemOfEq25) {
  for (const double N : {0.0, 1.0, 5.0})
    for (const double xi1 : {0.05, 0.4}) {
      const Pair pair(N, xi1);
      const auto problem = cases::make("three-parameter", {{"N", N}, {"xi1", xi1}}).problem;
      for (int i = 0; i < 2; ++i) {
        EXPECT_NEAR(pair.m[i] / problem.system.mass(i, i), 1.0, 1e-15);
        EXPECT_NEAR(pair.c[i] / problem.system.damping(i, i), 1.0, 1e-15);
        EXPECT_NEAR(pair.k[i] / problem.system.stiffness(i, i), 1.0, 1e-15);
        EXPECT_NEAR(pair.u[i] / problem.start.u[i], 1.0, 1e-15);
        EXPECT_NEAR(pair.v[i] / problem.start.v[i], 1.0, 1e-15);
      }
    }
}

TEST(Impacts, ShowWhatADesignLacks) {
  const Impacts right(Pair(1.0, 0.1), 20.0);
  EXPECT_EQ(right.count, 6);
  for (const double off : {right.u, right.late, right.turned, right.momentum, right.rate})
    EXPECT_LT(off, 1e-13);
  // Speeds of both masses: Omega exp(-0.1 t) and three times as much, at the sixth impact.
  const double Omega = std::sqrt(0.99);
  EXPECT_NEAR(right.closing, 4.0 * Omega * std::exp(-0.1 * 5.5 * std::numbers::pi / Omega), 1e-12);
  auto slow = Pair(1.0, 0.1);
  slow.v[1] = 0.0;
  EXPECT_GT(Impacts(slow, 20.0).u, 1e-4);
  auto damped = Pair(1.0, 0.1);
  damped.c[1] *= 1.1;
  EXPECT_GT(Impacts(damped, 20.0).rate, 1e-4);
  auto heavy = Pair(1.0, 0.1);
  for (auto* x : {heavy.m, heavy.c, heavy.k}) x[1] *= 1.5;
  EXPECT_NEAR(Impacts(heavy, 2.0).momentum, 0.5, 1e-12);
  EXPECT_GT(Impacts(heavy, 2.0).turned, 0.1);
}

TEST(Difference, SeesAFormulaThatIsWrongByAPercent) {
  Pair wrong(0.0, 0.05, 1.0);
  const auto run = history(wrong.problem(20.0), "rk4", 0.01);
  EXPECT_LT(difference(run, wrong), 1e-8);
  wrong.sigma *= 1.01;
  EXPECT_GT(difference(run, wrong), 1e-3);
}

TEST(Claims, EachMeasureIsUsedAndEachNameOnce) {
  std::set<std::string_view> names;
  for (const auto table : {measures_of_pairs(), measures_of_figures()})
    for (const auto& measure : table) {
      EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
      EXPECT_NE(assets::claims_json.find(std::string(measure.name) + '"'), std::string_view::npos)
          << measure.name << " is used by no claim";
    }
}

TEST(Claims, InterruptLeavesTheRestOut) {
  Figure figure;
  figure.name = "fig1";
  const std::atomic<bool> interrupt{true};
  EXPECT_TRUE(claims_beside(figure, &interrupt).empty());
  EXPECT_GE(claims_beside(figure, nullptr).size(), 3u);
}

}  // namespace
}  // namespace clackers::paper
