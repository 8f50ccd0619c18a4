#pragma once

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::certified {

/// The free parameters of a motion, each a binary64 number that is meant exactly.
struct Inputs {
  explicit Inputs(const exact::PairParameters& parameters);
  explicit Inputs(const exact::ExactDataParameters& parameters);
  explicit Inputs(const exact::RigidStopParameters& parameters);
  explicit Inputs(const exact::FreeMassParameters& parameters);
  /// Those of a motion of the module exact; throws InputError (no-enclosure) for any other.
  explicit Inputs(const model::Motion& motion);

  /// Damped frequency of mass i (0 or 1) over Omega.
  double multiple(std::size_t i) const { return dof == 2 && exchanged == (i == 0) ? odd : 1.0; }

  enum class Kind { pair, exact_data, single };
  Kind kind = Kind::single;
  int dof = 1;
  bool collides = true;
  double odd = 1.0;        ///< fast over slow damped frequency
  bool exchanged = false;  ///< mass 1 is the fast one
  double mass = 1.0;       ///< m1; of exact data m2
  double r = 1.0;          ///< m1/m2
  double stiffness = 1.0;  ///< k1; not of exact data
  double damping = 0.0;    ///< xi1; of exact data sigma
  double frequency = 1.0;  ///< Omega; of exact data only
  double amplitude = 1.0;  ///< A; of exact data A/X
  double eta = 1.0;
};

}  // namespace clackers::certified
