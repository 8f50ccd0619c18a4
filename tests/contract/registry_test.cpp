// Everything in the registry: every pair runs a small set of problems or refuses each with its
// reason, and keeps the promises of the Method interface.

#include "clackers/methods/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/model/nonlinear_springs.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::methods {
namespace {

// Masses in a row on springs of their own, a load on the first, contacts between neighbours. The
// first mass strikes the second, which touches the ones behind it: their contacts are closed at once.
model::ImpactProblem<> row_of(int n, double eta) {
  model::ImpactProblem<> p;
  p.system.mass = p.system.stiffness = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i) p.system.stiffness(i, i) = 1.0 + i;
  p.system.damping = 0.05 * p.system.mass;
  p.system.add_load = [](double t, std::span<double> f) { f[0] += 0.1 * std::sin(t); };
  for (int i = 0; i + 1 < n; ++i) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    b[i] = 1.0;
    b[i + 1] = -1.0;
    p.contacts.push_back({b, i == 0 ? -0.3 : 0.0, eta});
  }
  if (n == 1) p.contacts.push_back({Eigen::VectorXd::Ones(1), -0.3, eta});
  p.start = {0.5, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  p.start.v[0] = -1.0;
  p.end = 10.5;
  return p;
}

Resolution resolution_of(const Method& method, double h) {
  return method.facts().is_adaptive ? Resolution::by_tolerance(1e-6) : Resolution(h);
}

class EveryMethod : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const Method> chosen = method(GetParam());
};

TEST_P(EveryMethod, IsSpelledAsItsFactsSay) {
  const auto name = chosen->facts().name;
  EXPECT_EQ(method(name)->facts().name, name);
}

TEST_P(EveryMethod, ClaimsWhatCanBeMeasured) {
  const auto facts = chosen->facts();
  EXPECT_GE(facts.smooth_order, 1.0);
  EXPECT_GE(facts.stability_limit, 0.0);
  const auto& claim = facts.through_impacts;
  if (claim.behaviour == Behaviour::undecided) {
    EXPECT_EQ(claim.reason, "no-impact-law");
  }
  EXPECT_EQ(claim.order == 0.0,
            claim.behaviour == Behaviour::undecided || claim.behaviour == Behaviour::stagnating ||
                claim.behaviour == Behaviour::divergent || claim.behaviour == Behaviour::exact);
  if (!claim.reason.empty()) {
    EXPECT_NE(find_code(claim.reason), nullptr);
  }
}

TEST_P(EveryMethod, RefusesStepsThatAreNotPositiveAndFinite) {
  for (const double h : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), 11.0, 1e-9})
    EXPECT_THROW(chosen->prepare(row_of(2, 1.0), h), InputError) << "h = " << h;
}

// Its integrator alone has other events to look for, and none here.
TEST_P(EveryMethod, SharesARunOnlyWithAnEqualOne) {
  auto problem = row_of(2, 1.0);
  EXPECT_EQ(chosen->shared_run(problem), "");
  problem.contacts.clear();
  for (const bool is_nonlinear : {false, true}) {
    using model::NonlinearSprings;
    if (is_nonlinear)
      problem.system.nonlinear =
          std::make_shared<NonlinearSprings>(std::vector<NonlinearSprings::Row>{
              {.direction = Eigen::Vector2d(1.0, -0.5), .stiffness = 0.5}});
    const auto name = chosen->shared_run(problem);
    if (name.empty() || chosen->objection(problem)) continue;
    const auto states = [&](const Method& one) {
      model::TrajectorySink sink(true);
      EXPECT_TRUE(one.prepare(problem, resolution_of(one, 0.05))->advance(sink).finished);
      return sink.trajectory();
    };
    const auto own = states(*chosen), other = states(*method(name));
    EXPECT_EQ(own.u, other.u);
    EXPECT_EQ(own.v, other.v);
  }
}

TEST_P(EveryMethod, TakesAStepOrATolerance) {
  const bool is_adaptive = chosen->facts().is_adaptive;
  const auto problem = row_of(2, 1.0);
  const auto refused = [&](const Resolution& resolution) {
    return test::refusal_of([&] { chosen->prepare(problem, resolution); });
  };
  const auto name = chosen->facts().name;
  if (!is_adaptive) {
    EXPECT_EQ(
        refused(Resolution::by_tolerance(1e-6)),
        name + ": tolerance = 1e-06; allowed: a step; it is not adaptive. [wrong-resolution]");
    return;
  }
  EXPECT_EQ(refused(0.01), name +
                               ": h = 0.01; allowed: a tolerance; it chooses its steps itself. "
                               "[wrong-resolution]");
  EXPECT_EQ(refused(Resolution::by_tolerance(1e-15)),
            name +
                ": tolerance = 1e-15; allowed: tolerance >= 2.2e-14. Rounding of a step is larger "
                "than a smaller one. [tolerance-too-small]");
  for (const double tolerance : {0.0, -1e-6, 1.0})
    EXPECT_NE(refused(Resolution::by_tolerance(tolerance)).find("[out-of-range]"),
              std::string::npos)
        << tolerance;
}

