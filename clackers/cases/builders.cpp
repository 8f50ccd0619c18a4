#include "clackers/cases/builders.hpp"

#include <cmath>
#include <numbers>

#include "clackers/cases/constants.hpp"
#include "clackers/cases/parameters.hpp"
#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::cases {
namespace {

template <class Motion>
void use(Case& which, std::shared_ptr<const Motion> motion) {
  which.problem = motion->problem();
  which.motion = std::move(motion);
}

void build_single(Case& which, double xi1) {
  const double omega_d = std::sqrt((1.0 - xi1) * (1.0 + xi1));
  which.damped_periods = {2.0 * std::numbers::pi / omega_d};
  which.constants = single_mass_constants(which, xi1);
}

template <class Pair>
void build_pair(Case& which, std::shared_ptr<const Pair> pair, double threshold) {
  const auto& c = pair->constants();
  const double r = c.r;
  use(which, pair);
  which.damped_periods = {2.0 * std::numbers::pi / c.omega_D1, 2.0 * std::numbers::pi / c.omega_D2};
  which.constants = pair_constants(which, c, r);
  which.indicators = indicator_constants(c.ratio.odd, std::min(c.omega_D1, c.omega_D2),
                                         which.motion->end(), threshold);
}

void build_class_member(Case& which, const exact::PairParameters& parameters, double threshold) {
  build_pair(which, std::make_shared<const exact::SynchronizedPair>(parameters, which.entry->name),
             threshold);
}

}  // namespace

void build_sdof(Case& which, double) {
  const Values value(which.values);
  use(which, std::make_shared<const exact::FreeMass>(
                 exact::FreeMassParameters{value["xi1"], value["t_end"]}, which.entry->name));
  build_single(which, value["xi1"]);
}

void build_stop(Case& which, double threshold) {
  const Values value(which.values);
  use(which, std::make_shared<const exact::RigidStop>(
                 exact::RigidStopParameters{value["xi1"], value["eta"], value["t_end"]},
                 which.entry->name));
  build_single(which, value["xi1"]);
  which.indicators = indicator_constants(1.0, 2.0 * std::numbers::pi / which.damped_periods[0],
                                         value["t_end"], threshold);
}

void build_symmetric_pair(Case& which, double threshold) {
  const Values value(which.values);
  build_class_member(
      which,
      {.xi1 = value["xi1"], .X = 1.0, .r = 1.0, .eta = value["eta"], .t_end = value["t_end"]},
      threshold);
}

void build_one_parameter(Case& which, double threshold) {
  const Values value(which.values);
  build_class_member(which, {.X = ratio_of(which.entry->name, value["N"])}, threshold);
}

void build_two_parameter(Case& which, double threshold) {
  const Values value(which.values);
  build_class_member(which, {.xi1 = value["xi1"], .X = ratio_of(which.entry->name, value["N"])},
                     threshold);
}

void build_three_parameter(Case& which, double threshold) {
  const Values value(which.values);
  build_class_member(which,
                     {.xi1 = value["xi1"],
                      .X = ratio_of(which.entry->name, value["N"]),
                      .t_end = end_of(which.entry->name, value["a_t"])},
                     threshold);
}

void build_synchronized_pair(Case& which, double threshold) {
  const Values value(which.values);
  build_class_member(which,
                     {value["m1"], value["k1"], value["xi1"], value["A"], value["X"], value["r"],
                      value["eta"], value["t_end"]},
                     threshold);
}

void build_exact_data_pair(Case& which, double threshold) {
  const Values value(which.values);
  const exact::ExactDataParameters parameters{value["m2"],       value["Omega"], value["sigma"],
                                              value["A_over_X"], value["X"],     value["r"],
                                              value["eta"],      value["t_end"]};
  build_pair(which, std::make_shared<const exact::ExactDataPair>(parameters, which.entry->name),
             threshold);
}

}  // namespace clackers::cases
