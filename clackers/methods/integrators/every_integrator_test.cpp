// The facts of every integrator of the registry with a fixed step, measured.

#include <algorithm>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

class EveryIntegrator : public testing::TestWithParam<std::string> {};
class EveryNonlinearIntegrator : public testing::TestWithParam<std::string> {};

TEST_P(EveryIntegrator, ConvergesAtTheOrderItClaims) {
  checks::converges_at_the_order_it_claims(GetParam());
}
TEST_P(EveryNonlinearIntegrator, ConvergesAtTheSameOrderWithANonlinearForce) {
  checks::converges_at_the_same_order_with_a_nonlinear_force(GetParam());
}
TEST_P(EveryIntegrator, IsStableExactlyWhereItClaims) {
  checks::is_stable_exactly_where_it_claims(GetParam());
}
TEST_P(EveryIntegrator, HasItsSpectralRadiusAtInfinity) {
  checks::has_its_radius_at_infinity(GetParam());
}
TEST_P(EveryIntegrator, TakesAPartialStepThatLeadsToTheStep) {
  checks::takes_a_partial_step_that_leads_to_the_step(GetParam());
}
TEST_P(EveryIntegrator, GoesBackIntoABlock) { checks::goes_back_into_a_block(GetParam()); }
TEST_P(EveryIntegrator, KeepsItsOrderWhenRestarted) {
  checks::keeps_its_order_when_restarted(GetParam());
}
TEST_P(EveryIntegrator, CountsItsWork) { checks::counts_its_work(GetParam()); }
TEST_P(EveryIntegrator, CountsTimeAndDoesNotSumIt) {
  checks::counts_time_and_does_not_sum_it(GetParam());
}

TEST_P(EveryIntegrator, RefusesStepsThatAreNotPositiveAndFinite) {
  const auto system = checks::oscillator();
  const auto chosen = integrator(GetParam());
  for (const double h : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(chosen->stepper(system, checks::endless(0.0, h)), InputError) << h;
}

// Restarted after every second step, as by impacts inside their start, multistep methods have the order of the
// steps that they start with, or for two steps their own.
TEST(Multistep, RestartedInsideItsStartHasTheOrderThatItsCardStates) {
  const checks::Waves<1> problem(1, 0.3);
  for (const std::string name : {"bdf2", "houbolt", "park", "bdf3", "bdf4", "bdf5", "bdf6"}) {
    const bool is_second = integrator(name)->facts().smooth_order < 2.5;
    const auto error = [&](double h) {
      auto now = problem.exact(1.0);
      checks::SingleSteps<1> stepper(name, problem.system, h, now);
      for (int i = 1; double(i) * h < 4.0; ++i) {
        stepper.step(now);
        if (i % 2 != 0) continue;
        stepper->restart(now);
      }
      return (now.u - problem.exact(now.t).u).norm();
    };
    const auto fit = checks::observed_order(error, 1.0 / 8, 5);
    EXPECT_NEAR(fit.order, is_second ? 2.0 : 5.0, is_second ? 0.2 : 0.5) << name;
  }
}

std::vector<std::string> registered(bool is_linear_too) {
  std::vector<std::string> all;
  for (const auto& entry : entries()) {
    if (entry.kind != "integrator") continue;
    const auto facts = integrator(entry.name)->facts();
    if (!facts.is_adaptive && (is_linear_too || !facts.is_linear_only)) all.push_back(entry.name);
  }
  return all;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryIntegrator, testing::ValuesIn(registered(true)), test_name);
INSTANTIATE_TEST_SUITE_P(Registry, EveryNonlinearIntegrator, testing::ValuesIn(registered(false)),
                         test_name);

// Other values of their parameters.
const auto with_parameters = testing::Values(
    "newmark:beta=0", "newmark:beta=0.2", "newmark:beta=0.3025,gamma=0.6",
    "newmark:beta=0.2,gamma=0.55", "dissipative-newmark:gamma=0.9", "generalized-alpha:rho=0",
    "generalized-alpha:rho=0.5", "generalized-alpha:rho=0.8", "hht-alpha:alpha=-0.3",
    "wbz-alpha:rho=0.2", "wilson-theta:theta=1.37", "collocation:theta=1.02,beta=0.245",
    "rho-infinity-bathe:rho=0", "rho-infinity-bathe:rho=1", "explicit-generalized-alpha:rho=0.3665",
    "explicit-generalized-alpha:rho=1", "tchamwa-wielgosz:phi=1.1", "noh-bathe:p=0.58",
    "kr-alpha:rho=0.9", "kr-alpha:rho=0");

INSTANTIATE_TEST_SUITE_P(Parameters, EveryIntegrator, with_parameters, test_name);
INSTANTIATE_TEST_SUITE_P(Parameters, EveryNonlinearIntegrator, with_parameters, test_name);

}  // namespace
}  // namespace clackers::methods
