#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/judge/convergence/self_convergence.hpp"

namespace clackers::judge {

/// An extrapolated value with its bound, or the reason why there is none.
struct Richardson {
  bool bounded = false;       ///< false: the numbers below mean nothing
  std::string reason;         ///< code, empty when bounded
  std::vector<double> value;  ///< R = U_{j+1} + (U_{j+1} - U_j) / (r^q - 1), unit of the values
  double bound = 0.0;         ///< of max |R - limit|, same unit, rounding of both runs included
  std::optional<double> estimate;  ///< of the same, from the order of the next term
  int level = 0;  ///< zero-based, of the finer run: the last one of the proper range
};

/// Extrapolates runs of order q = context.claimed_order, coarsest first, and bounds the result:
///
///     |R - limit| <= |U_{j+1} - U_j| / (r^q - 1),   and  ~ |R_j - R_{j-1}| / (r^q' - 1)
///
/// The bound holds for the limit of the sequence, which is the true motion only where the model is.
/// It is given only while the sequence is proper: self_convergence finds the order q over at least
/// four differences, and each of the last four, d, departs from the r^-q fold of the one
/// before by no more than (1 - rho) / (1 + rho) of it, rho = r^-q. (While departures theta stay so
/// small, |d_{j+m} - rho^m d_j| <= rho^m ((1 + theta)^m - 1) |d_j|; summed over m this is at most
/// rho / (1 - rho) |d_j|, the bound.) Otherwise `reason` is "run-failed", "too-few-levels",
/// "improper-convergence", or "differences-turn": an error whose sign flips at each level has differences of
/// the very order, and an extrapolation worse than the finer run.
///
/// `next_order` q' > q is the order of the next term, for the estimate.
///
/// Throws InputError without a claimed order, for next_order <= q, and as self_convergence does.
Richardson extrapolate(std::span<const Response> runs, const SelfContext& context,
                       std::optional<double> next_order = {});

/// The largest departure of a difference from the rho fold of the one before it, relative to that.
constexpr double largest_departure(double rho) { return (1.0 - rho) / (1.0 + rho); }

}  // namespace clackers::judge
