#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/orbit/cradle.hpp"
#include "clackers/exact/orbit/forced_pair.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/problem_file.hpp"

namespace clackers::cases {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

void build_cradle(Case& test_case, const Values& value, double) {
  const exact::CradleParameters p{value("omega1"), value("omega2"), value("xi1"), value("xi2"),
                                  value("t_end")};
  const auto motion = std::make_shared<const exact::Cradle>(p, test_case.entry->name);
  test_case.problem = motion->problem();
  test_case.motion = motion;
  const double T1 = motion->flight_time(0), T2 = motion->flight_time(1);
  const double growth = motion->perturbation_growth();
  test_case.damped_periods = {2.0 * T1, 2.0 * T2};
  const auto& s = test_case.problem.system;
  test_case.constants = {
      {"m1", 1.0, "kg", "mass 1, above"},
      {"m2", 1.0, "kg", "mass 2, below"},
      {"k1", s.stiffness(0, 0), "N/m", "stiffness of mass 1"},
      {"k2", s.stiffness(1, 1), "N/m", "stiffness of mass 2"},
      {"c1", s.damping(0, 0), "N s/m", "damping of mass 1"},
      {"c2", s.damping(1, 1), "N s/m", "damping of mass 2"},
      {"eta", 1.0, "", "restitution"},
      {"T1", T1, "s", "length of a flight of mass 1, while mass 2 rests"},
      {"T2", T2, "s", "length of a flight of mass 2, while mass 1 rests"},
      {"t_1", motion->impact_count(p.t_end) > 0 ? motion->impact(1).t : 0.5 * T1, "s",
       "time of the first impact"},
      {"perturbation_growth", growth, "",
       growth > 1.0
           ? "conditioning: growing; an error of the resting mass, relative to the motion, is "
             "multiplied by this at each impact in the long run"
           : "conditioning: neutral; an error at one impact, relative to the motion, does not "
             "grow in the long run"}};
  add_run(test_case);
}

// What a forced and a base-excited pair have in common.
void use_orbit(Case& test_case, std::shared_ptr<const exact::ForcedPair> orbit, double omega1,
               double omega2) {
  test_case.problem = orbit->problem();
  test_case.motion = orbit;
  test_case.damped_periods = {two_pi / omega1, two_pi / omega2};
  const auto& s = test_case.problem.system;
  auto& list = test_case.constants;
  for (int i = 0; i < 2; ++i) {
    list.push_back({fmt::format("m{}", i + 1), s.mass(i, i), "kg",
                    i == 0 ? "mass 1, above" : "mass 2, below"});
    list.push_back({fmt::format("k{}", i + 1), s.stiffness(i, i), "N/m",
                    fmt::format("stiffness of mass {}", i + 1)});
    list.push_back({fmt::format("c{}", i + 1), s.damping(i, i), "N s/m",
                    fmt::format("damping of mass {}", i + 1)});
  }
  list.push_back({"nu", orbit->nu(), "rad/s", "frequency of the forces"});
  for (const auto& f : s.add_load.target<model::HarmonicLoad>()->forces()) {
    list.push_back({fmt::format("F{}", f.dof + 1), f.amplitude, "N",
                    fmt::format("amplitude of the force F{0} cos(nu t + phi{0})", f.dof + 1)});
    list.push_back({fmt::format("phi{}", f.dof + 1), f.phase, "rad", "its phase"});
  }
  list.push_back({"gap", test_case.problem.contacts[0].gap, "m",
                  "contact happens at u1 - u2 = gap; below 0 the masses are apart at rest"});
  list.push_back({"V1", orbit->velocity(0), "m/s", "of mass 1 just after an impact"});
  list.push_back({"V2", orbit->velocity(1), "m/s", "of mass 2 just after an impact"});
  list.push_back(
      {"margin", orbit->margin(), "",
       "smallest gap between impacts over the parabola (V1 - V2) s (T - s)/T; the closed "
       "form holds where it is positive"});
  list.push_back({"T", orbit->T(), "s", "time between impacts"});
  list.push_back({"t_1", 0.5 * orbit->T(), "s", "time of the first impact"});
  const auto multipliers = orbit->floquet_multipliers();
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    list.push_back(
        {fmt::format("floquet_{}", i + 1), std::abs(multipliers[i]), "",
         fmt::format("modulus of the Floquet multiplier {:.6g} {} {:.6g} i", multipliers[i].real(),
                     multipliers[i].imag() < 0.0 ? '-' : '+', std::abs(multipliers[i].imag()))});
  const double growth = std::abs(multipliers[0]);
  constexpr double on_the_circle = 1e-9;
  list.push_back(
      {"perturbation_growth", growth, "",
       growth > 1.0 + on_the_circle
           ? "conditioning: unstable orbit; an error at one impact is multiplied by this at each "
             "later one, so every solver leaves the orbit in the end"
       : growth > 1.0 - on_the_circle
           ? "conditioning: neutral; an error at one impact is as large at the next"
           : "conditioning: stable orbit; an error at one impact is multiplied by this at each "
             "later one"});
  add_run(test_case);
}

void build_forced(Case& test_case, const Values& value, double) {
  const exact::ForcedPairParameters p{
      value("m1"),     value("m2"),  value("omega1"), value("omega2"), value("sigma1"),
      value("sigma2"), value("eta"), value("T"),      value("n"),      value("D1"),
      value("D2"),     value("V1"),  value("t_end")};
  use_orbit(test_case, std::make_shared<const exact::ForcedPair>(p, test_case.entry->name),
            p.omega1, p.omega2);
}

void build_base_excited(Case& test_case, const Values& value, double) {
  const exact::BaseExcitedParameters p{value("m1"), value("omega1"), value("omega2"), value("T"),
                                       value("n"),  value("A_g"),    value("t_end")};
  use_orbit(test_case, std::make_shared<const exact::ForcedPair>(p, test_case.entry->name),
            p.omega1, p.omega2);
}

void build_penalized(Case& test_case, const Values& value, double) {
  const double stiffness = require_positive(test_case.entry->name, "stiffness", value("stiffness"));
  const exact::SynchronizedPair rigid({.m1 = value("m1"),
                                       .k1 = value("k1"),
                                       .xi1 = value("xi1"),
                                       .X = value("X"),
                                       .r = value("r"),
                                       .t_end = value("t_end")},
                                      test_case.entry->name);
  test_case.problem = exact::with_springs(rigid.problem(), stiffness);
  const auto motion =
      std::make_shared<const exact::PiecewiseMotion>(test_case.problem, test_case.entry->name);
  test_case.motion = motion;

  const auto& c = rigid.constants();
  const double inverse_mass = 1.0 / c.m1 + 1.0 / c.m2;
  // The closed contact adds its stiffness to both masses; for X = 1 this is exact.
  const double square = c.omega_D1 * c.omega_D1 + stiffness * inverse_mass;
  const auto& contacts = motion->spring_contacts();
  test_case.damped_periods = {two_pi / c.omega_D1,
                              two_pi / std::max(c.omega_D2, std::sqrt(square))};
  test_case.constants = {
      {"m1", c.m1, "kg", "mass 1, above"},
      {"m2", c.m2, "kg", "mass 2, below"},
      {"k1", c.k1, "N/m", "stiffness of mass 1"},
      {"k2", c.k2, "N/m", "stiffness of mass 2"},
      {"c1", c.c1, "N s/m", "damping of mass 1"},
      {"c2", c.c2, "N s/m", "damping of mass 2"},
      {"omega_D1", c.omega_D1, "rad/s", "damped frequency of mass 1 alone"},
      {"omega_D2", c.omega_D2, "rad/s", "damped frequency of mass 2 alone"},
      {"u1(0)", c.u1, "m", "initial displacement of mass 1"},
      {"u2(0)", c.u2, "m", "initial displacement of mass 2"},
      {"stiffness", stiffness, "N/m", "of the spring that acts where u1 < u2"},
      {"contact_time", std::numbers::pi / std::sqrt(square), "s",
       "half a period of the masses in contact; of X = 1 the length of each contact"},
      {"contacts", double(contacts.size()), "", "number of contacts begun up to t_end"}};
  if (!contacts.empty())
    test_case.constants.push_back(
        {"t_1", contacts.front(), "s", "time at which the first contact begins"});
  test_case.constants.push_back(
      {"smoothness", 2.0, "",
       "the force has kinks where contacts begin and end, so no method has more than this order"});
  add_run(test_case);
}

void build_piecewise(Case& test_case, const Values& value, double) {
  const auto file = value("problem").text();
  test_case.problem = file == "example" ? model::problem_from_text(model::example_problem, file)
                                        : model::read_problem(file);
  const auto motion =
      std::make_shared<const exact::PiecewiseMotion>(test_case.problem, test_case.entry->name);
  test_case.motion = motion;
  std::vector<double> frequencies;
  for (const auto& mode : motion->modes().modes()) {
    frequencies.push_back(mode.omega);
    // A mode that does not oscillate has no period; the run's length is what it has.
    test_case.damped_periods.push_back(mode.oscillates() && mode.w > 0.0 ? two_pi / mode.w
                                                                         : test_case.problem.end);
  }
  const auto [lowest, highest] = std::ranges::minmax(frequencies);
  const auto bound = motion->error_bound(motion->end());
  test_case.constants = {
      {"masses", double(motion->dof()), "", "degrees of freedom"},
      {"contacts", double(test_case.problem.contacts.size()), "", "rows of the contact condition"},
      {"omega_min", lowest, "rad/s", "lowest undamped natural frequency without contact"},
      {"omega_max", highest, "rad/s", "highest undamped natural frequency without contact"},
      {"error_bound", bound.u.maxCoeff(), "m",
       "of the largest displacement of the reference solution at t_end"}};
  if (const auto* springs = model::one_sided_springs(test_case.problem))
    test_case.constants.insert(
        test_case.constants.begin() + 2,
        {{"springs", double(springs->contacts().size()), "", "contacts with a stiffness"},
         {"spring_contacts", double(motion->spring_contacts().size()), "",
          "number of times that one of them closes up to t_end"}});
  if (motion->impact_count(motion->end()) > 0)
    test_case.constants.push_back({"t_1", motion->impact(1).t, "s", "time of the first impact"});
  add_run(test_case);
}

Parameter frequency(const char* name, double standard, const char* meaning) {
  return {name, standard, "rad/s", fmt::format("1e-30 <= {} <= 1e+30", name), meaning};
}
Parameter whole_periods(double standard, const char* meaning) {
  return {"n", standard, "", "a whole number, 1 <= n <= 1e6", meaning};
}

}  // namespace

