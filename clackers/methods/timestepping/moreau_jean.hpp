#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/parameters.hpp"

namespace clackers::methods {

/// Moreau and Jean's time-stepping, with x_th = theta x1 + (1 - theta) x0 for x = u, v, f:
///
///     M (v1 - v0) + h C v_th + h K u_th + h p(u_th, v_th) = h f_th + B^T P
///     u1 = u0 + h v_th
///     0 <= b.v1 + eta b.v0 _|_ P >= 0    where g(u0 + h/2 v0) <= 0, else P = 0
///
/// The contact is thus decided by a predictor at half a step, and the impact happens somewhere in
/// the step. It is reported at the end of the step. Contacts with linearly dependent b that need
/// impulses in one step end the run.
///
/// Order       1 of the upper envelope; in smooth motion 2 for theta = 1/2, otherwise 1, and where
///             that error, of the size (theta - 1/2) h, is the larger one, errors lie on a line.
/// Stability   for every h.
/// Dissipation none in flight for theta = 1/2, C = 0; grows with theta.
/// Memory      none.
/// Cost        one evaluation and one back-substitution a step, one more at an impact with its
///             complementarity problem; one factorization.
/// Source      J. J. Moreau, Comput. Methods Appl. Mech. Eng. 177, 329-349 (1999).
struct MoreauJean {
  static constexpr std::string_view name = "moreau-jean";
  static constexpr std::string_view summary =
      "time-stepping with velocity impulses, impacts not located inside the step";
  static const std::vector<Field<MoreauJean>>& fields();

  double theta = 0.5;  ///< in [1/2, 1]; below 1/2 the method is unstable for every h

  /// Throws InputError for theta outside [1/2, 1].
  void validate() const;
  Facts facts() const;
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
