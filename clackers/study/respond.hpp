#pragma once

#include <memory>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/record.hpp"
#include "clackers/study/sheet.hpp"

namespace clackers::study {

/// Times at which a response is wanted: k step for k < count, or a list.
struct TimeGrid {
  double step = 0.0;  ///< [s]
  long long count = 0;
  double last = 0.0;  ///< when positive, the time of k = count - 1: rounding must not miss it [s]
  std::vector<double> times;  ///< used instead when not empty [s]

  /// The time number k of `size()` [s].
  double at(long long k) const;
  long long size() const;
};

/// `n` equally spaced times over [0, end], both ends included. Throws InputError unless
/// 2 <= n <= 1e9.
TimeGrid grid_of(long long n, double end);

/// The times k step up to `end`; `end` itself counts as one of them when only rounding parts it
/// from a whole number of steps. Throws InputError unless 0 < step <= end, or for more than 1e9
/// times.
TimeGrid grid_every(double step, double end);

/// The exact response, columns t,side,u1,v1,a1[,u2,v2,a2]. Where a time is the double nearest to a
/// collision two rows appear, side "-" then "+". The case must outlive the rows. Throws InputError
/// for a time outside [0, end], before any row.
std::unique_ptr<RowSource> respond(const cases::Case& which, const TimeGrid& grid);

/// All collisions up to the case's end:
/// k,t,u1,v1-,v1+[,v2-,v2+],impulse,energy_before,energy_after. The case must outlive the rows.
std::unique_ptr<RowSource> collisions(const cases::Case& which);

/// Exact displacements at `n` equally spaced times, for a picture. Throws InputError for n < 2.
Curve response_curve(const cases::Case& which, int n);

}  // namespace clackers::study
