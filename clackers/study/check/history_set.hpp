#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clackers/assess/convergence/judge.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/study/check/history_run.hpp"
#include "clackers/study/progress.hpp"
#include "clackers/study/record.hpp"

namespace clackers::study {

/// The histories of one solver at several steps or tolerances, from files or from a program's runs,
/// and their assessment. `read` and `add_failed` may be called from several threads at once.
class HistorySet {
 public:
  /// `columns` are the names of the files' columns, empty for those of the files.
  HistorySet(cases::Case problem, CaseSummary summary, std::vector<std::string> columns = {},
             const std::atomic<bool>* interrupt = nullptr);

  const cases::Case& problem() const { return problem_; }
  const CaseSummary& summary() const { return summary_; }

  /// Adds a history. One with NaN or infinite numbers is a failed run of its step (not-finite).
  /// Throws as check() does for any other file that cannot be read or compared.
  void read(const HistoryTask& task, const Progress& progress = {});

  /// Adds a run that left no history: its step [s] or tolerance, the code and the sentence of the
  /// failure, and the last lines that it printed.
  void add_failed(double step, std::string code, std::string sentence, std::string printed = {});

  /// Sorts the runs into levels, judges them and looks for causes. `by_tolerance`: steps of the
  /// runs are tolerances. Call once, when all runs are there. Throws InputError where every history
  /// that was read is not finite, and for several histories of one step.
  Subject assess(SubjectKind kind, std::string name, const Claim& claim,
                 std::optional<double> tolerance = {}, bool by_tolerance = false);

 private:
  struct Entry {
    ComparedHistory history;
    std::optional<double> named_step;
  };
  void add(Entry entry);
  void choose_steps();
  assess::Facts facts(const Subject& subject) const;
  std::vector<diagnose::Diagnosis> diagnoses(const Subject& subject);

  cases::Case problem_;
  CaseSummary summary_;
  std::vector<std::string> columns_;
  const std::atomic<bool>* interrupt_;
  std::mutex guard_;
  std::vector<Entry> entries_;
  std::optional<InputError> refusal_;                ///< of the first history that is not finite
  std::vector<diagnose::Observation> observations_;  ///< coarsest first
  std::optional<HistoryFile> finest_;                ///< of the finest finished history
};

}  // namespace clackers::study
