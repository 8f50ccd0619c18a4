// The claim through impacts of every method of the registry, measured against the exact motions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/cases/case.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers {
namespace {

// A case and the coarsest steps at which a method of order 1, 2 and 4 is in its asymptotic range:
// about 1/60 of the fast period for order 2. First order is reached late, since the error of second
// order is larger until h is small; 0: not within a test's time.
struct Task {
  std::string name;
  cases::Settings settings;
  double first, second, fourth;  ///< [s]

  double coarsest(double order) const {
    if (order > 4.5) return 2.0 * fourth;
    if (order > 2.5) return fourth;
    return order > 1.5 ? second : first;
  }
};

const std::vector<Task>& tasks() {
  static const std::vector<Task> all{
      {"stop", {}, 0.002, 0.02, 0.05},
      {"stop", {{"eta", 0.7}}, 0.002, 0.02, 0.05},
      {"symmetric-pair", {{"eta", 0.9}}, 0.002, 0.02, 0.05},
      {"three-parameter", {}, 0.0, 0.002, 0.01},
      {"exact-data-pair", {}, 0.0, 0.005, 0.01},
      {"synchronized-pair", {{"X", 3.0}, {"r", 0.5}, {"eta", 0.0}}, 0.0, 0.01, 0.02}};
  return all;
}

measure::RunScore score_of(const methods::Method& method, const cases::Case& test_case,
                           double steps) {
  const double h = test_case.problem.end / steps;
  measure::ErrorSink sink(*test_case.motion, test_case.problem, h);
  const auto outcome = method.prepare(test_case.problem, h)->advance(sink);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  return sink.score(outcome);
}

double error_of(const methods::Method& method, const cases::Case& test_case, double steps) {
  return score_of(method, test_case, steps).u_error;
}

// Least squares over five levels of ratio 2, without those at the floor of rounding, but three at
// least; steps that share no factor with the impact times.
double observed_order(const methods::Method& method, const cases::Case& test_case,
                      double coarsest) {
  std::vector<double> x, y;
  for (int i = 0; i < 5; ++i) {
    const double steps = std::round((test_case.problem.end / coarsest) * std::exp2(i) + 0.37);
    const double error = error_of(method, test_case, steps);
    if (i > 2 && error < 3e-12) break;
    x.push_back(-std::log2(steps));
    y.push_back(std::log2(error));
  }
  return numerics::fit_line(x, y).slope;
}

// Slopes of the error over the mean step and over the tolerance, of an adaptive method. Where
// impacts end many of its steps there is no mean one: `in_mean_step` is nothing.
struct AdaptiveOrder {
  std::optional<double> in_mean_step;
  double in_tolerance;
};
AdaptiveOrder adaptive_order(const methods::Method& method, const cases::Case& test_case) {
  std::vector<double> steps, tolerances, errors;
  bool has_mean_step = true;
  for (int i = 0; i <= 8; ++i) {
    const double tolerance = std::pow(10.0, -6.0 - 0.5 * i);
    const double scale =
        test_case.problem.end / 1e4;  // of the matcher of impacts, which are not used
    measure::ErrorSink sink(*test_case.motion, test_case.problem, scale);
    const auto outcome =
        method.prepare(test_case.problem, methods::Resolution::by_tolerance(tolerance))
            ->advance(sink);
    EXPECT_TRUE(outcome.finished) << outcome.detail;
    const double error = sink.score(outcome).u_error;
    if (i > 5 && error < 3e-12) break;
    const auto events = outcome.work.event_searches;
    has_mean_step = has_mean_step && 20 * events < outcome.work.steps;
    // A step that an event ends is half of one on average.
    steps.push_back(-std::log(double(outcome.work.steps) - 0.5 * double(events)));
    tolerances.push_back(std::log(tolerance));
    errors.push_back(std::log(error));
  }
  AdaptiveOrder found{{}, numerics::fit_line(tolerances, errors).slope};
  if (has_mean_step) found.in_mean_step = numerics::fit_line(steps, errors).slope;
  return found;
}

// The largest error of eight neighbouring steps.
double envelope(const methods::Method& method, const cases::Case& test_case, double coarsest) {
  double worst = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double steps = std::round(test_case.problem.end / coarsest * std::exp2(i / 8.0));
    worst = std::max(worst, error_of(method, test_case, steps));
  }
  return worst;
}

