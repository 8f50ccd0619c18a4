#pragma once

#include <atomic>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/input/history.hpp"
#include "clackers/input/source.hpp"
#include "clackers/record/record.hpp"
#include "clackers/study/check/history/history_run.hpp"

namespace clackers::study {

/// A history that belongs to its case: its rows, and what is known of them before the comparison.
struct PreparedHistory {
  input::History data;  ///< rows up to the end of the case, times from --steps where it has none
  record::HistoryFile file;  ///< without what the comparison adds
  bool has_all_u = true;     ///< displacements of all masses are known
};

/// Throws InputError (not-this-case) for a column of the displacement of one mass more than the history was read for.
void require_masses(const std::string& name, const input::History& history);

/// Sets times, leaves rows after the end of the case out, finds what printing hides, and compares
/// the first row with the case's. Throws InputError as check() does for more masses, times outside the case
/// and another start.
PreparedHistory prepare(const HistoryTask& task, input::History data, const cases::Case& problem);

/// Refuses times (time-unit) of which a tenth at most, `kept`, is within the run, and whose last one is in
/// thousandths or millionths of a second within it, not before its part `least_part`.
void require_seconds(const std::string& name, double last, double kept, double least_part,
                     const cases::Case& problem);

/// Reads the impacts of a history; those outside it are left out, with a note. Where two masses
/// touch, the place of one gives that of the other. Throws as input::read_events() does, and for times
/// that are not in seconds.
void add_events(PreparedHistory& history, const input::Source& events, const cases::Case& problem,
                const std::atomic<bool>* interrupt);

/// Displacements that the history has not are those of the reference, so that they add no error.
void complete_u(PreparedHistory& history, const cases::Case& problem);

/// The share of a history's work that reading it is, for progress.
inline constexpr double read_share = 0.4;

/// Compares a history with the reference: score, impacts, curves, what diagnosis needs, all
/// metrics and the notes that follow. Without the displacements of all masses only the score is
/// measured. `step` [s] is the level's. Calls `progress` with shares from read_share on. Throws Error
/// (interrupted) when asked to stop.
ComparedHistory measure(PreparedHistory history, double step, const cases::Case& problem,
                        const record::CaseSummary& summary, const Progress& progress,
                        const std::atomic<bool>* interrupt);

}  // namespace clackers::study
