#pragma once

#include "clackers/campaign/specification.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::campaign {

/// What a campaign takes. Runs, time and disk are estimates: of each case a few systems stand for all.
struct Plan {
  long long systems = 0, tasks = 0;
  double runs = 0.0;
  double seconds = 0.0;  ///< processor time [s]; 0 unless timed
  double bytes = 0.0;    ///< of the database
};

/// Of each case up to eight systems are prepared. With `timed` the shortest run of each method is made
/// on one of them, for ten seconds at most. Throws as solvers_of() does.
Plan plan_of(const Specification& specification, bool timed);

/// A quantity a row: what `clackers campaign plan` prints.
record::Sheet plan_sheet(const Plan& plan);

/// Runs beyond this are not started unasked.
inline constexpr double most_runs_unasked = 1e7;

/// Throws InputError (too-many-runs) with the estimate for a campaign of more runs.
void require_few_runs(const Specification& specification);

}  // namespace clackers::campaign
