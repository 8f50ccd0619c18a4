#pragma once

#include <optional>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/methods/integrator.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::tables {

/// The harmonics of the fast mass of a pair around their peak and around the last that reaches
/// `threshold`; nothing for a single mass.
std::optional<record::Sheet> harmonic_sheet(const cases::Case& test_case, double threshold);

/// After which impact a disturbance of the start, or of the frequencies, has made a pair lose its
/// synchrony, for several sizes; nothing for a single mass.
std::optional<record::Sheet> conditioning_sheet(const cases::Case& test_case);

/// What an integrator does to the free vibration of one undamped mass with the period T, with steps
/// of h. NaN where a quantity has no meaning, or growth is too fast to be measured.
struct Amplification {
  double steps = 0.0;            ///< h/T
  double spectral_radius = 0.0;  ///< largest |eigenvalue| of a step; above 1 the motion grows
  /// T'/T - 1 of the period T' that comes out; NaN from where the motion no longer oscillates, or h/T
  /// is too far from the last one to recognise its eigenvalue.
  double period_elongation = 0.0;
  double amplitude_decay =
      0.0;  ///< part of the amplitude that is lost in a period T'; NaN likewise
  /// Largest |u| and |v| of the first ten steps over the exact amplitude, the larger of a start with
  /// u alone and of one with v alone; NaN where the motion grows.
  double u_overshoot = 0.0, v_overshoot = 0.0;
};

/// The amplification at values of h/T > 0 in ascending order, the first of them small enough for the
/// motion to oscillate. Measured: steps are made and their eigenvalues taken from the states.
std::vector<Amplification> amplification(const methods::Integrator& integrator,
                                         const std::vector<double>& steps);

/// The figures of an integrator: period elongation and amplitude decay for h/T up to 0.4, spectral
/// radius and overshoot from 0.01 to 100.
std::vector<record::Sheet> amplification_sheets(const methods::Integrator& integrator);

}  // namespace clackers::tables
