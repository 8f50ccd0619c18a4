#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/study/check/history/history_run.hpp"
#include "clackers/study/check/named_resolution.hpp"

namespace clackers::study {

/// The histories of one solver at several steps or tolerances, from files, from memory or from a
/// program's runs, and their assessment. `read` and `add_failed` may be called from several threads
/// at once.
class HistorySet {
 public:
  /// `columns` are the names of the files' columns, empty for those of the files.
  HistorySet(cases::Case problem, record::CaseSummary summary,
             std::vector<std::string> columns = {}, const std::atomic<bool>* interrupt = nullptr);

  const cases::Case& problem() const { return problem_; }
  const record::CaseSummary& summary() const { return summary_; }

  /// Adds a history. One with NaN or infinite numbers is a failed run of its step (not-finite).
  /// Throws as check() does for a file that cannot be read or compared.
  void read(const HistoryTask& task, const Progress& progress = {});

  /// Adds a run that left no history: its step [s] or tolerance, the code and the sentence of the
  /// failure, and the last lines that it printed.
  void add_failed(double step, std::string code, std::string sentence, std::string printed = {});

  /// Sorts the runs into levels, judges them and looks for causes. `by_tolerance`: the steps of the
  /// tasks and of failed runs are tolerances; names of files may say it, too. May be called again
  /// after more runs. Throws InputError for several histories of one step and, unless the subject is
  /// a solver, where every history is not finite.
  record::Subject assess(record::SubjectKind kind, std::string name, const Claim& claim,
                         std::optional<double> tolerance = {}, bool by_tolerance = false);

 private:
  struct Entry {
    record::Run run;
    NamedResolution named;
    bool step_is_given = false;
    std::optional<std::size_t> observation{};  ///< index into observations_
  };
  void add(Entry entry, std::optional<diagnose::Observation> observation);
  void choose_steps(record::Resolution& resolution);

  cases::Case problem_;
  record::CaseSummary summary_;
  std::vector<std::string> columns_;
  const std::atomic<bool>* interrupt_;
  std::mutex guard_;
  std::vector<Entry> entries_;
  std::vector<diagnose::Observation> observations_;
};

}  // namespace clackers::study
