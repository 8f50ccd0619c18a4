#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// The half-explicit time-discontinuous Galerkin scheme D1-minus, F = f(t) - C v - K u - p(u, v):
///
///     V  = v0 + h M^-1 (F0 + B^T p0)
///     u1 = u0 + h/2 (v0 + V)
///     v- = v0 + h/2 M^-1 [F0 + B^T p0 + F(t1, u1, V) + B^T p1]
///     v1 = v- + M^-1 B^T P
///     0 <= b.M^-1 (F + B^T p) _|_ p >= 0   p0 where g(u0) <= 0 and b.v0 = 0,
///                                          p1 where p0 > 0
///     0 <= b.v1 + eta b.v- _|_ P >= 0      at others with g(u1) <= 0
///
/// The gap stays negative by the motion since the impact. Impacts are reported at the end of the step.
///
/// Order       2 in smooth motion; 1 of the upper envelope through impacts, errors of neighbouring
///             steps scatter.
/// Stability   omega h <= 2 for C = 0, less with damping, which is explicit.
/// Dissipation none in flight for C = 0.
/// Memory      none.
/// Cost        two evaluations a step; an impact or a closed contact a complementarity problem.
/// Source      T. Schindler, V. Acary, Math. Comput. Simul. 95, 180-199 (2014); T. Schindler et al.,
///             Comput. Methods Appl. Mech. Eng. 290, 250-276 (2015).
struct D1Minus {
  static constexpr std::string_view name = "d1-minus";
  static constexpr std::string_view summary =
      "half-explicit time-discontinuous Galerkin scheme, impulses at the end of the step";

  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
