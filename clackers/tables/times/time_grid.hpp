#pragma once

#include <vector>

namespace clackers::tables {

/// Times at which a response is wanted: k step for k < count, or a list.
struct TimeGrid {
  double step = 0.0;  ///< [s]
  long long count = 0;
  double last = 0.0;  ///< when positive, the time of k = count - 1: rounding must not miss it [s]
  std::vector<double> times;  ///< used instead when not empty [s]

  /// The time number k of `size()` [s].
  double at(long long k) const;
  long long size() const;
  double latest() const;  ///< 0 without any [s]
};

/// `n` equally spaced times over [0, end], both ends included. Throws InputError unless
/// 2 <= n <= 1e9.
TimeGrid grid_of(long long n, double end);

/// The times k step up to `end`; `end` itself counts as one of them when only rounding parts it
/// from a whole number of steps. Throws InputError unless 0 < step <= end, or for more than 1e9
/// times.
TimeGrid grid_every(double step, double end);

}  // namespace clackers::tables
