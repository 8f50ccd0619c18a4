#pragma once

namespace clackers::exact {

/// The paper's indicators of a pair. "Non-trivially contributing" (Eq. 11) needs a threshold: the
/// harmonics of the fast mass counted are those with at least `threshold` of the spectral peak, of
/// the elastic undamped motion; docs/manual/explanation/derivations/energy-and-spectrum.md.
struct Indicators {
  double threshold = 0.0;         ///< of the spectral peak
  double stiffness_ratio = 1.0;   ///< I_ms, Eq. (10): fast over slow damped frequency
  double longest_period = 0.0;    ///< T_L = pi / Omega [s]
  double highest_harmonic = 0.0;  ///< n_eps = T_L / T_S, a whole number
  double shortest_period = 0.0;   ///< T_S = pi / (n_eps Omega) [s]
  double oscillations = 0.0;      ///< I_OC = t_end / T_S, Eq. (23)
  bool bound_holds = true;        ///< Eq. (11): I_ms >= T_L / T_S
};

/// `odd` is the frequency ratio fast over slow, `omega` the damped frequency of the slow mass
/// [1/s], `end` in s. Throws InputError unless 0 < threshold < 1,
/// and where more than 5e14 harmonics would reach it.
Indicators indicators(double odd, double omega, double end, double threshold);

}  // namespace clackers::exact