// Of the error and of the ratio of energies at the end, over neighbouring steps.
std::pair<double, double> medians(const methods::Method& method, const cases::Case& test_case,
                                  double coarsest) {
  std::vector<double> errors, energies;
  for (int i = 0; i < 9; ++i) {
    const double steps = std::round(test_case.problem.end / coarsest * std::exp2(i / 9.0));
    const auto score = score_of(method, test_case, steps);
    errors.push_back(score.u_error);
    energies.push_back(score.energy_ratio);
  }
  std::ranges::sort(errors);
  std::ranges::sort(energies);
  return {errors[4], energies[4]};
}

class ImpactOrder : public testing::TestWithParam<std::string> {
 protected:
  // Calls `measure` for the cases that the method takes and that have steps for its order.
  void for_each_case(const auto& measure) const {
    int measured = 0;
    for (const auto& task : tasks()) {
      const auto test_case = cases::make(task.name, task.settings);
      const double coarsest = task.coarsest(facts.smooth_order);
      if (chosen->objection(test_case.problem) || coarsest == 0.0) continue;
      SCOPED_TRACE(task.name);
      measure(test_case, coarsest);
      ++measured;
    }
    EXPECT_GE(measured, 1) << "no case measures the claim of " << facts.name;
  }

  void expect_floor_by_tolerance(const cases::Case& test_case) const {
    const auto error = [&](double tolerance) {
      measure::ErrorSink sink(*test_case.motion, test_case.problem, test_case.problem.end / 1e4);
      const auto run =
          chosen->prepare(test_case.problem, methods::Resolution::by_tolerance(tolerance));
      const auto outcome = run->advance(sink);
      EXPECT_TRUE(outcome.finished) << outcome.detail;
      return sink.score(outcome).u_error;
    };
    const double coarse = error(1e-8), fine = error(1e-10);
    EXPECT_GT(fine, 1e-4);
    EXPECT_NEAR(fine / coarse, 1.0, 0.1);
  }

  std::shared_ptr<const methods::Method> chosen = methods::method(GetParam());
  methods::Facts facts = chosen->facts();
};

TEST_P(ImpactOrder, IsTheClaimedOne) {
  const auto& claim = facts.through_impacts;
  switch (claim.behaviour) {
    case Behaviour::proper:
      return for_each_case([&](const cases::Case& test_case, double coarsest) {
        const auto here = methods::claim_on(facts, test_case.problem, true);
        if (here.behaviour == Behaviour::exact) {
          for (const double h : {0.4, 0.05})
            EXPECT_LT(error_of(*chosen, test_case, std::round(test_case.problem.end / h)), 1e-11)
                << h;
          return;
        }
        if (facts.is_adaptive) {
          const auto found = adaptive_order(*chosen, test_case);
          if (found.in_mean_step) {
            EXPECT_NEAR(*found.in_mean_step, claim.order, 0.1 * claim.order);
          }
          EXPECT_NEAR(found.in_tolerance, 1.0, 0.15);
          return;
        }
        EXPECT_NEAR(observed_order(*chosen, test_case, coarsest), here.order, 0.1 * here.order);
      });
    case Behaviour::exact:
      // From about the coarsest step of a study of the fastest of these motions.
      for (const auto& task : tasks()) {
        SCOPED_TRACE(task.name);
        const auto test_case = cases::make(task.name, task.settings);
        for (const double steps : {411.0, 2011.0, 20011.0}) {
          const auto score = score_of(*chosen, test_case, steps);
          EXPECT_LT(score.u_error, score.rounding_floor) << steps;
        }
      }
      return;
    case Behaviour::irregular: {
      const auto test_case = cases::make("stop");
      const double fall =
          envelope(*chosen, test_case, 0.02) / envelope(*chosen, test_case, 0.00125);
      EXPECT_NEAR(std::log2(fall) / 4.0, claim.order, 0.2);
      return;
    }
    case Behaviour::stagnating:
      return for_each_case([&](const cases::Case& test_case, double) {
        if (facts.is_adaptive) return expect_floor_by_tolerance(test_case);
        // At 25 steps a contact or more the error no longer falls, and it is not rounding. The error
        // of first order falls below it later.
        const double steps = (facts.smooth_order > 1.5 ? 25.0 : 400.0) * test_case.problem.end /
                             chosen->contact_time(test_case.problem);
        const double coarse = error_of(*chosen, test_case, std::round(steps)),
                     fine = error_of(*chosen, test_case, std::round(4.0 * steps));
        EXPECT_GT(fine, 1e-4);
        EXPECT_NEAR(fine / coarse, 1.0, 0.5);
      });
    case Behaviour::divergent:
      return for_each_case([&](const cases::Case& test_case, double coarsest) {
        for (const double h : {coarsest, coarsest / 8.0}) {
          const auto [error, energy] = medians(*chosen, test_case, h);
          EXPECT_GT(error, 0.5);
          EXPECT_GT(energy, 2.0);
        }
      });
    case Behaviour::undecided:  // no law of impact: errors as large as the motion at any step
      return for_each_case([&](const cases::Case& test_case, double coarsest) {
        for (const double h : {coarsest, coarsest / 8.0}) {
          const auto [error, energy] = medians(*chosen, test_case, h);
          EXPECT_GT(error, 0.1);
          EXPECT_LT(energy, 1.0);
        }
      });
    default:
      ADD_FAILURE() << facts.name << " claims " << to_string(claim.behaviour)
                    << ", which no test measures";
  }
}

