#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// The nonsmooth generalised-alpha scheme, in its first form with impulses W at the level of velocity
/// alone. s is the acceleration without contact forces, rho the spectral radius at infinite omega h:
///
///     M s1 + C v1 + K u1 + p(u1, v1) = f(t1)
///     (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) s1 + alpha_f s0
///     v1 = v0 + h [(1 - gamma) a0 + gamma a1] + W,               M W = B^T P
///     u1 = u0 + h v0 + h² [(1/2 - beta) a0 + beta a1] + h/2 W
///     0 <= b.v1 + eta b.v0 _|_ P >= 0      where g(u1) <= 0 for W = 0, else P = 0
///     alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1),
///     gamma = 1/2 - alpha_m + alpha_f, beta = (1 - alpha_m + alpha_f)²/4
///
/// The gap may stay negative by the motion of one step. Impacts are reported at the end of the step.
///
/// Order       2 in smooth motion; 1 of the upper envelope through impacts, errors of neighbouring
///             steps scatter.
/// Stability   for every h.
/// Dissipation none in flight for rho = 1, C = 0; grows as rho falls, for high frequencies first.
/// Memory      a0 and s0; both live through an impact.
/// Cost        one evaluation and one back-substitution a step, one more at an impact with its
///             complementarity problem; one factorization.
/// Source      Q.-Z. Chen, V. Acary, G. Virlez, O. Bruls, Int. J. Numer. Methods Eng. 96, 487-511
///             (2013).
struct NonsmoothGeneralizedAlpha {
  static constexpr std::string_view name = "nonsmooth-generalized-alpha";
  static constexpr std::string_view summary =
      "generalised-alpha in flight, impulses at the end of the step of an impact";
  static const std::vector<Field<NonsmoothGeneralizedAlpha>>& fields();

  double rho = 0.8;  ///< in [0, 1]; 1 for no dissipation

  /// Throws InputError for rho outside [0, 1].
  void validate() const;
  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
