#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/meshes.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/exact/bodies/bar_between_stops.hpp"
#include "clackers/exact/bodies/bar_contact.hpp"
#include "clackers/exact/bodies/mass_on_bar.hpp"

// Elastic bars in contact, and their meshes: docs/manual/explanation/derivations/bars.md.
namespace clackers::cases {
namespace {

using exact::Bar;
using exact::BarContact;
using exact::BarsParameters;

constexpr double largest = 1e30;

// Of a bar whose parameters have this number behind their names.
Bar bar_of(const Case& test_case, const Values& value, const std::string& number, double v0) {
  const auto positive = [&](const char* name) { return within(test_case, value, name + number); };
  return {positive("L"), positive("E"), positive("rho"), positive("A"), v0};
}

void add_wave(std::vector<Quantity>& list, const std::string& number,
              const BarContact::Wave& wave) {
  list.push_back({"c" + number, wave.speed.nearest(), "m/s", "speed of waves"});
  list.push_back(
      {"tau" + number, wave.transit.nearest(), "s", "L/c, a wave's way through the bar"});
  list.push_back({"z" + number, wave.impedance.nearest(), "N s/m", "impedance A sqrt(E rho)"});
  list.push_back({"m" + number, (wave.impedance * wave.transit).nearest(), "kg", "mass"});
}

// Of the first two contacts.
void add_contacts(Case& test_case, const std::vector<BarContact::Event>& events) {
  int count = 0;
  for (const auto& event : events) {
    count += event.closes ? 1 : 0;
    if (count > 2) break;
    add_contact(test_case, std::max(count, 1), event.t, event.closes);
  }
}

// Bars, their mesh, and what all of them have in common.
std::shared_ptr<const BarContact> use_bars(Case& test_case, const Values& value,
                                           const BarsParameters& parameters) {
  const auto bars = std::make_shared<const BarContact>(parameters, test_case.entry->name);
  test_case.bars = bars;
  auto& list = test_case.constants;
  for (std::size_t b = 0; b < parameters.bars.size(); ++b)
    add_wave(list, parameters.bars.size() == 1 ? std::string() : std::to_string(b + 1),
             bars->wave(b));
  list.push_back({"gap", bars->gap().nearest(), "m", "at t = 0"});
  add_contacts(test_case, bars->events());
  use_mesh(test_case, value, {parameters.bars, bars->gap().nearest(), bars->end(), parameters.g});
  return bars;
}

void build_bar_wall(Case& test_case, const Values& value, double) {
  const double V = within(test_case, value, "V");
  const auto bar = bar_of(test_case, value, "", -V);
  BarsParameters p{{bar}, within(test_case, value, "d"), end_of(test_case, value)};
  use_bars(test_case, value, p);
}

void build_bouncing(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  BarsParameters p{{bar_of(test_case, value, "", 0.0)},
                   0.0,
                   end_of(test_case, value),
                   within(test_case, value, "g"),
                   value("N")};
  if (!(p.N > 0.0 && p.N <= 1e3))
    refuse(who, "N", p.N, "0 < N <= 1000", "It is the time of the first fall over L/c.");
  if (p.N == 2.0)
    refuse(who, "N", p.N, "another N than 2",
           "The second contact would begin and the first end without a speed.", "not-admissible");
  const double period = use_bars(test_case, value, p)->period().nearest();
  if (period > 0.0)
    test_case.constants.push_back({"T", period, "s", "period of the bar, 4 (N + 1) L/c"});
}

void build_two_bars(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const double v1 = within(test_case, value, "v1", -largest),
               v2 = within(test_case, value, "v2", -largest);
  if (!(v1 > v2))
    refuse(who, "v1", v1, fmt::format("v1 > v2 = {}", v2), "Otherwise the bars do not meet.");
  const auto first = bar_of(test_case, value, "1", v1), second = bar_of(test_case, value, "2", v2);
  BarsParameters p{{first, second}, within(test_case, value, "d"), end_of(test_case, value)};
  const auto bars = use_bars(test_case, value, p);
  const auto wave1 = bars->wave(0), wave2 = bars->wave(1);
  const auto inverse = numerics::Bounded(1.0) / (wave1.impedance * wave1.transit) +
                       numerics::Bounded(1.0) / (wave2.impedance * wave2.transit);
  const auto events = bars->events();
  if (std::ranges::any_of(events, [](const auto& event) { return !event.closes; }))
    test_case.constants.push_back(
        {"restitution",
         (bars->impulse(p.end, model::Side::right) * inverse).nearest() / (v1 - v2) - 1.0, "",
         "of the centres of mass; the rest of the energy is kept as vibration"});
}

void build_mass_on_bar(Case& test_case, const Values& value, double) {
  const exact::MassOnBarParameters p{
      bar_of(test_case, value, "", 0.0), within(test_case, value, "M"),
      within(test_case, value, "V"),     within(test_case, value, "d"),
      value("far").text() == "fixed",    end_of(test_case, value)};
  const auto motion = std::make_shared<const exact::MassOnBar>(p, test_case.entry->name);
  test_case.bars = motion;
  auto& list = test_case.constants;
  add_wave(list, "", motion->wave());
  add_contacts(test_case, motion->events());
  list.push_back(
      {"v_after", motion->rebound().nearest(), "m/s", "velocity of the mass afterwards"});
  use_mesh(test_case, value, {{p.bar}, p.gap, p.end, 0.0, p.M, p.V, p.is_fixed});
}

void build_between_stops(Case& test_case, const Values& value, double) {
  const exact::BarBetweenStopsParameters p{
      bar_of(test_case, value, "", 0.0), within(test_case, value, "V"),
      within(test_case, value, "d"), within(test_case, value, "D"), end_of(test_case, value)};
  const auto& who = test_case.entry->name;
  if (!(p.D >= p.d))
    refuse(who, "D", p.D, fmt::format("D >= d = {}", p.d),
           "It holds both gaps, that at t = 0 too.");
  const auto motion = std::make_shared<const exact::BarBetweenStops>(p);
  test_case.bars = motion;
  auto& list = test_case.constants;
  add_wave(list, "", motion->wave());
  add_contact(test_case, 1, motion->begins(), true);
  add_contact(test_case, 1, motion->ends(), false);
  list.push_back({"T", motion->period().nearest(), "s", "period of the bar, 2 D/V + 4 L/c"});
  auto bar = p.bar;
  bar.v0 = -p.V;
  use_mesh(test_case, value, {.bars = {bar}, .gap = p.d, .end = p.end, .clearance = p.D});
}

// What a bar has, then what the case has, then what its mesh has.
std::vector<Parameter> parameters(const std::vector<std::string>& numbers,
                                  std::vector<Parameter> own, double end) {
  std::vector<Parameter> list;
  for (const auto& number : numbers)
    for (auto& p : {positive("L" + number, number == "2" ? 2.0 : 1.0, "m", "length"),
                    positive("E" + number, 1.0, "N/m^2", "Young's modulus"),
                    positive("rho" + number, 1.0, "kg/m^3", "density"),
                    positive("A" + number, 1.0, "m^2", "area")})
      list.push_back(p);
  for (auto& p : own) list.push_back(std::move(p));
  for (auto& p : mesh_parameters(false, end, numbers.size())) list.push_back(std::move(p));
  return list;
}

}  // namespace

std::vector<CaseRow> bar_rows() {
  return {
      {{"bar-wall", "An elastic bar that flies against a rigid wall, and its mesh.",
        "none; Saint-Venant (1867)",
        parameters({""},
                   {positive("V", 1.0, "m/s", "speed towards the wall"),
                    positive("d", 0.25, "m", "gap at t = 0")},
                   4.0)},
       build_bar_wall},
      {{"bar-between-stops",
        "An elastic bar that flies to and fro between two rigid stops, and its mesh.",
        "none; Saint-Venant (1867)",
        parameters({""},
                   {positive("V", 1.0, "m/s", "speed"),
                    positive("d", 0.25, "m", "gap at t = 0 to the left stop"),
                    positive("D", 0.75, "m", "both gaps together, D >= d")},
                   8.0)},
       build_between_stops},
      {{"bouncing-bar",
        "An elastic bar that falls on a floor again and again, and its mesh; periodic for whole N >= 3.",
        "none; D. Doyen, A. Ern, S. Piperno (2011)",
        parameters({""},
                   {{"N", 3.0, "", "0 < N <= 1000, not 2",
                     "time of the first fall over L/c; the height is g (N L/c)^2/2"},
                    positive("g", 0.125, "m/s^2", "gravity")},
                   16.0)},
       build_bouncing},
      {{"two-bars", "Two elastic bars that meet, and their meshes.", "none; Saint-Venant (1867)",
        parameters(
            {"1", "2"},
            {{"v1", 1.0, "m/s", "-1e+30 <= v1 <= 1e+30, v1 > v2", "velocity of the left bar"},
             {"v2", 0.0, "m/s", "-1e+30 <= v2 <= 1e+30", "velocity of the right bar"},
             positive("d", 0.25, "m", "gap at t = 0")},
            6.0)},
       build_two_bars},
      {{"mass-on-bar",
        "A rigid mass that flies against the end of an elastic bar at rest, and its mesh.",
        "none; A. Barre de Saint-Venant, A. Flamant (1883)",
        parameters({""},
                   {positive("M", 2.0, "kg", "the mass, 0.01 to 100 times that of the bar"),
                    positive("V", 1.0, "m/s", "its speed towards the bar"),
                    positive("d", 0.25, "m", "gap at t = 0"),
                    {"far",
                     "fixed",
                     "",
                     "fixed or free",
                     "far end of the bar",
                     {},
                     {{"fixed", "does not move"}, {"free", "moves freely"}}}},
                   8.0)},
       build_mass_on_bar},
  };
}

}  // namespace clackers::cases
