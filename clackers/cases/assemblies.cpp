#include "clackers/cases/assemblies.hpp"

#include <cmath>
#include <numbers>

#include "clackers/exact/assembly/alternating.hpp"
#include "clackers/exact/assembly/assembly.hpp"
#include "clackers/exact/assembly/building_shape.hpp"
#include "clackers/exact/assembly/buildings.hpp"
#include "clackers/exact/assembly/row.hpp"

namespace clackers::cases {
namespace {

using exact::ShapedMotion;

double value(const Case& which, std::string_view name) { return value_of(which.values, name); }

// What every synchronized motion has, after its own constants.
void add_common_constants(Case& which, const ShapedMotion& motion, double sigma, double eta) {
  const auto& c = motion.flight();
  for (const Constant& constant : std::initializer_list<Constant>{
           {"sigma", sigma, "1/s", "common rate of decay"},
           {"eta", eta, "", "restitution"},
           {"T", c.period.hi, "s", "time between impacts"},
           {"t_1", c.first_collision * c.period.hi, "s", "time of the first impact"},
           {"contacts_at_once", double(motion.pattern().contacts.front().size()), "",
            "contacts that close at each impact"},
           {"t_end", motion.end(), "s", "end of the run"},
           {"collisions", double(motion.impact_count(motion.end())), "",
            "number of collisions up to t_end, one a contact"}})
    which.constants.push_back(constant);
}

void add_periods(Case& which, double omega, int count, double step = 2.0) {
  for (int i = 0; i < count; ++i)
    which.damped_periods.push_back(2.0 * std::numbers::pi / (omega * (1.0 + step * i)));
}

}  // namespace

void build_buildings(Case& which) {
  const exact::BuildingsParameters p{
      value(which, "left"), value(which, "right"), value(which, "X"),     value(which, "r"),
      value(which, "m1"),   value(which, "Omega"), value(which, "sigma"), value(which, "V"),
      value(which, "eta"),  value(which, "t_end")};
  const std::shared_ptr motion = exact::make_buildings(p, which.entry->name);
  which.problem = exact::buildings_problem(p, *motion);
  const auto left = static_cast<int>(p.left), right = static_cast<int>(p.right);
  const double limit = exact::buildings_limit(left, right, p.X).r_star;
  which.constants = {
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
  add_periods(which, p.Omega, left);
  add_periods(which, p.Omega * p.X, right);
  add_common_constants(which, *motion, p.sigma, p.eta);
  which.motion = motion;
}

void build_row(Case& which) {
  const exact::RowParameters p{value(which, "masses"), value(which, "fast"), value(which, "X"),
                               value(which, "speed"),  value(which, "m1"),   value(which, "Omega"),
                               value(which, "sigma"),  value(which, "eta"),  value(which, "t_end")};
  const std::shared_ptr motion = exact::make_row(p, which.entry->name);
  which.problem = exact::row_problem(p, *motion);
  const auto row = exact::row_masses(p);
  which.constants = {{"m1", p.m1, "kg", "mass of those that move up after an impact"},
                     {"m_last", row.back().mass, "kg", "mass of those that move down"},
                     {"Omega", p.Omega, "rad/s", "damped frequency of the slow masses"}};
  if (p.fast != 0.0) {
    const double limit = exact::row_limit(p);
    which.constants.insert(
        which.constants.end(),
        {{"X", p.X, "", "frequency of the fast mass over that of the others"},
         {"speed_limit", limit, "", "limit of speed, where the fast mass would graze a neighbour"},
         {"margin", 1.0 - p.speed / limit, "", "1 - speed/speed_limit; 0 grazes"}});
  }
  for (const auto& mass : row)
    which.damped_periods.push_back(2.0 * std::numbers::pi / (p.Omega * mass.multiple));
  add_common_constants(which, *motion, p.sigma, p.eta);
  which.motion = motion;
}

void build_alternating(Case& which) {
  const exact::AlternatingParameters p{value(which, "rh"), value(which, "r"), value(which, "Omega"),
                                       value(which, "sigma"), value(which, "t_end")};
  const std::shared_ptr motion = exact::make_alternating(p, which.entry->name);
  which.problem = exact::alternating_problem(p, *motion);
  const double limit = exact::alternating_limit(p.rh), middle = 2.0 * p.rh;
  which.constants = {
      {"m_outer", 1.0, "kg", "mass of the upper and the lower one"},
      {"m_middle", 1.0 / p.r, "kg", "mass of the middle one"},
      {"Omega", p.Omega, "rad/s", "damped frequency of the outer masses"},
      {"omega_middle", middle * p.Omega, "rad/s", "damped frequency of the middle mass"},
      {"amplitude", p.r / middle, "m", "displacement amplitude of the middle mass; outer: 1 m"},
      {"r*", limit, "", "limit of r, where the middle mass would graze a partner between impacts"},
      {"margin", 1.0 - p.r / limit, "", "1 - r/r*; 0 grazes"}};
  for (const double multiple : {1.0, middle, 1.0})
    which.damped_periods.push_back(2.0 * std::numbers::pi / (p.Omega * multiple));
  add_common_constants(which, *motion, p.sigma, 1.0);
  which.motion = motion;
}

void build_assembly(Case& which, double X) {
  const auto coupling = value_of(which.values, "coupling").text();
  const exact::AssemblyParameters p{value(which, "pairs"),
                                    coupling == "chain"   ? exact::Coupling::chain
                                    : coupling == "block" ? exact::Coupling::block
                                                          : exact::Coupling::dense,
                                    value(which, "seed"),
                                    X,
                                    value(which, "xi1"),
                                    value(which, "eta"),
                                    value(which, "t_end")};
  exact::require_assembly_fits(which.entry->name, p.pairs);
  const std::shared_ptr motion = exact::make_assembly(p, which.entry->name);
  which.problem = exact::assembly_problem(p, *motion, which.entry->name);
  const double omega = std::sqrt((1.0 - p.xi1) * (1.0 + p.xi1));
  which.constants = {{"omega_D1", omega, "rad/s", "damped frequency of the slow mass of each pair"},
                     {"omega_D2", X * omega, "rad/s", "of the fast one"},
                     {"X", X, "", "frequency ratio 4N + 1"}};
  for (double pair = 0.0; pair < p.pairs; ++pair) add_periods(which, omega, 2, X - 1.0);
  add_common_constants(which, *motion, p.xi1, p.eta);
  which.motion = motion;
}

}  // namespace clackers::cases
