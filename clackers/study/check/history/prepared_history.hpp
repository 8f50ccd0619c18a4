#pragma once

#include <optional>

#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/input/history.hpp"
#include "clackers/record/record.hpp"
#include "clackers/study/check/history/history_run.hpp"

namespace clackers::study {

/// A history that belongs to its case: its rows, and what is known of them before the comparison.
struct PreparedHistory {
  input::History data;  ///< rows up to the end of the case, times from --steps where it has none
  record::HistoryFile file;  ///< without what the comparison adds
  bool has_all_u = true;     ///< displacements of all masses are known
};

/// Sets times, leaves rows after the end of the case out, finds what printing hides, and compares
/// the first row with the case's. Throws InputError as check() does for times outside the case and
/// another start.
PreparedHistory prepare(const HistoryTask& task, input::History data, const cases::Case& problem,
                        const record::CaseSummary& summary);

}  // namespace clackers::study
