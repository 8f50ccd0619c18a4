// What methods with a law of friction claim of it, measured against the exact motions.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers {
namespace {

double error_of(const methods::Method& method, const cases::Case& test_case,
                const methods::Resolution& resolution) {
  const double scale = test_case.problem.end / 1e4;
  measure::ErrorSink sink(*test_case.motion, test_case.problem,
                          resolution.is_tolerance() ? scale : resolution.step);
  const auto outcome = method.prepare(test_case.problem, resolution)->advance(sink);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  return sink.score(outcome).u_error;
}

// The largest error of eight neighbouring steps.
double upper_envelope(const methods::Method& method, const cases::Case& test_case, double steps) {
  double worst = 0.0;
  for (int i = 0; i < 8; ++i)
    worst = std::max(
        worst, error_of(method, test_case,
                        test_case.problem.end / std::round(steps * std::exp2(i / 8.0) + 0.37)));
  return worst;
}

double order(const methods::Method& method, const cases::Case& test_case, double steps) {
  std::vector<double> x, y;
  for (int i = 0; i < 4; ++i) {
    const double n = steps * std::exp2(i);
    x.push_back(-std::log2(n));
    y.push_back(std::log2(upper_envelope(method, test_case, n)));
  }
  return numerics::fit_line(x, y).slope;
}

const char* const all_cases[] = {"slider", "belt", "forced-slider"};

TEST(Friction, IsLocatedToTheOrderOfTheIntegrator) {
  for (const auto* name : all_cases) {
    const auto test_case = cases::make(name);
    for (const auto* integrator :
         {"newmark", "central-difference", "bathe", "rk4", "generalized-alpha:rho=0.8"}) {
      const auto method = methods::method(integrator);
      const double claimed = method->facts().smooth_order;
      const double steps = claimed > 3.0 ? 300.0 : claimed > 1.5 ? 600.0 : 5000.0;
      EXPECT_NEAR(order(*method, test_case, steps), claimed, 0.15) << name << " " << integrator;
    }
  }
}

TEST(Friction, IsLocatedByAdaptiveIntegratorsToTheirTolerance) {
  for (const auto* name : all_cases) {
    const auto test_case = cases::make(name);
    const auto method = methods::method("dopri5");
    for (const double tolerance : {1e-6, 1e-9})
      EXPECT_LT(error_of(*method, test_case, methods::Resolution::by_tolerance(tolerance)),
                1e3 * tolerance)
          << name;
  }
}

TEST(Friction, OfMoreauAndJeanIsOfFirstOrder) {
  for (const auto* name : all_cases)
    EXPECT_NEAR(order(*methods::method("moreau-jean"), cases::make(name), 2000.0), 1.0, 0.15)
        << name;
}

TEST(Friction, ThatIsRegularCreepsByItsWidth) {
  const auto slider = cases::make("slider");
  const auto error = [&](double width) {
    return error_of(*methods::method("newmark+penalty:width=" + std::to_string(width)), slider,
                    1e-4);
  };
  const double wide = error(0.004), narrow = error(0.001);
  EXPECT_GT(narrow, 1e-4);
  EXPECT_NEAR(wide / narrow, 4.0, 1.5);
}

// Two masses with a spring between, each rubbing on a belt of its own: no case, but two methods that
// share nothing.
TEST(Friction, OfTwoMassesIsTheSameByMoreauAndJeanAndLocated) {
  auto problem = cases::make("belt").problem;
  const auto matrix = [](double a, double b, double c) {
    return (Eigen::MatrixXd(2, 2) << a, b, b, c).finished();
  };
  problem.system.mass = matrix(1.0, 0.0, 0.5);
  problem.system.damping = matrix(0.02, -0.01, 0.01);
  problem.system.stiffness = matrix(2.0, -1.0, 1.5);
  problem.start = {0.0, Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(0.0, 0.1)};
  problem.end = 30.0;
  problem.frictions = {{Eigen::Vector2d(1.0, 0.0), 0.6, 0.4, 0.3},
                       {Eigen::Vector2d(0.0, 2.0), 0.2, 0.1, -0.2}};
  const auto run = [&](const char* name, double h) {
    model::TrajectorySink sink(true);
    const auto outcome = methods::method(name)->prepare(problem, h)->advance(sink);
    EXPECT_TRUE(outcome.finished) << outcome.detail;
    return sink.trajectory();
  };
  const auto located = run("rk4", 0.01), again = run("newmark", 0.0025),
             stepped = run("moreau-jean", 0.0005);
  ASSERT_EQ(located.t.size(), 3001u);
  double apart = 0.0, newmark = 0.0;
  int sticking = 0;
  for (std::size_t i = 0; i < located.t.size(); ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      apart = std::max(apart, std::abs(located.u[2 * i + j] - stepped.u[40 * i + j]));
      newmark = std::max(newmark, std::abs(located.u[2 * i + j] - again.u[8 * i + j]));
      sticking += std::abs(located.v[2 * i + j] - (j == 0 ? 0.3 : -0.1)) < 1e-12 ? 1 : 0;
    }
  EXPECT_GT(sticking, 500);
  EXPECT_LT(newmark, 1e-4);
  EXPECT_LT(apart, 5e-3);
}

TEST(Friction, IsRefusedByMethodsWithoutALawOfIt) {
  const auto slider = cases::make("slider").problem;
  for (const auto* name : {"newmark+reversal", "d1-minus", "paoli-schatzman", "piecewise-exact"})
    EXPECT_REFUSED(methods::method(name)->prepare(slider, 0.01), "linear-only", "dry friction");
  auto problem = slider;
  problem.contacts = {{Eigen::VectorXd::Ones(1), -1.0, 1.0}};
  for (const auto* name : {"newmark", "newmark+penalty", "moreau-jean"})
    EXPECT_REFUSED(methods::method(name)->prepare(problem, 0.01), "linear-only", "contacts");
  problem = slider;
  problem.frictions.push_back(problem.frictions[0]);
  EXPECT_REFUSED(methods::method("newmark")->prepare(problem, 0.01), "linear-only", "share a mass");
  EXPECT_NO_THROW(methods::method("moreau-jean")->prepare(problem, 0.01));
  problem = slider;
  problem.system.stiffness.setZero();
  EXPECT_REFUSED(methods::method("newmark+penalty")->prepare(problem, 0.01), "no-default-stiffness",
                 "width");
}

}  // namespace
}  // namespace clackers
