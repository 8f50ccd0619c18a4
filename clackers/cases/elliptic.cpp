#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/exact/elliptic/stopped_oscillator.hpp"
#include "clackers/exact/elliptic/two_pendula.hpp"

// Nonlinear oscillators above a stop or against each other: docs/manual/explanation/derivations/elliptic.md.
namespace clackers::cases {
namespace {

double bounce_of(const Case& test_case, const Values& value) {
  const double eta = value("eta");
  if (!(eta > 0.0 && eta <= 1.0))
    refuse(test_case.entry->name, "eta", eta, "0 < eta <= 1",
           eta == 0.0 ? "After a plastic impact it rests on the stop for ever." : "");
  return eta;
}

double angle_of(const Case& test_case, const Values& value, const char* name) {
  const double theta = value(name);
  if (!(theta >= 1e-6 && theta <= 3.14159))
    refuse(test_case.entry->name, name, theta, fmt::format("1e-6 <= {} <= 3.14159", name),
           theta > 3.0 ? "Upside down, at pi, it would stand." : "");
  return theta;
}

// The bound at t_end, among the constants. Refuses what is not known to 1e-6 of its peak, there or at the speed of
// an impact by the instants of impacts.
void add_error_bound(Case& test_case, const model::Motion& motion) {
  const double end = motion.end();
  const auto size = motion.peak(), bound = motion.error_bound(end);
  const auto count = motion.impact_count(end);
  double late = 0.0;
  if (count > 0) {
    const auto when = motion.impact(count).when;
    late = 0.5 * (when.hi - when.lo);
  }
  const double share = (bound.u + late * size.v).cwiseQuotient(size.u).maxCoeff();
  if (!(share <= 1e-6))
    refuse(test_case.entry->name, "t_end", end,
           "up to where displacements are known to 1e-6 of their peaks",
           "End the run earlier, or start it farther from the unstable rest.", "not-admissible");
  test_case.constants.push_back(
      {"error_bound", bound.u.maxCoeff(), "m",
       "largest of the displacements of the reference solution at t_end"});
}

// Of a mass whose motion of that period is slower than small ones, that of these: it moves so near its rest.
void add_period(Case& test_case, double period, double omega) {
  test_case.damped_periods.push_back(std::min(period, 2.0 * std::numbers::pi / omega));
}

template <class Motion>
void use(Case& test_case, std::shared_ptr<const Motion> motion, double linear) {
  test_case.problem = motion->problem();
  const double period = 2.0 * motion->half_period().nearest();
  add_period(test_case, period, linear);
  auto& list = test_case.constants;
  list.insert(list.end(),
              {{"t_1", motion->first().nearest(), "s", "time of the first impact"},
               {"V", motion->speed().nearest(), "m/s", "speed there; V eta^j of impact j + 1"},
               {"T_0", period, "s", "period of the free motion with the amplitude of the start"},
               {"T_0/T_linear", period * linear / (2.0 * std::numbers::pi), "",
                "over that of small motion"}});
  add_error_bound(test_case, *motion);
  test_case.motion = std::move(motion);
  add_run(test_case);
}

void build_pendulum(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::PendulumParameters p{within(test_case, value, "l"), within(test_case, value, "g"),
                                    angle_of(test_case, value, "theta0"),
                                    bounce_of(test_case, value), end_of(test_case, value)};
  const double omega = std::sqrt(p.g / p.l);
  test_case.constants = {
      {"m", 1.0, "kg", "the mass, of no influence"},
      {"omega", omega, "rad/s", "frequency of small motion"},
      {"height", 2.0 * p.l * std::pow(std::sin(0.5 * p.theta0), 2), "m", "at the start"}};
  use(test_case, std::make_shared<const exact::Pendulum>(p, who), omega);
}

void build_duffing(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::DuffingParameters p{
      within(test_case, value, "m"),        within(test_case, value, "k"),
      within(test_case, value, "b", -1e30), within(test_case, value, "u0"),
      bounce_of(test_case, value),          end_of(test_case, value)};
  const double omega = std::sqrt(p.k / p.m);
  test_case.constants = {{"omega", omega, "rad/s", "frequency of small motion"}};
  use(test_case, std::make_shared<const exact::Duffing>(p, who), omega);
}

void use_pendula(Case& test_case, const auto& parameters) {
  const auto motion = std::make_shared<const exact::TwoPendula>(parameters, test_case.entry->name);
  test_case.problem = motion->problem();
  auto& list = test_case.constants;
  for (int i = 0; i < 2; ++i) {
    const auto& swing = motion->swing(i);
    const double T = swing.duration().nearest(), l = swing.l.nearest();
    add_period(test_case, 2.0 * T, swing.w.nearest());
    const auto of = fmt::format(" of pendulum {}", i + 1);
    const auto add = [&](const char* name, double what, const char* unit, const char* meaning) {
      list.push_back({fmt::format("{}{}", name, i + 1), what, unit, meaning + of});
    };
    add("m", motion->problem().system.mass(i, i), "kg", "mass");
    add("l", l, "m", "length");
    add("theta", swing.arc().nearest() / l, "rad", "largest angle");
    add("V", swing.speed().nearest(), "m/s", "speed at the impacts");
    add("T", T, "s", "time away from the contact");
  }
  list.push_back(
      {"t_1", 0.5 * motion->swing(0).duration().nearest(), "s", "time of the first impact"});
  add_error_bound(test_case, *motion);
  test_case.motion = motion;
  add_run(test_case);
}

void build_two_pendula(Case& test_case, const Values& value, double) {
  use_pendula(test_case, exact::TwoPendulaParameters{
                             within(test_case, value, "m1"), within(test_case, value, "m2"),
                             within(test_case, value, "l1"), within(test_case, value, "g"),
                             angle_of(test_case, value, "theta1"), end_of(test_case, value)});
}

void build_pendulum_cradle(Case& test_case, const Values& value, double) {
  use_pendula(test_case, exact::PendulumCradleParameters{
                             within(test_case, value, "l1"), within(test_case, value, "l2"),
                             within(test_case, value, "g"), angle_of(test_case, value, "theta1"),
                             end_of(test_case, value)});
}

}  // namespace

std::vector<CaseRow> elliptic_rows() {
  const auto length = positive("l1", 1.0, "m", "length of pendulum 1"),
             gravity = positive("g", 9.81, "m/s^2", "gravity");
  const Parameter angle{"theta1", 1.0, "rad", "1e-6 <= theta1 <= 3.14159",
                        "initial angle of pendulum 1, at rest"};
  const Parameter eta{"eta", 0.8, "", "0 < eta <= 1", "restitution; 1 is elastic"};
  return {
      {{"pendulum",
        "A pendulum of any amplitude that strikes a stop at its lowest point; u is the arc.",
        "none; u'' = -g sin(u/l), u >= 0",
        {positive("l", 1.0, "m", "length"),
         gravity,
         {"theta0", 2.0, "rad", "1e-6 <= theta0 <= 3.14159", "initial angle, at rest"},
         eta,
         t_end(10.0)}},
       build_pendulum},
      {{"duffing-stop",
        "A mass on a spring with a cubic part above a stop at its equilibrium.",
        "none; m u'' = -k u - b u^3, u >= 0 (G. Duffing, 1918)",
        {positive("m", 1.0, "kg", "mass"),
         positive("k", 1.0, "N/m", "stiffness of small motion"),
         {"b", 2.0, "N/m^3", "-k/u0^2 < b <= 1e+30", "cubic part of the spring"},
         positive("u0", 1.0, "m", "initial displacement, at rest"),
         eta,
         t_end(20.0)}},
       build_duffing},
      {{"two-pendula",
        "Two unlike pendula of any amplitude that meet again and again at their lowest points.",
        "none; (m1/m2) k1/K(k1) < 0.4031, k1 = sin(theta1/2)",
        {positive("m1", 1.3, "kg", "mass of pendulum 1"),
         positive("m2", 1.0, "kg", "mass of pendulum 2, whose length follows"), length, gravity,
         angle, t_end(10.0)}},
       build_two_pendula},
      {{"pendulum-cradle",
        "Two pendula of equal mass, one of which rests while the other swings.",
        "none; Newton's cradle of any amplitude",
        {length, positive("l2", 0.8, "m", "length of pendulum 2"), gravity, angle, t_end(10.0)}},
       build_pendulum_cradle},
  };
}

}  // namespace clackers::cases
