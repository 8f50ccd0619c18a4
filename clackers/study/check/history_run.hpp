#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/progress.hpp"
#include "clackers/study/record.hpp"

namespace clackers::study {

/// One history of a request before it is read.
struct HistoryTask {
  std::string file;
  std::string events;  ///< empty: none given
  double step = 0.0;   ///< of --steps [s], 0: not given
};

/// Reads one history and compares it with the case, all metrics included. `progress` is called with
/// the share of this file. Throws as check() does.
Run history_run(const HistoryTask& task, const std::vector<std::string>& columns,
                const cases::Case& problem, const CaseSummary& summary, const Progress& progress,
                const std::atomic<bool>* interrupt);

/// The step in a file's name: the number behind an "h" that begins a word, as in h0.01.csv,
/// run-h=1e-3.txt or disp_h0.005.out [s]. Nothing without one, and for 0.
std::optional<double> step_in_name(std::string_view path);

/// Adds to `file.notes` what follows from its other members and the score.
void add_notes(HistoryFile& file, const assess::RunScore& score, const CaseSummary& problem);

}  // namespace clackers::study
