#pragma once

#include <string_view>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/pair/pair_constants.hpp"

namespace clackers::exact {

/// The free parameters of a pair with exact data; all but X and t_end short binary fractions.
struct ExactDataParameters {
  double m2 = 1.0;          ///< the fast mass [kg], 1e-30 to 1e30
  double Omega = 1.0;       ///< damped frequency of mass 1 [1/s], 1e-30 to 1e30
  double sigma = 0.0625;    ///< common rate of decay [1/s], 0 or 1e-30 to 1e30
  double A_over_X = 0.125;  ///< u1(0)/X [m], 1e-30 to 1e30
  double X = 9.0;           ///< odd whole number
  double r = 0.5;           ///< m1/m2, 1e-30 <= r < r*(X)
  double eta = 1.0;         ///< restitution, 0 to 1
  double t_end = 20.0;      ///< [s]
};

/// A synchronized pair all of whose model inputs (masses, dampings, stiffnesses, initial state) are
/// exactly binary64 numbers, so that a method receives the true system: m1 = r m2, c_i = 2 m_i
/// sigma, k1 = m1 (Omega^2 + sigma^2), k2 = m2 (X^2 Omega^2 + sigma^2), u1(0) = X (A/X), u2(0) =
/// -s r (A/X), v_i(0) = -sigma u_i(0). Any rounding of k2 alone would move the phase by X Omega t
/// times 5e-17.
class ExactDataPair : public ClosedForm {
 public:
  /// Throws InputError for parameters outside their ranges, and for those with which some model
  /// input is no binary64 number (not-exact-data), naming the input.
  explicit ExactDataPair(const ExactDataParameters& parameters,
                         std::string_view who = "exact-data-pair");

  const ExactDataParameters& parameters() const { return parameters_; }
  const PairConstants& constants() const { return constants_; }

 private:
  ExactDataPair(const ExactDataParameters& parameters, const WideMotion& motion);

  ExactDataParameters parameters_;
  PairConstants constants_;
};

}  // namespace clackers::exact
