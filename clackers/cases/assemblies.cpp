#include "clackers/cases/row.hpp"

#include <cmath>
#include <numbers>

#include "clackers/exact/assembly/assemblies.hpp"
#include "clackers/exact/assembly/assembly.hpp"
#include "clackers/exact/assembly/building_shape.hpp"

namespace clackers::cases {
namespace {

using exact::ShapedMotion;

// What every synchronized motion has, after its own constants.
void add_common_constants(Case& test_case, const ShapedMotion& motion, double sigma, double eta) {
  const auto& c = motion.flight();
  for (const Quantity& constant : std::initializer_list<Quantity>{
           {"sigma", sigma, "1/s", "common rate of decay"},
           {"eta", eta, "", "restitution"},
           {"T", c.period.hi, "s", "time between impacts"},
           {"t_1", c.first_impact * c.period.hi, "s", "time of the first impact"},
           {"contacts_at_once", double(motion.pattern().contacts.front().size()), "",
            "contacts that close at each impact"},
           {"t_end", motion.end(), "s", "end of the run"},
           {"impacts", double(motion.impact_count(motion.end())), "",
            "number of impacts up to t_end, one a contact"}})
    test_case.constants.push_back(constant);
}

void add_periods(Case& test_case, double omega, int count, double step = 2.0) {
  for (int i = 0; i < count; ++i)
    test_case.damped_periods.push_back(2.0 * std::numbers::pi / (omega * (1.0 + step * i)));
}

void build_buildings(Case& test_case, const Values& value, double) {
  const exact::BuildingsParameters p{value("left"), value("right"), value("X"),     value("r"),
                                     value("m1"),   value("Omega"), value("sigma"), value("V"),
                                     value("eta"),  value("t_end")};
  const std::shared_ptr motion = exact::make_buildings(p, test_case.entry->name);
  test_case.problem = exact::buildings_problem(p, *motion);
  const auto left = static_cast<int>(p.left), right = static_cast<int>(p.right);
  const double limit = exact::buildings_limit(left, right, p.X).r_star;
  test_case.constants = {
      {"m1", p.m1, "kg", "mass of the left roof"},
      {"m_roof_right", p.m1 / p.r, "kg", "mass of the right roof"},
      {"Omega", p.Omega, "rad/s", "lowest damped frequency of the left building"},
      {"omega_left", p.Omega * (2.0 * p.left - 1.0), "rad/s", "its highest damped frequency"},
      {"omega_right", p.Omega * p.X * (2.0 * p.right - 1.0), "rad/s",
       "highest damped frequency of the right building"},
      {"X", p.X, "", "frequencies of the right building over those of the left one"},
      {"r", p.r, "", "left over right roof mass"},
      {"r*", limit, "", "limit of r, where the roofs would graze between impacts"},
      {"margin", 1.0 - p.r / limit, "", "1 - r/r*; 0 grazes"},
      {"V", p.V, "m/s", "speed of the left roof at t = 0, just after an impact"}};
  add_periods(test_case, p.Omega, left);
  add_periods(test_case, p.Omega * p.X, right);
  add_common_constants(test_case, *motion, p.sigma, p.eta);
  test_case.motion = motion;
}

void build_row(Case& test_case, const Values& value, double) {
  const exact::RowParameters p{value("masses"), value("fast"), value("X"),
                               value("speed"),  value("m1"),   value("Omega"),
                               value("sigma"),  value("eta"),  value("t_end")};
  const std::shared_ptr motion = exact::make_row(p, test_case.entry->name);
  test_case.problem = exact::row_problem(p, *motion);
  const auto row = exact::row_masses(p);
  test_case.constants = {{"m1", p.m1, "kg", "mass of those that move up after an impact"},
                         {"m_last", row.back().mass, "kg", "mass of those that move down"},
                         {"Omega", p.Omega, "rad/s", "damped frequency of the slow masses"}};
  if (p.fast != 0.0) {
    const double limit = exact::row_limit(p);
    test_case.constants.insert(
        test_case.constants.end(),
        {{"X", p.X, "", "frequency of the fast mass over that of the others"},
         {"speed_limit", limit, "", "limit of speed, where the fast mass would graze a neighbour"},
         {"margin", 1.0 - p.speed / limit, "", "1 - speed/speed_limit; 0 grazes"}});
  }
  for (const auto& mass : row)
    test_case.damped_periods.push_back(2.0 * std::numbers::pi / (p.Omega * mass.multiple));
  add_common_constants(test_case, *motion, p.sigma, p.eta);
  test_case.motion = motion;
}

void build_alternating(Case& test_case, const Values& value, double) {
  const exact::AlternatingParameters p{value("rh"), value("r"), value("Omega"), value("sigma"),
                                       value("t_end")};
  const std::shared_ptr motion = exact::make_alternating(p, test_case.entry->name);
  test_case.problem = exact::alternating_problem(p, *motion);
  const double limit = exact::alternating_limit(p.rh), middle = 2.0 * p.rh;
  test_case.constants = {
      {"m_outer", 1.0, "kg", "mass of the upper and the lower one"},
      {"m_middle", 1.0 / p.r, "kg", "mass of the middle one"},
      {"Omega", p.Omega, "rad/s", "damped frequency of the outer masses"},
      {"omega_middle", middle * p.Omega, "rad/s", "damped frequency of the middle mass"},
      {"amplitude", p.r / middle, "m", "displacement amplitude of the middle mass; outer: 1 m"},
      {"r*", limit, "", "limit of r, where the middle mass would graze a partner between impacts"},
      {"margin", 1.0 - p.r / limit, "", "1 - r/r*; 0 grazes"}};
  for (const double multiple : {1.0, middle, 1.0})
    test_case.damped_periods.push_back(2.0 * std::numbers::pi / (p.Omega * multiple));
  add_common_constants(test_case, *motion, p.sigma, 1.0);
  test_case.motion = motion;
}

void build_assembly(Case& test_case, const Values& value, double) {
  const double X = ratio(test_case, value("N"));
  const auto coupling = value("coupling").text();
  const exact::AssemblyParameters p{value("pairs"),
                                    coupling == "chain"   ? exact::Coupling::chain
                                    : coupling == "block" ? exact::Coupling::block
                                                          : exact::Coupling::dense,
                                    value("seed"),
                                    X,
                                    value("xi1"),
                                    value("eta"),
                                    value("t_end")};
  exact::require_assembly_fits(test_case.entry->name, p.pairs);
  const std::shared_ptr motion = exact::make_assembly(p, test_case.entry->name);
  test_case.problem = exact::assembly_problem(p, *motion, test_case.entry->name);
  const double omega = std::sqrt((1.0 - p.xi1) * (1.0 + p.xi1));
  test_case.constants = {
      {"omega_D1", omega, "rad/s", "damped frequency of the slow mass of each pair"},
      {"omega_D2", X * omega, "rad/s", "of the fast one"},
      {"X", X, "", "frequency ratio 4N + 1"}};
  for (double pair = 0.0; pair < p.pairs; ++pair) add_periods(test_case, omega, 2, X - 1.0);
  add_common_constants(test_case, *motion, p.xi1, p.eta);
  test_case.motion = motion;
}

Parameter omega(const char* meaning) {
  return {"Omega", 1.0, "rad/s", "1e-60 <= Omega <= 1e+60", meaning};
}
Parameter sigma() {
  return {"sigma", 0.05, "1/s", "0 or 1e-60 <= sigma <= 1e+60", "common rate of decay"};
}

}  // namespace

std::vector<CaseRow> assembly_rows() {
  return {
      {{"buildings",
        "Two shear buildings whose roofs pound, from the first impulse on.",
        "beyond the paper: assemblies in the manual",
        {{"left", 3.0, "", "a whole number, 1 <= left <= 500", "storeys of the left building"},
         {"right", 2.0, "", "a whole number, 1 <= right <= 500", "storeys of the right building"},
         {"X", 1.0, "", "an odd whole number from 1 to 1e+09",
          "frequencies of the right building over those of the left one"},
         {"r", 1.0, "", "0 < r < r*, and 1e-60 <= r <= 1e+60; any for X = 1",
          "mass of the left roof over that of the right one"},
         scale("m1", 1.0, "kg", "1e-60 <= m1 <= 1e+60", "mass of the left roof"),
         omega("lowest damped frequency of the left building"),
         sigma(),
         scale("V", 1.0, "m/s", "1e-60 <= V <= 1e+60",
               "speed of the left roof after the first impulse, at t = 0"),
         eta(),
         t_end()}},
       build_buildings},
      {{"row",
        "Masses in a row, all contacts at once, one of them fast.",
        "beyond the paper: assemblies in the manual",
        {{"masses", 5.0, "", "a whole number, 2 or more, as many as fit into 1 GB",
          "how many there are"},
         {"fast", 3.0, "", "a whole number, 0 <= fast <= masses",
          "number of the fast mass, from above; 0 for none"},
         {"X", 3.0, "", "an odd whole number from 1 to 1e+09",
          "its frequency over that of the others; without effect for fast = 0"},
         {"speed", 0.5, "", "0 < speed < 1, or r*(X) for the first and the last mass",
          "of the fast mass after an impact, over that of its slow neighbours, which is 1 m/s"},
         scale("m1", 1.0, "kg", "1e-60 <= m1 <= 1e+60",
               "mass of those that move up after an impact"),
         omega("damped frequency of the slow masses"),
         sigma(),
         eta(),
         t_end()}},
       build_row},
      {{"alternating",
        "Three masses, elastic: the middle one meets its neighbours in turn.",
        "beyond the paper: assemblies in the manual",
        {{"rh", 2.0, "", "an even whole number, 2 <= rh <= 500000000",
          "half-periods of the middle mass between two impacts"},
         {"r", 1.0, "", "1e-60 <= r < r*(2 rh)", "mass of an outer mass over the middle one"},
         {"Omega", 1.0, "rad/s", "1e-60 <= Omega <= 5e+59",
          "damped frequency of the outer masses; 2 rh times it is that of the middle one"},
         sigma(),
         t_end()}},
       build_alternating},
      {{"assembly",
        "Pairs transformed by an invertible matrix: coupled masses, simultaneous contacts.",
        "beyond the paper: assemblies in the manual",
        {{"pairs", 4.0, "", "a whole number, 1 or more, as many as fit into 1 GB",
          "number of pairs; twice as many masses"},
         {"coupling",
          "chain",
          "",
          "chain, block or dense",
          "which entries of the matrix are not zero",
          {},
          {{"chain", "each coordinate with the one before it: tridiagonal"},
           {"block", "two pairs with each other"},
           {"dense", "all with all"}}},
         {"seed", 1.0, "", "a whole number, 0 <= seed <= 2^53",
          "makes masses, amplitudes and the matrix"},
         whole_N(),
         xi1(),
         eta(),
         t_end()}},
       build_assembly},
  };
}

}  // namespace clackers::cases
