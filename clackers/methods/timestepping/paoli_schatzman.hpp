#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Paoli and Schatzman's central differences with restitution between displacements two steps apart,
/// for M a + C v + K u + p(u, v) = f(t) + B^T L:
///
///     M (u2 - 2 u1 + u0) / h² + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
///     v1 = (u2 - u0) / 2 h
///     0 <= (b.u2 + eta b.u0) / (1 + eta) - gap _|_ L >= 0   at every contact
///
/// The first step is that of Taylor's series. An impact takes two steps: its impulse is the sum of
/// both h L, reported at the second; a lasting contact is a row of such impacts. With eta = 0 at all
/// contacts it is forward-increment-lagrange, of another order: that one is to be used.
///
/// Order       2 in smooth motion; 1 through impacts, with errors on a line where others scatter, since
///             the impact ends at a time that is smooth in the step.
/// Stability   omega h <= 2.
/// Dissipation none in flight for C = 0.
/// Memory      u0, kept as acceleration and velocity.
/// Cost        one evaluation and one back-substitution a step, one more in both steps of an impact
///             with its complementarity problem; one factorization.
/// Source      L. Paoli, M. Schatzman, SIAM J. Numer. Anal. 40, 702-733 and 734-768 (2002).
struct PaoliSchatzman {
  static constexpr std::string_view name = "paoli-schatzman";
  static constexpr std::string_view summary =
      "central differences with restitution between displacements two steps apart";

  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
