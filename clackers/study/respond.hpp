#pragma once

#include <memory>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/record.hpp"
#include "clackers/study/sheet.hpp"

namespace clackers::study {

/// Times at which a response is wanted: t0 + k step for k < count, or a list.
struct TimeGrid {
  double step = 0.0;            ///< [s]
  long long count = 0;
  std::vector<double> times;    ///< used instead when not empty [s]
};

/// `n` equally spaced times over [0, end], both ends included (n >= 2).
TimeGrid grid_of(long long n, double end);

/// The exact response, columns t,side,u1,v1,a1[,u2,v2,a2]. Where a time is the double nearest to a
/// collision two rows appear, side "-" then "+".
std::unique_ptr<RowSource> respond(const cases::Case& which, const TimeGrid& grid);

/// All collisions up to the case's end: k,t,u1,v1-,v1+[,v2-,v2+],impulse,energy_before,energy_after.
std::unique_ptr<RowSource> collisions(const cases::Case& which);

/// Exact displacements at `n` times, for a picture.
Curve response_curve(const cases::Case& which, int n);

}  // namespace clackers::study
