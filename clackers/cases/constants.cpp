#include "clackers/cases/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "clackers/exact/quantities/quantities.hpp"

namespace clackers::cases {
namespace {

double restitution(const Case& test_case) { return test_case.problem.contacts.front().restitution; }

Quantity number_of_impacts(const Case& test_case) {
  return {"impacts", double(test_case.motion->impact_count(test_case.motion->end())), "",
          "number of impacts up to t_end"};
}

// What a user may attribute to the solver: docs/manual/explanation/derivations/conditioning.md.
std::vector<Quantity> conditioning_of(const Case& test_case, const exact::PairConstants& c,
                                      double r) {
  const double eta = restitution(test_case);
  const double rate = exact::detuning_rate(c.ratio, r);
  constexpr double endless = std::numeric_limits<double>::infinity();
  switch (exact::conditioning(c.ratio, r, eta)) {
    case exact::Conditioning::neutral:
      return {{"perturbation_growth", 1.0, "",
               "conditioning: neutral; an error at one impact, relative to the motion, is as "
               "large at the next"}};
    case exact::Conditioning::growing: {
      std::vector<Quantity> list{
          {"perturbation_growth", eta > 0.0 ? 1.0 / eta : endless, "",
           "conditioning: growing; an error relative to the motion is multiplied by 1/eta at "
           "each impact, after k by eta^-k"}};
      if (rate > 0.0)
        list.push_back({"detuning_rate", rate, "",
                        "lambda: a solver that shifts omega_D2/omega_D1 by a relative eps loses "
                        "synchrony by a factor exp(lambda |eps|)/eta at each impact"});
      return list;
    }
    case exact::Conditioning::detuning_fragile:
      break;
  }
  return {{"perturbation_growth", 1.0, "",
           "conditioning: detuning-fragile; an error at one impact does not grow by itself, yet a "
           "solver that shifts omega_D2/omega_D1 by a relative eps loses synchrony"},
          {"detuning_rate", rate, "",
           "lambda: the loss of synchrony grows by exp(lambda |eps|) at each impact; with r <= 1 "
           "(slow over fast mass) it would not grow"}};
}

}  // namespace

std::vector<Quantity> pair_constants(const Case& test_case, const exact::PairConstants& c,
                                     double r) {
  const auto limit = c.ratio.is_inverse
                         ? "limit of m2/m1, the slow mass over the fast one; the closed "
                           "form holds below it (sharp form of Eq. 18)"
                         : "limit of the mass ratio r; the closed form holds below it "
                           "(sharp form of Eq. 18)";
  std::vector<Quantity> list{
      {"m1", c.m1, "kg", "mass 1, above"},
      {"m2", c.m2, "kg", "mass 2, below"},
      {"k1", c.k1, "N/m", "stiffness of mass 1"},
      {"k2", c.k2, "N/m", "stiffness of mass 2"},
      {"c1", c.c1, "N s/m", "damping of mass 1"},
      {"c2", c.c2, "N s/m", "damping of mass 2"},
      {"xi1", c.xi1, "", "damping ratio of mass 1"},
      {"xi2", c.xi2, "", "damping ratio of mass 2, Eq. (15)"},
      {"sigma", c.sigma, "1/s", "common rate of decay, Eq. (12)"},
      {"omega1", c.omega1, "rad/s", "undamped frequency of mass 1 alone"},
      {"omega2", c.omega2, "rad/s", "undamped frequency of mass 2 alone"},
      {"omega_D1", c.omega_D1, "rad/s", "damped frequency of mass 1 alone"},
      {"omega_D2", c.omega_D2, "rad/s", "damped frequency of mass 2 alone, Eq. (9)"},
      {"u1(0)", c.u1, "m", "initial displacement of mass 1"},
      {"d2", c.u2, "m", "initial displacement u2(0) of mass 2, Eq. (13)"},
      {"v1(0)", c.v1, "m/s", "initial velocity of mass 1, -sigma u1(0)"},
      {"v2(0)", c.v2, "m/s", "initial velocity of mass 2, -sigma u2(0), Eq. (17)"},
      {"X", c.ratio.is_inverse ? 1.0 / c.ratio.odd : c.ratio.odd, "", "omega_D2/omega_D1"},
      {"r", r, "", "mass ratio m1/m2"},
      {"eta", restitution(test_case), "", "restitution"},
      {"r*", c.r_star, "", limit},
      {"margin", c.margin, "",
       c.ratio.odd == 1.0 ? "smallest gap relative to |u1|, 1 + r: the masses move opposite"
                          : "smallest gap between impacts relative to the slow displacement, "
                            "1 - r/r* (r slow over fast mass)"},
      {"T", c.period, "s", "time between impacts"},
      {"t_1", c.first_impact, "s", "time of the first impact, Eq. (28)"},
      {"t_end", test_case.motion->end(), "s", "end of the run"},
      number_of_impacts(test_case)};
  std::ranges::move(conditioning_of(test_case, c, r), std::back_inserter(list));
  return list;
}

std::vector<Quantity> single_mass_constants(const Case& test_case, double xi1) {
  const double omega_d = std::sqrt((1.0 - xi1) * (1.0 + xi1));
  std::vector<Quantity> list{{"m1", 1.0, "kg", "the mass"},
                             {"k1", 1.0, "N/m", "its stiffness"},
                             {"c1", 2.0 * xi1, "N s/m", "its damping"},
                             {"xi1", xi1, "", "its damping ratio"},
                             {"sigma", xi1, "1/s", "rate of decay"},
                             {"omega1", 1.0, "rad/s", "undamped frequency"},
                             {"omega_D1", omega_d, "rad/s", "damped frequency"},
                             {"u1(0)", 1.0, "m", "initial displacement"},
                             {"v1(0)", test_case.problem.start.v[0], "m/s", "initial velocity"}};
  if (!test_case.problem.contacts.empty()) {
    const double half = std::numbers::pi / omega_d;
    list.push_back({"eta", restitution(test_case), "", "restitution"});
    list.push_back({"T", half, "s", "time between impacts"});
    list.push_back({"t_1", 0.5 * half, "s", "time of the first impact"});
  }
  list.push_back({"t_end", test_case.motion->end(), "s", "end of the run"});
  list.push_back(number_of_impacts(test_case));
  if (!test_case.problem.contacts.empty())
    list.push_back({"perturbation_growth", 1.0, "",
                    "conditioning: neutral; an error at one impact, relative to the motion, is as "
                    "large at the next, for every restitution"});
  return list;
}

std::vector<Quantity> indicator_constants(double odd, double omega, double end, double threshold) {
  const auto i = exact::indicators(odd, omega, end, threshold);
  return {
      {"threshold", i.threshold, "",
       "share of the spectral peak from which a harmonic counts as contributing"},
      {"I_ms", i.stiffness_ratio, "",
       "stiffness ratio omega_D2/omega_D1, fast over slow, Eq. (10)"},
      {"T_L", i.longest_period, "s", "longest period of the response"},
      {"T_S", i.shortest_period, "s",
       fmt::format("shortest contributing period at this threshold; Eq. (11), I_ms >= T_L/T_S = "
                   "{:.0f}, {}",
                   i.highest_harmonic, i.bound_holds ? "holds" : "does not hold")},
      {"I_OC", i.oscillations, "", "oscillations t_end/T_S at this threshold, Eq. (23)"}};
}

}  // namespace clackers::cases
