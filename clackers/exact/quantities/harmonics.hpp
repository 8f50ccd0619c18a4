#pragma once

namespace clackers::exact {

/// |a_n|, n = 0, 1, ..., of the fast mass of the elastic undamped motion: over the period T,
/// u2/u2(0) = sum of a_n cos(2 n Omega t) up to signs, with |a_0| = 2/(pi X) the mean and |a_n| =
/// (4X/pi)/|X^2 - 4n^2|; docs/manual/explanation/derivations/energy-and-spectrum.md. `odd` is X. Largest for 2n = X - 1 (n = 1 for X
/// = 1). Relative error at most 2^-51. Throws InputError unless n is a whole number from 0 to 1e15.
double harmonic_amplitude(double odd, double n);

/// The n of the largest: (X - 1)/2, or 1 for X = 1.
double peak_harmonic(double odd);

}  // namespace clackers::exact
