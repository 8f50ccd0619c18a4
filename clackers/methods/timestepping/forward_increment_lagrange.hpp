#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Forward-increment Lagrange multipliers with central differences: the forces L at t1 are those that
/// close, at the end of the next step, the contacts that the free motion would penetrate:
///
///     M (u2 - 2 u1 + u0) / h² + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
///     v1 = (u2 - u0) / 2 h
///     0 <= b.u2 - gap _|_ L >= 0          at every contact
///
/// It has no law of restitution: masses stay together after the contact, which is restitution 0.
/// With several contacts the signs of L follow from the complementarity and not from iterations over
/// contacts, and the scheme is that of Paoli and Schatzman for eta = 0. An impact takes two steps; its
/// impulse is the sum of both h L, reported at the second. A lasting contact is a row of such
/// impacts.
///
/// Order       2 in smooth motion, and in displacement through impacts with eta = 0, since the gap is
///             closed at the end of the step of the impact; 1 in velocity there.
/// Stability   omega h <= 2.
/// Dissipation none in flight for C = 0.
/// Memory      u0, kept as acceleration and velocity.
/// Cost        one evaluation and one back-substitution a step, one more in contact with a
///             complementarity problem; one factorization.
/// Source      N. J. Carpenter, R. L. Taylor, M. G. Katona, Int. J. Numer. Methods Eng. 32, 103-128
///             (1991).
struct ForwardIncrementLagrange {
  static constexpr std::string_view name = "forward-increment-lagrange";
  static constexpr std::string_view summary =
      "central differences with multipliers that close the gap in the next step; for eta = 0";

  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
