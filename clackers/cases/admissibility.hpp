#pragma once

namespace clackers::cases {

/// How far the masses of a pair stay apart away from equilibrium (sharp form of Eq. 18).
struct Admissibility {
  double r_star = 0.0;  ///< limit of slow over fast mass; infinity for equal frequencies
  /// Smallest gap between collisions relative to the slow displacement: 1 - r/r*, 1 - 1/(r r*) for
  /// X = 1 over an odd number, 1 + r for X = 1. The closed form holds where it is positive; 0 grazes.
  double margin = 0.0;
};

/// For a frequency ratio X (odd, or 1 over an odd number) and a mass ratio r = m1/m2, admissible or
/// not. Throws InputError for another X, and unless 1e-60 <= r <= 1e60.
Admissibility admissibility(double X, double r);

}  // namespace clackers::cases
