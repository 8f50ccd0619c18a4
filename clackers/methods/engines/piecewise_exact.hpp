#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// The motion in closed form from one event to the next, for M a + C v + K u = 0 with contacts
/// g_j = b_j . u - gap_j >= 0 and Newton's law. Between events
///
///     u = rest + sum_j shape_j y_j + rate_shape_j y_j',   y_j'' + 2 sigma_j y_j' + omega_j^2 y_j = 0
///
/// with the modes of the structure, complex ones where the damping couples them. The next event is the
/// first zero of any open gap or of any contact force, proven: from a known state, bounds of the
/// second and third derivative exclude a zero up to a point, the next known state is there, and
/// modes that are fast and too small to close the gap count by their amplitude alone. A dip of a gap
/// below 0 may remain unnoticed where it is less than 1e-16 of the amplitudes. All contacts that are
/// closed together take part in one impact, 0 <= b_j.v(+) + eta b_j.v(-) _|_ P_j >= 0.
///
/// A contact is an active constraint when it is closed, its gap rate is 0 and the others would
/// close it, until its force is negative: after an impact with eta = 0, from a start at rest, or
/// when impacts have accumulated, so that the gap would rise by less than its rounding before the
/// next one; the rest of the accumulation, shorter than 1e-6 of a period, is left out. States are
/// delivered after each step, which the motion does not depend on.
///
/// Order       none: exact but for rounding, at every step.
/// Stability   for every h.
/// Dissipation none but that of the structure.
/// Memory      none.
/// Cost        a sine, a cosine and an exponential a mode for each state, and about 15 such an impact,
///             at any ratio of the frequencies; an eigenvalue problem for each set of active contacts.
/// Source      A. Soroushian, A. Ahmadi, H. Amiri, Sci. Iran. B (2018), for the sums of modes between
///             impacts; V. Acary, B. Brogliato, Numerical Methods for Nonsmooth Dynamical Systems,
///             Springer (2008), chapter 8, for events.
struct PiecewiseExact {
  static constexpr std::string_view name = "piecewise-exact";
  static constexpr std::string_view summary =
      "closed-form modal motion between impacts, the first contact proven";

  static constexpr int most_idle_events = 1000;  ///< without time passing; a message repeats it

  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
