// The order of every located-impact method against the true motions, as its facts claim it.

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/assess/errors/error_sink.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers {
namespace {

struct Trial {
  std::string method, case_name;
  cases::Settings settings;
  double coarsest;  ///< [s], about 1/60 of the fast period: the asymptotic range
};

double error_of(const Trial& trial, const cases::Case& which, double steps) {
  const double h = which.problem.end / std::round(steps);
  assess::ErrorSink sink(*which.motion, which.problem, h);
  const auto outcome = methods::method(trial.method)->prepare(which.problem, h)->advance(sink);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  return sink.score(outcome).u_error;
}

class ImpactOrder : public testing::TestWithParam<Trial> {};

// Least squares over five levels of ratio 2; steps that share no factor with the collision times.
TEST_P(ImpactOrder, IsTheClaimedOne) {
  const auto& trial = GetParam();
  const auto which = cases::make(trial.case_name, trial.settings);
  const auto claim = methods::method(trial.method)->facts().through_impacts;
  ASSERT_EQ(claim.behaviour, Behaviour::proper);
  double sxx = 0.0, sxy = 0.0;
  for (int i = -2; i <= 2; ++i) {
    const double steps = (which.problem.end / trial.coarsest) * std::exp2(i + 2) + 0.37;
    sxx += i * i;
    sxy += i * std::log2(error_of(trial, which, steps));
  }
  EXPECT_NEAR(-sxy / sxx, claim.order, 0.1 * claim.order);
}

std::vector<Trial> trials() {
  std::vector<Trial> all;
  for (const std::string method : {"newmark", "newmark:beta=0.1", "central-difference", "rk4",
                                   "generalized-alpha:rho=0.8", "generalized-alpha:rho=0"}) {
    const bool is_rk4 = method == "rk4";
    all.push_back({method, "stop", {{"eta", 0.7}}, is_rk4 ? 0.05 : 0.02});
    all.push_back({method, "symmetric-pair", {{"eta", 0.9}}, is_rk4 ? 0.05 : 0.02});
    all.push_back({method, "three-parameter", {}, is_rk4 ? 0.01 : 0.002});
    all.push_back({method, "exact-data-pair", {}, is_rk4 ? 0.01 : 0.005});
    all.push_back({method,
                   "synchronized-pair",
                   {{"X", 3.0}, {"r", 0.5}, {"eta", 0.0}},
                   is_rk4 ? 0.02 : 0.01});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(EventDriven, ImpactOrder, testing::ValuesIn(trials()));

// First order is reached late: the error constant of second order is larger until h is small.
INSTANTIATE_TEST_SUITE_P(
    Dissipative, ImpactOrder,
    testing::Values(Trial{"newmark:beta=0.3025,gamma=0.6", "stop", {{"eta", 0.7}}, 0.002},
                    Trial{"newmark:beta=0.3025,gamma=0.6", "symmetric-pair", {}, 0.002}));

}  // namespace
}  // namespace clackers
