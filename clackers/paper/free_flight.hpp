#pragma once

#include "clackers/cases/case.hpp"

namespace clackers::paper {

/// One mass of a case on its own spring and dashpot, no contact anywhere: Eq. (4) and (27) for any
/// start, from the masses, dampings and stiffnesses that a solver is given. It shares nothing with
/// the evaluation of the exact motion, so the two can be compared.
class FreeFlight {
 public:
  /// Mass 1 or 2 of the case; below critical damping.
  FreeFlight(const cases::Case& which, int mass);
  double u(double t) const;  ///< displacement [m]
  double v(double t) const;  ///< velocity [m/s]

 private:
  double sigma_, omega_;  // rate of decay and damped frequency [1/s]
  double a_, b_;          // u = exp(-sigma t) (a cos(omega t) + b sin(omega t)) [m]
};

}  // namespace clackers::paper
