#pragma once

#include <optional>
#include <span>

#include "clackers/judge/convergence/fit/error_ladder.hpp"

namespace clackers::judge {

/// A law of two terms for errors:  error = | a h^p + b h^q |,  q = 0 for a floor.
struct TwoTerms {
  double p = 0.0, q = 0.0;
  double a = 0.0, b = 0.0;  ///< a > 0; b of the other sign where the error passes zero
  double p_spread = 0.0;    ///< half width of the 95 % interval of p; 0 where p was given
  double b_error = 0.0;     ///< standard error of b
  double scatter = 1.0;     ///< largest factor between errors and law, away from a zero
  double crossing = 0.0;    ///< step at which both terms are of equal size
  int points = 0;
  double largest = 0.0, smallest = 0.0;  ///< steps of the points

  /// Octaves of the ladder in which the term of p, or that of q, is the larger one.
  double octaves_of_p() const;
  double octaves_of_q() const;
  double error_at(double step) const;
};

/// Which terms a law may have.
struct Terms {
  double p = 0.0;        ///< 0: free, between `lowest_free` and `highest_free`
  double q = 0.0;        ///< less than p: below the crossing this term rules
  bool cancels = false;  ///< the terms have different signs and the error passes zero
};
inline constexpr double lowest_free = 0.4, highest_free = 8.0;

/// Fits the law to the raw points of the levels [first, last] by least squares of the relative
/// deviations (relative to the largest error within three quarters of an octave where the error
/// passes zero). Nothing for fewer points than parameters and two more, or where the terms do not
/// have the signs asked for.
std::optional<TwoTerms> fit_two_terms(std::span<const LevelView> levels, int first, int last,
                                      const Terms& terms);

/// The largest order that errors above a floor may have: the end of the interval of p where
/// a h^p + c  describes the raw points of the levels better than a line does (by Akaike's criterion,
/// which asks for a gain of 2 for the one parameter more); 0 otherwise.
double order_above_floor(std::span<const LevelView> levels, int first, int last);

}  // namespace clackers::judge
