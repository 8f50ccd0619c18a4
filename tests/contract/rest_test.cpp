// What every treatment and method does where impacts accumulate to rest, as its card says, against the exact motion.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/measure/impacts/impact_matcher.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers {
namespace {

constexpr double height = 0.25, force = 0.25;

// A unit mass on a unit spring, pressed against a stop at `height`: the contact force at rest is `force`.
model::ImpactProblem<> pressed_mass(double eta) {
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = Eigen::MatrixXd::Identity(1, 1);
  problem.system.damping = Eigen::MatrixXd::Zero(1, 1);
  problem.contacts = {{Eigen::VectorXd::Ones(1), height, eta}};
  problem.start = {0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
  problem.end = 20.0;
  return problem;
}

// What a method does, in units of the step h but for event-driven and piecewise-exact, whose h is 0 here.
struct Rest {
  double late = 0.0;         // the last gap of 1e-3 or more, after the exact one [s]
  double penetration = 0.0;  // largest [m]
  double sinking = 0.0;      // in the last second [m/s], over the acceleration that presses
  double share = 0.0;        // of the force in the impulses reported in the last second
  double speed = 0.0;        // largest in the last second [m/s]
};

// When the exact gap is 1e-3 for the last time, to 1e-3 s.
double last_gap(double eta) {
  const auto problem = pressed_mass(eta);
  const exact::PiecewiseMotion motion(problem);
  EXPECT_FALSE(motion.closed_contacts().at(0).opens);
  EXPECT_NEAR(motion.contact_forces(problem.end, model::Side::left)[0], force, 1e-15);
  double t = motion.closed_contacts()[0].from;
  while (motion.at(t, model::Side::right).u[0] - height <= 1e-3) t -= 1e-3;
  return t;
}

Rest rest_of(const std::string& name, double eta, double h) {
  const auto problem = pressed_mass(eta);
  model::TrajectorySink sink(true);
  const auto method = methods::method(name);
  const auto resolution = method->facts().is_adaptive ? methods::Resolution::by_tolerance(1e-10)
                                                      : methods::Resolution(h);
  const auto outcome = method->prepare(problem, resolution)->advance(sink);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  const auto& path = sink.trajectory();
  Rest rest;
  double last = 0.0, before = 0.0;
  for (std::size_t i = 0; i < path.t.size(); ++i) {
    const double t = path.t[i], gap = path.u[i] - height;
    if (gap > 1e-3) last = t;
    rest.penetration = std::max(rest.penetration, -gap);
    if (t < 19.0)
      before = gap;
    else
      rest.speed = std::max(rest.speed, std::abs(path.v[i]));
  }
  static const std::map<double, double> exact{{0.0, last_gap(0.0)}, {0.5, last_gap(0.5)}};
  rest.late = std::abs(last - exact.at(eta));
  rest.sinking = (before - (path.u.back() - height)) / force;
  for (const auto& impact : *path.impacts)
    if (impact.t >= 19.0) rest.share += impact.impulse / force;
  return rest;
}

struct Claim {
  std::string name;
  double eta;
  Rest rest;  // its late, penetration and speed are bounds in units of h
};

// With their sentence "Rest" in the card.
const std::vector<Claim>& claims() {
  // A of the card is `force`.
  constexpr double half = (1.0 - 0.5) / (1.0 + 0.5) / 2.0;
  static const std::vector<Claim> all{
      {"newmark+event-driven", 0.5, {}},
      {"rk4+event-driven", 0.5, {}},
      {"bdf3+event-driven", 0.5, {}},
      {"exponential+event-driven", 0.5, {}},
      {"dopri5+event-driven", 0.5, {}},
      {"newmark+event-driven", 0.0, {}},
      {"piecewise-exact", 0.5, {}},
      {"piecewise-exact", 0.0, {}},
      {"newmark+reversal",
       0.5,
       {.late = 6.0, .penetration = 1.0, .sinking = half, .share = 1.0, .speed = 1.0}},
      {"rk4+reversal",
       0.0,
       {.late = 1.0, .penetration = 3.0, .sinking = 0.5, .share = 1.0, .speed = 1.0}},
      {"d1-minus",
       0.5,
       {.late = 6.0, .penetration = 1.0, .sinking = half, .share = 1.0, .speed = 1.0}},
      {"d1-minus", 0.0, {.late = 1.0, .penetration = 1.0}},
      {"moreau-jean", 0.5, {.late = 6.0, .penetration = 1.0, .share = 1.0}},
      {"moreau-jean", 0.0, {.late = 1.0, .penetration = 1.0, .share = 1.0}},
      {"nonsmooth-generalized-alpha",
       0.5,
       {.late = 6.0, .penetration = 1.0, .share = 1.0, .speed = 1.0}},
      {"nonsmooth-generalized-alpha", 0.0, {.late = 1.0, .penetration = 1.0, .share = 1.0}},
      {"cd-lagrange", 0.5, {.late = 6.0, .penetration = 1.0, .share = 1.0}},
      {"cd-lagrange", 0.0, {.late = 1.0, .penetration = 1.0, .share = 1.0}},
      {"paoli-schatzman", 0.5, {.late = 6.0, .penetration = 1.0, .share = 1.0}},
      {"paoli-schatzman", 0.0, {.late = 1.0, .penetration = 1.0, .share = 1.0}},
      {"forward-increment-lagrange", 0.5, {.late = 6.0, .penetration = 1.0, .share = 1.0}},
      {"forward-increment-lagrange", 0.0, {.late = 1.0, .penetration = 1.0, .share = 1.0}}};
  return all;
}

TEST(Rest, IsReachedAsTheCardSays) {
  for (const auto& [name, eta, claim] : claims())
    for (const double h : {0.01 * 0.9973, 0.0025 * 0.9973}) {
      SCOPED_TRACE(testing::Message() << name << " eta " << eta << " h " << h);
      const auto rest = rest_of(name, eta, h);
      // Seen at the ends of steps; an adaptive method has few.
      const double seen = name.starts_with("dopri5") ? 0.5 : h + 2e-3;
      EXPECT_LE(rest.late, claim.late * h + seen);
      EXPECT_LE(rest.penetration, claim.penetration * h + 1e-14);
      EXPECT_NEAR(rest.sinking, claim.sinking * h, 0.15 * claim.sinking * h + 2e-6 * claim.late);
      EXPECT_NEAR(rest.share, claim.share, 0.15 * claim.share);
      EXPECT_LE(rest.speed, claim.speed * h + 1e-14);
    }
}

// On a spring that carries the force, at the same place for every step, and nothing is reported.
TEST(Rest, OfACompliantContactIsOnItsSpring) {
  for (const std::string law : {"kelvin-voigt", "kelvin-voigt-no-tension", "hunt-crossley",
                                "lankarani-nikravesh", "ye", "jankowski"}) {
    SCOPED_TRACE(law);
    const auto rest = rest_of("newmark+penalty:law=" + law, 0.5, 0.0025);
    EXPECT_GT(rest.penetration, 1e-5);
    EXPECT_NEAR(rest.sinking, 0.0, 1e-12);
    EXPECT_LT(rest.speed, 1e-12);
    EXPECT_EQ(rest.share, 0.0);
  }
}

model::ImpactProblem<> ball(double eta) {
  auto problem = pressed_mass(eta);
  problem.system.stiffness.setZero();
  problem.system.add_load = model::HarmonicLoad({{0, -10.0, 0.0, 0.0}});
  problem.contacts[0].gap = 0.0;
  problem.end = 1.0 / (1.0 - eta);  // at rest from 0.45 (1 + eta) of it on
  return problem;
}

// Steps do not resolve the last impacts, which methods of order 1 find early and late; a report that
// belongs to no impact is still one too many.
TEST(Rest, OfABallIsJudgedByTheImpactsThatStepsResolve) {
  for (const double eta : {0.2, 0.3, 0.5, 0.7, 0.8, 0.9}) {
    const auto problem = ball(eta);
    const exact::PiecewiseMotion motion(problem);
    ASSERT_EQ(motion.closed_contacts().size(), 1u);
    for (const std::string name :
         {"newmark+reversal", "d1-minus", "moreau-jean", "cd-lagrange",
          "nonsmooth-generalized-alpha", "paoli-schatzman", "rk4+event-driven"})
      for (double h = 1e-3; h > 2.5e-4; h *= 0.917) {
        SCOPED_TRACE(testing::Message() << name << " eta " << eta << " h " << h);
        model::TrajectorySink sink(true);
        const auto outcome =
            methods::method(name)->prepare(problem, methods::Resolution(h))->advance(sink);
        EXPECT_TRUE(outcome.finished) << outcome.detail;
        std::vector<double> times;
        for (const auto& impact : *sink.trajectory().impacts) times.push_back(impact.t);
        const auto score = [&] {
          measure::ImpactMatcher matcher(motion, h);
          for (const double t : times)
            matcher.take(t, measure::rests_in_contact(motion, problem.contacts, 0, t));
          return matcher.score(problem.end, 0.0);
        };
        EXPECT_GE(score().expected, 1);
        EXPECT_EQ(score().missed + score().extra, 0);
        times.insert(times.begin() + 1, times[0] + 0.35 * (times[1] - times[0]));
        EXPECT_EQ(score().missed, 0);
        EXPECT_EQ(score().extra, 1);
      }
  }
}

TEST(Rest, IsClaimedByEveryTreatment) {
  for (const auto& entry : methods::entries()) {
    if (entry.kind == "integrator") continue;
    SCOPED_TRACE(entry.name);
    EXPECT_NE(entry.card.find("\nRest        "), std::string::npos);
    const auto name = (entry.kind == "contact" ? "newmark+" : "") + entry.name;
    const bool is_measured = std::ranges::any_of(
        claims(), [&](const Claim& claim) { return claim.name.ends_with(entry.name); });
    EXPECT_TRUE(is_measured || methods::method(name)->objection(pressed_mass(0.5))) << name;
  }
}

}  // namespace
}  // namespace clackers
