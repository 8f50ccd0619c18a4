#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Newmark's average acceleration with an augmented Lagrangian for the gaps at the end of the step,
/// iterated by Uzawa's rule from L = 0:
///
///     M a1 + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
///     u1 = u0 + h/2 (v0 + v1),   v1 = v0 + h/2 (a0 + a1)
///     L <- max(0, L - eps g(u1))   until |change of L| <= eps tolerance
///
/// eps is `factor` over the largest sum of a row of |dg/dL|, so that the iteration converges for every
/// factor below 2, with 1 at once where one contact is closed. The limit is Newmark's method with a
/// position multiplier and gains energy at impacts as that one does: no law of restitution. Only
/// eta = 1 is accepted, which one expects of a method without dissipation.
///
/// Order       2 in smooth motion; none through impacts.
/// Stability   for every h in smooth motion; impacts add energy.
/// Dissipation none in flight for C = 0.
/// Memory      a0, contact included.
/// Cost        one evaluation and one back-substitution a step, and as many again in each iteration;
///             one factorization.
/// Source      J. C. Simo, T. A. Laursen, Comput. Struct. 42, 97-116 (1992).
struct AugmentedLagrangian {
  static constexpr std::string_view name = "augmented-lagrangian";
  static constexpr std::string_view summary =
      "average acceleration with the gap closed by Uzawa's iteration; gains energy at impacts";
  static const std::vector<Field<AugmentedLagrangian>>& fields();

  double factor = 1.0;       ///< in (0, 2)
  double tolerance = 1e-12;  ///< of the gap [m]; positive

  /// Throws InputError for parameters outside their ranges.
  void validate() const;
  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