std::vector<CaseRow> orbit_rows() {
  return {
      {{"cradle",
        "Two equal masses of different frequencies, one at rest at each elastic impact.",
        "none; as Newton's cradle",
        {frequency("omega1", 1.0, "undamped frequency of mass 1, above"),
         frequency("omega2", 1.7, "undamped frequency of mass 2"),
         {"xi1", 0.05, "", "0 <= xi1 < 1", "damping ratio of mass 1"},
         {"xi2", 0.05, "", "0 <= xi2 < 1", "damping ratio of mass 2"},
         t_end()}},
       build_cradle},
      {{"forced-pair",
        "A periodic orbit with impacts of two masses across a gap, under harmonic forces.",
        "none; impacts at (k - 1/2) T",
        {{"m1", 1.0, "kg", "1e-30 <= m1 <= 1e+30", "mass 1, above"},
         {"m2", 1.0, "kg", "1e-30 <= m2 <= 1e+30", "mass 2"},
         frequency("omega1", 1.0, "damped frequency of mass 1"),
         frequency("omega2", 3.0, "damped frequency of mass 2"),
         {"sigma1", 0.05, "1/s", "0 <= sigma1 <= 1e+30", "rate of decay of mass 1"},
         {"sigma2", 0.05, "1/s", "0 <= sigma2 <= 1e+30", "rate of decay of mass 2"},
         {"eta", 0.8, "", "1e-3 <= eta <= 1", "restitution; 1 is elastic"},
         {"T", 5.0, "s", "1e-30 <= T <= 1e+30", "time between impacts"},
         whole_periods(2.0, "periods of the forces between impacts"),
         {"D1", -0.25, "m", "-1e+30 <= D1 <= 1e+30", "displacement of mass 1 at the contact"},
         {"D2", 0.25, "m", "-1e+30 <= D2 <= 1e+30", "displacement of mass 2 at the contact"},
         {"V1", 0.5, "m/s", "1e-30 <= V1 <= 1e+30", "velocity of mass 1 just after an impact"},
         {"t_end", 40.0, "s", "0 < t_end < infinity", "end of the run"}}},
       build_forced},
      {{"base-excited-pair",
        "A periodic orbit with elastic impacts of two undamped masses on a shaken base.",
        "none; impacts at (k - 1/2) T",
        {{"m1", 1.0, "kg", "1e-30 <= m1 <= 1e+30", "mass 1, above; m2 follows"},
         frequency("omega1", 1.0, "frequency of mass 1"),
         frequency("omega2", 3.5, "frequency of mass 2"),
         {"T", 2.5, "s", "1e-30 <= T <= 1e+30", "time between impacts"},
         whole_periods(1.0, "periods of the base between impacts"),
         {"A_g", -1.0, "m/s^2", "1e-30 <= |A_g| <= 1e+30",
          "acceleration of the base at an impact, its amplitude"},
         t_end()}},
       build_base_excited},
      {{"penalized-pair",
        "A pair whose contact is a one-sided spring: what a linear penalty method should compute.",
        "the pair of Eq. (9)-(17), with a spring for its contact",
        {{"m1", 1.0, "kg", "1e-60 <= m1 <= 1e+60", "mass 1, above"},
         {"k1", 1.0, "N/m", "1e-60 <= k1 <= 1e+60", "stiffness of mass 1"},
         {"xi1", 0.05, "", "0 or 1e-60 <= xi1 < 1", "damping ratio of mass 1"},
         {"X", 1.0, "", "an odd whole number from 1 to 1e+09, or 1 over one",
          "frequency ratio omega_D2/omega_D1"},
         {"r", 1.0, "", "0 < r < r*(X)", "mass ratio m1/m2"},
         {"stiffness", 400.0, "N/m", "0 < stiffness < infinity", "of the contact spring"},
         t_end()}},
       build_penalized},
      {{"piecewise",
        "Any linear system with contacts from a file, solved flight by flight with an error bound.",
        "none; --problem FILE.toml",
        {{"problem",
          "example",
          "",
          "a TOML file, or example",
          "M, C, K, contacts, start and loads",
          {},
          {{"example", "a frame of two storeys that strikes a tower"},
           {"FILE", "any other text: the name of a TOML file"}}}}},
       build_piecewise},
  };
}

}  // namespace clackers::cases
