#pragma once

#include <atomic>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/study/check/history/history_run.hpp"
#include "clackers/study/check/history/prepared_history.hpp"

namespace clackers::study {

/// The share of a history's work that reading it is, for progress.
inline constexpr double read_share = 0.4;

/// Compares a history with the reference: score, collisions, curves, what diagnosis needs, all
/// metrics and the notes that follow. Without the displacements of all masses only the score is
/// measured. `step` [s] is the level's. Calls `progress` with shares from read_share on. Throws Error
/// (interrupted) when asked to stop.
ComparedHistory measure(PreparedHistory history, double step, const cases::Case& problem,
                        const record::CaseSummary& summary, const Progress& progress,
                        const std::atomic<bool>* interrupt);

}  // namespace clackers::study
