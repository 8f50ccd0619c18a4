#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/diagnose/observation.hpp"
#include "clackers/input/source.hpp"
#include "clackers/record/record.hpp"

namespace clackers::study {

/// One history of a request before it is read.
struct HistoryTask {
  input::Source file;
  input::Source events{};  ///< an empty path: none given
  /// Of --steps or of the command that wrote it [s], or its tolerance; 0: not given.
  double step = 0.0;
  bool step_is_tolerance = false;
  input::ResultChoice results{};
};

/// A history that was read and compared, or a failed run where it has NaN or infinite numbers
/// (not-finite). Its score's step is the one of the task, else the time between rows.
struct ComparedHistory {
  record::Run run;
  /// What diagnosis needs; nothing without the displacements of all masses. Its step is not set.
  std::optional<diagnose::Observation> observation;
};

/// Reads one history and compares it with the case, all metrics included. `progress` is called with
/// the share of this file. Throws as check() does.
ComparedHistory history_run(const HistoryTask& task, const std::vector<std::string>& columns,
                            const cases::Case& problem, const record::CaseSummary& summary,
                            const Progress& progress, const std::atomic<bool>* interrupt);

/// Adds to `file.notes` what follows from its other members and the score.
void add_notes(record::HistoryFile& file, const measure::RunScore& score,
               const record::CaseSummary& problem);

}  // namespace clackers::study
