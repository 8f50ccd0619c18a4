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

model::Trajectory path_of(const char* name, const model::ImpactProblem<>& problem, double h) {
  model::TrajectorySink sink(true);
  const auto outcome = methods::method(name)->prepare(problem, h)->advance(sink);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  return sink.trajectory();
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
  const auto located = path_of("rk4", problem, 0.01), again = path_of("newmark", problem, 0.0025),
             stepped = path_of("moreau-jean", problem, 0.0005);
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

const cases::Settings disks[] = {
    {},
    {{"mu", 0.0}},
    {{"g", 2.0}, {"eta", 0.5}, {"mu", 1.0 / 3.0}, {"vx0", 9.0}, {"w0", 0.0}},  // slides at rest
    {{"eta", 0.0}, {"vx0", -3.0}},
    {{"beta", 0.4}, {"w0", -20.0}}};

// Between impacts, stick and slip the forces are constant.
TEST(Friction, OfAContactIsLocatedToRounding) {
  for (const auto& settings : disks) {
    const auto test_case = cases::make("oblique-disk", settings);
    for (const auto* name : {"newmark", "central-difference", "rk4"})
      for (const double steps : {100.0, 713.0})
        EXPECT_LT(error_of(*methods::method(name), test_case, test_case.problem.end / steps), 1e-11)
            << name << " mu " << test_case.problem.frictions[0].limit;
    EXPECT_LT(
        error_of(*methods::method("dopri5"), test_case, methods::Resolution::by_tolerance(1e-9)),
        1e-8);
  }
}

TEST(Friction, OfAContactByMoreauAndJeanIsOfFirstOrder) {
  const auto method = methods::method("moreau-jean");
  for (const auto i : {0, 2}) {
    const auto test_case = cases::make("oblique-disk", disks[i]);
    const double fall =
        upper_envelope(*method, test_case, 250.0) / upper_envelope(*method, test_case, 2000.0);
    EXPECT_NEAR(std::log2(fall) / 3.0, 1.0, 0.2) << i;
  }
}

TEST(Friction, OfASecondRunIsThatOfTheFirst) {
  const auto problem = cases::make("oblique-disk", disks[2]).problem;
  const auto prepared = methods::method("rk4")->prepare(problem, 0.01);
  model::TrajectorySink first(true), second(true);
  const auto searches = prepared->advance(first).work.event_searches;
  EXPECT_GT(searches, 5);
  EXPECT_EQ(prepared->advance(second).work.event_searches, searches);
  EXPECT_EQ(first.trajectory().u, second.trajectory().u);
}

// A mass on a spring along a floor that moves; a load lifts it and drops it, so that it bounces, rests,
// sticks and slips, under a changing normal force. Two methods that share nothing.
TEST(Friction, OfALiftedMassIsTheSameByMoreauAndJeanAndLocated) {
  auto problem = cases::make("oblique-disk").problem;
  problem.system.mass = Eigen::Vector2d(1.0, 2.0).asDiagonal();
  problem.system.damping = Eigen::Vector2d(0.1, 0.0).asDiagonal();
  problem.system.stiffness = Eigen::Vector2d(4.0, 0.0).asDiagonal();
  problem.system.add_load = [](double t, std::span<double> f) {
    f[0] += 3.0 * std::cos(1.3 * t);
    f[1] += -5.0 + 7.0 * std::sin(0.9 * t);
  };
  problem.contacts = {{Eigen::Vector2d(0.0, 1.0), 0.0, 0.4}};
  problem.frictions = {{Eigen::Vector2d(-2.0, 0.0), 0.3, 0.3, 0.2, 0}};
  problem.start = {0.0, Eigen::Vector2d(0.3, 0.5), Eigen::Vector2d(1.0, 0.0)};
  problem.end = 20.0;
  const auto exact = path_of("rk4", problem, 0.0025);
  int sticks = 0, slides = 0, flies = 0;
  const auto apart = [&](const char* name, double h) {
    const auto path = path_of(name, problem, h);
    double most = 0.0;
    const auto ratio = std::size_t(std::round(0.0025 / h * 64.0));
    for (std::size_t i = 0; i < exact.t.size(); i += 64)
      for (std::size_t j = 0; j < 2; ++j)
        most = std::max(most, std::abs(exact.u[2 * i + j] - path.u[2 * (i / 64) * ratio + j]));
    return most;
  };
  for (std::size_t i = 0; i < exact.t.size(); ++i) {
    const bool flying = exact.u[2 * i + 1] > 1e-9;
    flies += flying ? 1 : 0;
    (std::abs(exact.v[2 * i] + 0.1) < 1e-12 ? sticks : slides) += flying ? 0 : 1;
  }
  EXPECT_GT(sticks, 300);
  EXPECT_GT(slides, 300);
  EXPECT_GT(flies, 300);
  EXPECT_GT(exact.impacts->size(), 10u);
  EXPECT_LT(apart("rk4", 0.005), 1e-8);
  const double coarse = apart("newmark", 0.01), fine = apart("newmark", 0.0025);
  EXPECT_NEAR(std::log2(coarse / fine) / 2.0, 2.0, 0.2);
  const double first = apart("moreau-jean", 0.0025), last = apart("moreau-jean", 0.0003125);
  EXPECT_LT(last, 2e-3);
  EXPECT_NEAR(std::log2(first / last) / 3.0, 1.0, 0.35);
}

// u'' = -+0.1 from v = 1 up to a stop at u = 1, back with half the speed, and at rest where it began.
TEST(Friction, OfASliderAgainstAStopIsTakenByMoreauAndJean) {
  auto problem = cases::make("slider").problem;
  problem.system.stiffness.setZero();
  problem.contacts = {{-Eigen::VectorXd::Ones(1), -1.0, 0.5}};
  problem.frictions[0].limit = problem.frictions[0].kinetic = 0.1;
  problem.start = {0.0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
  problem.end = 8.0;
  for (const double h : {0.01, 0.001}) {
    const auto path = path_of("moreau-jean", problem, h);
    ASSERT_EQ(path.impacts->size(), 1u);
    EXPECT_NEAR(path.impacts->front().t, 10.0 - std::sqrt(80.0), 1.5 * h);
    EXPECT_NEAR(path.u.back(), 0.0, 2.0 * h);
    EXPECT_NEAR(path.v.back(), 0.0, 1e-15);
  }
  // Pressed against the stop, where contact and friction hold the same mass.
  problem.contacts[0].restitution = 0.0;
  problem.system.add_load = [](double, std::span<double> f) { f[0] += 0.5; };
  const auto path = path_of("moreau-jean", problem, 0.001);
  EXPECT_NEAR(path.u.back(), 1.0, 2e-3);
  EXPECT_NEAR(path.v.back(), 0.0, 1e-15);
}

TEST(Friction, OfAContactIsRefusedWhereItsForceIsUnknown) {
  auto disk = cases::make("oblique-disk").problem;
  for (const auto* name : {"newmark+reversal", "paoli-schatzman", "newmark+penalty"})
    EXPECT_REFUSED(methods::method(name)->prepare(disk, 0.01), "linear-only", "friction");
  auto problem = disk;
  problem.system.stiffness(1, 1) = 1.0;
  EXPECT_REFUSED(methods::method("rk4")->prepare(problem, 0.01), "linear-only",
                 "contact 1 has friction");
  EXPECT_NO_THROW(methods::method("moreau-jean")->prepare(problem, 0.01));
  problem = disk;
  problem.system.damping(1, 1) = 1.0;
  EXPECT_REFUSED(methods::method("rk4")->prepare(problem, 0.01), "linear-only",
                 "contact 1 has friction");
  problem = disk;
  problem.contacts.push_back({Eigen::Vector3d(0.0, -1.0, 0.0), -5.0, 1.0});
  EXPECT_REFUSED(methods::method("rk4")->prepare(problem, 0.01), "linear-only",
                 "contact 1 has friction");
  problem = disk;
  problem.frictions[0].direction[1] = 0.1;
  EXPECT_REFUSED(methods::method("rk4")->prepare(problem, 0.01), "linear-only",
                 "contact 1 and row 1 of friction share a mass");
}

TEST(Friction, IsRefusedByMethodsWithoutALawOfIt) {
  const auto slider = cases::make("slider").problem;
  for (const auto* name : {"newmark+reversal", "d1-minus", "paoli-schatzman", "piecewise-exact"})
    EXPECT_REFUSED(methods::method(name)->prepare(slider, 0.01), "linear-only", "dry friction");
  auto problem = slider;
  problem.contacts = {{Eigen::VectorXd::Ones(1), -1.0, 1.0}};
  EXPECT_REFUSED(methods::method("newmark+penalty")->prepare(problem, 0.01), "linear-only",
                 "contacts");
  EXPECT_REFUSED(methods::method("newmark")->prepare(problem, 0.01), "linear-only",
                 "contact 1 and row 1 of friction share a mass");
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
