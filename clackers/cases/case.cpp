#include "clackers/cases/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/cases/rows.hpp"
#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/pair/parameters.hpp"

namespace clackers::cases {

Parameter eta() { return {"eta", 1.0, "", "0 <= eta <= 1", "restitution; 1 is elastic"}; }
Parameter t_end(double standard) {
  return {"t_end", standard, "s", "0 < t_end < infinity", "end of the run"};
}
Parameter positive(std::string name, double standard, const char* unit, const char* meaning) {
  auto allowed = fmt::format("1e-30 <= {} <= 1e+30", name);
  return {std::move(name), standard, unit, std::move(allowed), meaning};
}

double within(const Case& test_case, const Values& value, const std::string& name, double least) {
  return require_within(test_case.entry->name, name, value(name), least, 1e30);
}
double end_of(const Case& test_case, const Values& value) {
  return require_positive(test_case.entry->name, "t_end", value("t_end"));
}

void add_run(Case& test_case) {
  const double end = test_case.motion->end();
  test_case.constants.push_back({"t_end", end, "s", "end of the run"});
  test_case.constants.push_back({"impacts", double(test_case.motion->impact_count(end)), "",
                                 "number of impacts up to t_end"});
}

double ratio(const Case& test_case, double N) {
  constexpr double largest_N = 249'999'999;
  const auto rule = fmt::format("a whole number, 0 <= N <= {:.0f}", largest_N);
  if (!(N >= 0.0 && N <= largest_N))
    refuse(test_case.entry->name, "N", N, rule,
           N < 0.0 ? "Mass 2 is X = 4N + 1 times as fast as mass 1." : "");
  if (N != std::floor(N))
    refuse(test_case.entry->name, "N", N, rule,
           "Only with X = 4N + 1 odd both masses pass equilibrium together at every impact.",
           "not-whole");
  return 4.0 * N + 1.0;
}

Parameter xi1() { return {"xi1", 0.05, "", "0 or 1e-60 <= xi1 < 1", "damping ratio of mass 1"}; }
Parameter whole_N() {
  return {"N", 2.0, "", "a whole number, 0 <= N <= 249999999",
          "mass 2 is X = 4N + 1 times as fast as mass 1, Eq. (9)"};
}
Parameter scale(const char* name, double default_value, const char* unit, const char* allowed,
                const char* meaning) {
  return {name, default_value, unit, allowed, meaning};
}

namespace {

void use(Case& test_case, std::shared_ptr<const exact::ClosedForm> motion) {
  test_case.problem = motion->problem();
  test_case.motion = std::move(motion);
}

void add_single_mass(Case& test_case, double xi1) {
  test_case.damped_periods = {2.0 * std::numbers::pi / std::sqrt((1.0 - xi1) * (1.0 + xi1))};
  test_case.constants = single_mass_constants(test_case, xi1);
}

template <class Pair>
void use_pair(Case& test_case, std::shared_ptr<const Pair> pair, double threshold) {
  const auto& c = pair->constants();
  const double r = c.r;
  use(test_case, pair);
  test_case.damped_periods = {2.0 * std::numbers::pi / c.omega_D1,
                              2.0 * std::numbers::pi / c.omega_D2};
  test_case.constants = pair_constants(test_case, c, r);
  test_case.indicators = indicator_constants(c.ratio.odd, std::min(c.omega_D1, c.omega_D2),
                                             test_case.motion->end(), threshold);
}

void synchronize(Case& test_case, const exact::PairParameters& parameters, double threshold) {
  use_pair(test_case,
           std::make_shared<const exact::SynchronizedPair>(parameters, test_case.entry->name),
           threshold);
}

std::vector<CaseRow> pair_rows() {
  return {
      {{"three-parameter",
        "Two colliding masses, the second 4N + 1 times as fast; t_end = 20 a_t.",
        "Eq. (25)-(26)",
        {whole_N(),
         xi1(),
         {"a_t", 1.0, "", "0 < a_t < infinity", "length of the run in units of 20 s, Eq. (24)"}}},
       [](Case& test_case, const Values& value, double threshold) {
         synchronize(test_case,
                     {.xi1 = value("xi1"),
                      .X = ratio(test_case, value("N")),
                      .t_end = 20.0 * require_positive(test_case.entry->name, "a_t", value("a_t"))},
                     threshold);
       }},
      {{"sdof", "One damped mass without a stop.", "Eq. (3)-(4)", {xi1(), t_end()}},
       [](Case& test_case, const Values& value, double) {
         use(test_case,
             std::make_shared<const exact::FreeMass>(
                 exact::FreeMassParameters{value("xi1"), value("t_end")}, test_case.entry->name));
         add_single_mass(test_case, value("xi1"));
       }},
      {{"stop",
        "One damped mass above a rigid stop at its equilibrium.",
        "Eq. (5)-(6)",
        {xi1(), eta(), t_end()}},
       [](Case& test_case, const Values& value, double threshold) {
         use(test_case, std::make_shared<const exact::RigidStop>(
                            exact::RigidStopParameters{value("xi1"), value("eta"), value("t_end")},
                            test_case.entry->name));
         add_single_mass(test_case, value("xi1"));
         test_case.indicators = indicator_constants(
             1.0, 2.0 * std::numbers::pi / test_case.damped_periods[0], value("t_end"), threshold);
       }},
      {{"symmetric-pair",
        "Two equal masses with opposite motions that collide at equilibrium.",
        "Eq. (7)-(8)",
        {xi1(), eta(), t_end()}},
       [](Case& test_case, const Values& value, double threshold) {
         synchronize(test_case,
                     {.xi1 = value("xi1"),
                      .X = 1.0,
                      .r = 1.0,
                      .eta = value("eta"),
                      .t_end = value("t_end")},
                     threshold);
       }},
      {{"one-parameter",
        "Two colliding masses, the second 4N + 1 times as fast; xi1 = 0.05, t_end = 20 s.",
        "Eq. (19)-(20)",
        {whole_N()}},
       [](Case& test_case, const Values& value, double threshold) {
         synchronize(test_case, {.X = ratio(test_case, value("N"))}, threshold);
       }},
      {{"two-parameter",
        "Two colliding masses, the second 4N + 1 times as fast; t_end = 20 s.",
        "Eq. (21)-(22)",
        {whole_N(), xi1()}},
       [](Case& test_case, const Values& value, double threshold) {
         synchronize(test_case, {.xi1 = value("xi1"), .X = ratio(test_case, value("N"))},
                     threshold);
       }},
      {{"synchronized-pair",
        "The general pair: any masses, odd frequency ratio, mass ratio below r*, restitution.",
        "Section 2.2, Eq. (9)-(17)",
        {scale("m1", 1.0, "kg", "1e-60 <= m1 <= 1e+60", "mass 1, above"),
         scale("k1", 1.0, "N/m", "1e-60 <= k1 <= 1e+60", "stiffness of mass 1"),
         xi1(),
         scale("A", 1.0, "m", "1e-60 <= A <= 1e+60", "size of the initial displacement of mass 1"),
         {"X", 9.0, "", "an odd whole number from 1 to 1e+09, or 1 over one",
          "frequency ratio omega_D2/omega_D1; 1 over an odd number exchanges the roles"},
         {"r", 3.0, "", "0 < r < r*(X)",
          "mass ratio m1/m2; beyond 1/r* for X = 1 over an odd number"},
         eta(),
         t_end()}},
       [](Case& test_case, const Values& value, double threshold) {
         synchronize(test_case,
                     {value("m1"), value("k1"), value("xi1"), value("A"), value("X"), value("r"),
                      value("eta"), value("t_end")},
                     threshold);
       }},
      {{"exact-data-pair",
        "The general pair with every model input a binary64 number, so that nothing is rounded.",
        "Section 2.2, Eq. (9)-(17)",
        {scale("m2", 1.0, "kg", "1e-30 <= m2 <= 1e+30, a short binary fraction",
               "mass 2, the fast one"),
         scale("Omega", 1.0, "rad/s", "1e-30 <= Omega <= 1e+30, a short binary fraction",
               "damped frequency of mass 1"),
         scale("sigma", 0.0625, "1/s", "0 or 1e-30 <= sigma <= 1e+30, a short binary fraction",
               "common rate of decay"),
         scale("A_over_X", 0.125, "m", "1e-30 <= A_over_X <= 1e+30, a short binary fraction",
               "initial displacement of mass 1 over X"),
         {"X", 9.0, "", "an odd whole number from 1 to 1e+09", "frequency ratio omega_D2/omega_D1"},
         {"r", 0.5, "", "0 < r < r*(X), a short binary fraction", "mass ratio m1/m2"},
         eta(),
         t_end()}},
       [](Case& test_case, const Values& value, double threshold) {
         const exact::ExactDataParameters parameters{
             value("m2"), value("Omega"), value("sigma"), value("A_over_X"),
             value("X"),  value("r"),     value("eta"),   value("t_end")};
         use_pair(test_case,
                  std::make_shared<const exact::ExactDataPair>(parameters, test_case.entry->name),
                  threshold);
       }},
  };
}

const std::vector<CaseRow>& rows() {
  static const auto all = [] {
    auto list = pair_rows();
    for (const auto more : {assembly_rows, orbit_rows, resting_rows, friction_rows, elliptic_rows,
                            bar_rows, string_rows})
      for (auto& row : more()) list.push_back(std::move(row));
    return list;
  }();
  return all;
}

const CaseRow& row(std::string_view name) {
  for (const auto& row : rows())
    if (row.entry.name == name) return row;
  std::vector<std::string> names;
  for (const auto& row : rows()) names.push_back(row.entry.name);
  refuse_name("case", name, names, "clackers list cases");
}

}  // namespace

std::span<const CaseEntry> entries() {
  static const auto all = [] {
    std::vector<CaseEntry> list;
    for (const auto& row : rows()) list.push_back(row.entry);
    return list;
  }();
  return all;
}

std::string_view default_case() { return entries().front().name; }

const CaseEntry& entry(std::string_view name) { return row(name).entry; }

namespace {

Case made(std::string_view name, const Settings& settings, double threshold, bool is_mesh_only) {
  const auto& [entry, build] = row(name);
  if (!(threshold > 0.0 && threshold < 1.0))
    refuse(entry.name, "threshold", threshold, "0 < threshold < 1",
           "It is the share of the spectral peak from which a harmonic counts.");
  Case test_case;
  test_case.entry = &entry;
  test_case.is_mesh_only = is_mesh_only;
  test_case.values = complete(entry.name, entry.parameters, settings);
  build(test_case, Values{test_case.values}, threshold);
  return test_case;
}

}  // namespace

Case make(std::string_view name, const Settings& settings, double threshold) {
  return made(name, settings, threshold, false);
}

Case make_mesh(std::string_view name, const Settings& settings) {
  auto test_case = made(name, settings, default_threshold, true);
  if (!test_case.mesh)
    throw InputError(
        fmt::format(
            "{}: its problem is no mesh, and a path of steps and elements needs one; allowed: a "
            "case with the mesh of a bar or a string, as bar-wall (clackers list cases).",
            name),
        "no-closed-form");
  return test_case;
}

Admissibility admissibility(double X, double r) {
  const auto ratio = exact::frequency_ratio("admissibility", X);
  exact::require_scale("admissibility", "r", r);
  return {exact::r_star(ratio.odd), exact::admissibility_margin(ratio, r)};
}

}  // namespace clackers::cases
