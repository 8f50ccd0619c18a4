#pragma once

#include "clackers/exact/pair/parameters.hpp"

namespace clackers::exact {

/// |a_n|, n = 0, 1, ..., of the fast mass of the elastic undamped motion: over the period T,
/// u2/u2(0) = sum of a_n cos(2 n Omega t) up to signs, with |a_0| = 2/(pi X) the mean and |a_n| =
/// (4X/pi)/|X^2 - 4n^2|; docs/manual/explanation/derivations/energy-and-spectrum.md. `odd` is X. Largest for 2n = X - 1 (n = 1 for X
/// = 1). Relative error at most 2^-51. Throws InputError unless n is a whole number from 0 to 1e15.
double harmonic_amplitude(double odd, double n);

/// The n of the largest: (X - 1)/2, or 1 for X = 1.
double peak_harmonic(double odd);

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

/// What becomes of small errors at the impacts of a synchronized pair, and so which errors
/// a user may attribute to a solver. Relative means: against the decaying amplitude of the motion.
enum class Conditioning {
  neutral,           ///< elastic with r <= 1 or X = 1: a relative error stays what it is
  growing,           ///< eta < 1: a relative error grows by 1/eta at each impact
  detuning_fragile,  ///< elastic with r > 1 and X >= 3: a detuned frequency destroys synchrony
};

/// The kind of a pair with slow over fast mass `r` > 0 and restitution `eta` in [0, 1]; for
/// X = 1/odd r is still m1/m2 and counts as 1/r.
Conditioning conditioning(const FrequencyRatio& ratio, double r, double eta);

/// lambda = pi sqrt((r - 1) (X^2 - r^2) / (1 + r)^3), r slow over fast mass: in an elastic pair
/// whose damped frequencies have the ratio X (1 + eps), as caused by a solver's dispersion them, a loss
/// of synchrony grows by exp(lambda |eps|) at each impact, to first order in eps. 0 where it
/// does not grow: for r <= 1, where it oscillates instead, and for X = 1. Needs r < X for X >= 3,
/// which admissibility implies.
double detuning_rate(const FrequencyRatio& ratio, double r);

/// The impact after which a disturbance of relative size `size` (0 < size < 1) at the start has
/// grown to lost_synchrony: ln(0.1/size)/ln(1/eta), rounded up, at least 1; infinity for eta = 1,
/// where it does not grow; 0 when it is that large already. To first order.
double impacts_until_perturbation(double eta, double size);

/// The same for damped frequencies whose ratio is X (1 + eps), 0 < |eps| < 1. The smaller of two:
/// - a loss of |eps| that grows by exp(lambda |eps|)/eta at each impact. Average-acceleration
///   Newmark restarted at each impact lost synchrony within 5 % of it (X = 9, r = 3, eta = 1, 20 to
///   160 steps a fast period);
/// - the loss in a simulation of the detuned pair from its exact start, followed for 3e4 evaluations
///   of the gap. It is the smaller one near r*, where the masses touch away from equilibrium;
///   elsewhere it takes 1.2 to 1.7 times as many impacts, as it starts below |eps|.
/// Infinity where neither loses it.
double impacts_until_detuning(const FrequencyRatio& ratio, double r, double eta, double eps);

}  // namespace clackers::exact
