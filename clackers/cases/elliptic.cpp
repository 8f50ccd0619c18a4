#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/exact/elliptic/stopped_oscillator.hpp"

// Nonlinear oscillators above a stop: docs/manual/explanation/derivations/elliptic.md.
namespace clackers::cases {
namespace {

double bounce_of(const Case& test_case, const Values& value) {
  const double eta = value("eta");
  if (!(eta > 0.0 && eta <= 1.0))
    refuse(test_case.entry->name, "eta", eta, "0 < eta <= 1",
           eta == 0.0 ? "After a plastic impact it rests on the stop for ever." : "");
  return eta;
}

void use(Case& test_case, std::shared_ptr<const exact::StoppedOscillator> motion, double linear) {
  test_case.problem = motion->problem();
  const double end = motion->end(), period = 2.0 * motion->half_period().nearest();
  test_case.damped_periods = {period};
  auto& list = test_case.constants;
  list.insert(
      list.end(),
      {{"t_1", motion->first().nearest(), "s", "time of the first impact"},
       {"V", motion->speed().nearest(), "m/s", "speed there; V eta^j of impact j + 1"},
       {"T_0", period, "s", "period of the free motion with the amplitude of the start"},
       {"T_0/T_linear", period * linear / (2.0 * std::numbers::pi), "",
        "over that of small motion"},
       {"error_bound", motion->error_bound(end).u[0], "m",
        "of the displacement of the reference solution at t_end"},
       {"t_end", end, "s", "end of the run"},
       {"impacts", double(motion->impact_count(end)), "", "number of impacts up to t_end"}});
  test_case.motion = std::move(motion);
}

void build_pendulum(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::PendulumParameters p{within(test_case, value, "l"), within(test_case, value, "g"),
                                    value("theta0"), bounce_of(test_case, value),
                                    end_of(test_case, value)};
  if (!(p.theta0 >= 1e-6 && p.theta0 <= 3.14159))
    refuse(who, "theta0", p.theta0, "1e-6 <= theta0 <= 3.14159",
           p.theta0 > 3.0 ? "Upside down, at pi, it would stand." : "");
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

}  // namespace

std::vector<CaseRow> elliptic_rows() {
  const Parameter eta{"eta", 0.8, "", "0 < eta <= 1", "restitution; 1 is elastic"};
  return {
      {{"pendulum",
        "A pendulum of any amplitude that strikes a stop at its lowest point; u is the arc.",
        "none; u'' = -g sin(u/l), u >= 0",
        {positive("l", 1.0, "m", "length"),
         positive("g", 9.81, "m/s^2", "gravity"),
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
  };
}

}  // namespace clackers::cases
