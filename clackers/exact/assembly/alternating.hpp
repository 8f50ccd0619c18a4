#pragma once

#include <memory>
#include <string_view>

#include "clackers/exact/assembly/shaped_motion.hpp"
#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// Three masses one above the other, each on its own spring and dashpot, elastic: the middle one meets
/// the lower and the upper one in turn, every half of an outer half-period, and passes equilibrium
/// rh - 1 times between two impacts. The outer ones have mass 1 kg and an amplitude of 1 m. At t = 0,
/// half way between two impacts, the middle mass is at equilibrium.
struct AlternatingParameters {
  double rh = 2.0;  ///< half-periods of the middle mass between impacts: even, up to 5e8
  double r = 1.0;   ///< outer over middle mass, below r*(2 rh); 1e-60 to 1e60
  double Omega =
      1.0;  ///< damped frequency of the outer masses [rad/s], 1e-60 to 5e59; middle: 2 rh times it
  double sigma = 0.05;  ///< common rate of decay [1/s], 0 or 1e-60 to 1e60
  double t_end = 20.0;  ///< [s]
};

/// r*(2 rh), the limit of r: the function of admissibility.hpp at an even ratio.
double alternating_limit(double rh);

/// Throws InputError for parameters outside their ranges, and (not-admissible) for an r with which
/// the middle mass would touch a partner between impacts.
std::unique_ptr<const ShapedMotion> make_alternating(const AlternatingParameters& parameters,
                                                     std::string_view who = "alternating");

/// What a method is given.
model::ImpactProblem<> alternating_problem(const AlternatingParameters& parameters,
                                           const model::Motion& motion);

}  // namespace clackers::exact