// On `row` four contacts that share masses close at each instant, and the errors of a method close them
// apart.
TEST_P(ImpactOrder, IsTheClaimedOneWhereImpactsAreSimultaneous) {
  if (facts.through_impacts.behaviour != Behaviour::proper ||
      facts.exact_under >= methods::ExactUnder::no_load)
    GTEST_SKIP() << "claims no order";
  const auto test_case = cases::make("row");
  if (chosen->objection(test_case.problem)) GTEST_SKIP() << "does not take it";
  if (facts.is_adaptive) {
    EXPECT_NEAR(adaptive_order(*chosen, test_case).in_tolerance, 1.0, 0.15);
    return;
  }
  const double order = facts.through_impacts.order;
  const double coarsest = order > 2.5 ? 0.04 : order > 1.5 ? 0.02 : 0.002;
  EXPECT_NEAR(observed_order(*chosen, test_case, coarsest), order, 0.1 * order);
}

// The displacement's order is 2 where the gap is closed and 1 where it is reversed; the velocity is off by as
// much as the motion of the two steps of each impact.
TEST(ImpactOrder, OfForwardIncrementsIsThatOfTheRestitution) {
  const auto chosen = methods::method("forward-increment-lagrange");
  for (const double eta : {0.0, 0.5, 0.8, 1.0}) {
    const auto test_case = cases::make("stop", {{"eta", eta}});
    std::vector<double> x, u(4, 0.0), v(4, 0.0);  // of upper envelopes
    for (std::size_t i = 0; i < 4; ++i) {
      for (int j = 0; j < 8; ++j) {
        const double steps = std::round(5000.0 * std::exp2(double(i) + j / 8.0) + 0.37);
        const auto score = score_of(*chosen, test_case, steps);
        u[i] = std::max(u[i], score.u_error);
        v[i] = std::max(v[i], score.v_error);
      }
      x.push_back(-std::log(2.0) * double(i));
      u[i] = std::log(u[i]);
      v[i] = std::log(v[i]);
    }
    EXPECT_NEAR(numerics::fit_line(x, u).slope, eta == 0.0 ? 2.0 : 1.0, 0.1) << eta;
    EXPECT_NEAR(numerics::fit_line(x, v).slope, 1.0, 0.1) << eta;
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registry, ImpactOrder, testing::ValuesIn(methods::pairs()), test_name);

INSTANTIATE_TEST_SUITE_P(
    Parameters, ImpactOrder,
    testing::Values("newmark:beta=0.1", "newmark:beta=0.3025,gamma=0.6",
                    "generalized-alpha:rho=0.8", "generalized-alpha:rho=0", "hht-alpha:alpha=-0.3",
                    "wilson-theta:theta=1.37", "rho-infinity-bathe:rho=0",
                    "explicit-generalized-alpha:rho=0.3665", "tchamwa-wielgosz:phi=1.1",
                    "kr-alpha:rho=0.9", "moreau-jean:theta=0.8",
                    "nonsmooth-generalized-alpha:rho=0", "nonsmooth-generalized-alpha:rho=1"),
    test_name);

}  // namespace
}  // namespace clackers
