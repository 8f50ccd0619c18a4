#pragma once

#include <array>
#include <complex>

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {

/// The Fourier transform of the displacements over the run,
///     F_i(omega) = integral from 0 to t_end of u_i(t) exp(-i omega t) dt   [m s],
/// in closed form, the sum over all flights being geometric; docs/manual/explanation/derivations/energy-and-spectrum.md. Every phase is
/// formed in double-double, and no step divides by what vanishes at resonance (omega a damped
/// frequency, sigma = 0) or where all flights add up (omega a multiple of 2 Omega).
class Spectrum {
 public:
  /// Beyond, phases are not certain to 1e-13: omega t_end in radians.
  static constexpr double most_radians = 0x1p55;

  /// The motion must outlive it.
  explicit Spectrum(const ClosedForm& motion);

  /// F_1 and F_2 (0 for one mass) at omega >= 0 [rad/s]. Error at most 1e-13 of the sum of the
  /// magnitudes of its three parts: first flight, later whole flights, last one. Throws InputError
  /// unless 0 <= omega and omega t_end <= most_radians.
  std::array<std::complex<double>, 2> at(double omega) const;

 private:
  const ClosedForm& motion_;
  numerics::DoubleDouble inverse_;  ///< 1 / Omega [s]
  double omega_, sigma_;            ///< Omega, sigma [1/s]
  numerics::DoubleDouble last_;     ///< length of the last flight, or the run, in half periods
  double impacts_ = 0.0;            ///< up to t_end
};

}  // namespace clackers::exact
