#pragma once

#include <string_view>
#include <vector>

#include "clackers/methods/integrators/newmark.hpp"

namespace clackers::methods {

/// Central difference in its one-step form, velocity at the end of the step:
///
///     u1 = u0 + h v0 + h²/2 a0
///     v1 = v0 + h/2 (a0 + a1)
///     M a1 + C v1 + K u1 + p(u1, v1) = f(t0 + h)
///
/// This is Newmark's method with beta = 0, gamma = 1/2: explicit in u, implicit in C. The same u as
/// the two-step form (M/h² + C/2h) u1 = f - K u0 + M (2 u0 - u_-1)/h² + C u_-1/2h.
///
/// Order       2.
/// Stability   omega h <= 2.
/// Dissipation none for C = 0.
/// Memory      a0, taken from the last step; computed anew by restart().
/// Cost        one back-substitution a step; one factorization of M + h/2 C for each (system, h).
/// Source      N. M. Newmark, J. Eng. Mech. Div. ASCE 85 (EM3), 67-94 (1959), with beta = 0.
struct CentralDifference {
  static constexpr std::string_view name = "central-difference";
  static constexpr std::string_view summary =
      "explicit central difference with the velocity at the end of the step";
  static const std::vector<Field<CentralDifference>>& fields();

  void validate() const {}
  Facts facts() const;

  template <int Dof>
  class Stepper : public Newmark::Stepper<Dof> {
   public:
    Stepper(const CentralDifference&, const model::SmoothSystem<Dof>& system, double h)
        : Newmark::Stepper<Dof>({.beta = 0.0, .gamma = 0.5}, system, h, name) {}
  };
};

}  // namespace clackers::methods