TEST_P(EveryMethod, RefusesAnUnsoundProblem) {
  auto problem = row_of(2, 1.0);
  problem.system.mass(0, 0) = -1.0;
  EXPECT_THROW(chosen->prepare(problem, resolution_of(*chosen, 0.1)), InputError);
}

void expect_refused_as_objected(const Method& method, const model::ImpactProblem<>& problem,
                                const Objection& objection) {
  EXPECT_EQ(objection.sentence.find(method.facts().name), 0u) << objection.sentence;
  EXPECT_EQ(test::refusal_of([&] { method.prepare(problem, resolution_of(method, 0.01)); }),
            objection.sentence + " [" + std::string(objection.code.name()) + "]");
}

void expect_whole_run(const Method& method, const model::Trajectory& path,
                      const model::Outcome& outcome, int n) {
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  EXPECT_EQ(path.dof, n);
  EXPECT_EQ(path.t.front(), 0.5);
  EXPECT_EQ(path.t.back(), 10.5);
  EXPECT_EQ(path.u[0], 0.0);
  EXPECT_EQ(path.v[0], -1.0);
  EXPECT_TRUE(std::is_sorted(path.t.begin(), path.t.end()));
  EXPECT_GE(path.impacts->size(), 1u);
  const bool diverges = method.facts().through_impacts.behaviour == Behaviour::divergent;
  for (const double u : path.u) ASSERT_LT(std::abs(u), diverges ? 50.0 : 5.0);
  if (method.facts().is_adaptive) {
    // A step that an event ends has no row.
    EXPECT_GE(outcome.work.steps + 1, static_cast<long long>(path.t.size()));
    EXPECT_LT(outcome.work.steps, 5000);
  } else {
    EXPECT_EQ(path.t.size(), 2001u);
    EXPECT_EQ(outcome.work.steps, 2000);
  }
  EXPECT_GT(outcome.work.force_evaluations, 0);
}

TEST_P(EveryMethod, RunsOrRefusesWithItsReason) {
  for (const int n : {1, 2, 3})
    for (const double eta : {1.0, 0.5, 0.0}) {
      SCOPED_TRACE(testing::Message() << "masses " << n << ", eta " << eta);
      const auto problem = row_of(n, eta);
      if (const auto no = chosen->objection(problem)) {
        expect_refused_as_objected(*chosen, problem, *no);
        continue;
      }
      model::TrajectorySink sink(true);
      const auto outcome = chosen->prepare(problem, resolution_of(*chosen, 0.005))->advance(sink);
      expect_whole_run(*chosen, sink.trajectory(), outcome, n);
      EXPECT_EQ(chosen->contact_time(problem) > 0.0,
                chosen->facts().through_impacts.reason == "contact-stiffness");
    }
}

// Two contacts are closed when the first is struck, and one of them opens later. Rounding differs; a
// multiplier of positions makes it the largest, 2e-11.
TEST_P(EveryMethod, DoesNotDependOnTheNumbersOfTheContacts) {
  for (const double eta : {1.0, 0.0}) {
    auto problem = row_of(3, eta);
    problem.end = 3.5;
    if (chosen->objection(problem)) continue;
    model::TrajectorySink one(true), other(true);
    EXPECT_TRUE(chosen->prepare(problem, resolution_of(*chosen, 0.005))->advance(one).finished);
    std::swap(problem.contacts[0], problem.contacts[1]);
    EXPECT_TRUE(chosen->prepare(problem, resolution_of(*chosen, 0.005))->advance(other).finished);
    const auto &u = one.trajectory().u, &numbered = other.trajectory().u;
    ASSERT_EQ(u.size(), numbered.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      ASSERT_NEAR(u[i], numbered[i], 1e-9) << "eta " << eta;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, testing::ValuesIn(pairs()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST(Registry, RefusesThePairsItLeavesOutWithAReason) {
  const auto all = pairs();
  int refused = 0;
  for (const auto& one : entries())
    for (const auto& other : entries()) {
      if (one.kind != "integrator" || other.kind != "contact") continue;
      const auto name = one.name + '+' + other.name;
      const auto no = method(name)->objection(row_of(2, 1.0));
      const bool is_taken = std::ranges::find(all, name) != all.end();
      if (is_taken) continue;
      ASSERT_TRUE(no) << name;
      EXPECT_EQ(no->sentence.find(name), 0u) << no->sentence;
      EXPECT_TRUE(no->code == Code("integrator-not-taken") || no->code == Code("linear-only"));
      expect_refused_as_objected(*method(name), row_of(2, 1.0), *no);
      ++refused;
    }
  EXPECT_GT(refused, 0);
}

TEST(Registry, HasMethodsForTheDefaultPanel) {
  for (const auto& name : default_panel())
    EXPECT_FALSE(method(name)->objection(row_of(2, 1.0))) << name;
}

}  // namespace
}  // namespace clackers::methods
