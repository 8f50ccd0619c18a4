#pragma once

#include <string_view>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/pair/frequency_ratio.hpp"
#include "clackers/exact/pair/pair_constants.hpp"

namespace clackers::exact {

/// The free parameters of a synchronized pair (motion.md; Eq. (25) is m1 = k1 =
/// A = 1, r = 3, eta = 1, X = 4N + 1).
struct PairParameters {
  double m1 = 1.0;      ///< mass 1, above [kg], 1e-60 to 1e60
  double k1 = 1.0;      ///< its stiffness [N/m], 1e-60 to 1e60
  double xi1 = 0.05;    ///< its damping ratio, 0 or 1e-60 <= xi1 < 1
  double A = 1.0;       ///< |u1(0)| [m], 1e-60 to 1e60
  double X = 9.0;       ///< damped frequency of mass 2 over that of mass 1: odd, or 1/odd
  double r = 3.0;       ///< m1/m2, below r*(X), or above 1/r*(1/X) for X = 1/odd; 1e-60 to 1e60
  double eta = 1.0;     ///< restitution, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// The exact motion of two masses, each on its own spring and dashpot, that collide only at their
/// common equilibrium: Eq. (9), (12), (13), (15)-(17) with any mass ratio, restitution and odd X.
/// It is exact for the binary64 values of the parameters, and X = 1/odd stands for that fraction.
/// u1(0) = A and u2(0) = -s r A/X with s = (-1)^((odd-1)/2), except for X = 1/odd, where they are
/// s A and -r A/X: mass 2 is the slow one then and starts below.
class SynchronizedPair : public ClosedForm {
 public:
  /// Throws InputError for parameters outside their ranges; `who` opens the message.
  explicit SynchronizedPair(const PairParameters& parameters,
                            std::string_view who = "synchronized-pair");

  const PairParameters& parameters() const { return parameters_; }
  const PairConstants& constants() const { return constants_; }

 private:
  SynchronizedPair(const PairParameters& parameters, const FrequencyRatio& ratio,
                   const WideMotion& motion);

  PairParameters parameters_;
  PairConstants constants_;
};

}  // namespace clackers::exact
