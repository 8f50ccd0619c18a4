#pragma once

#include <atomic>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "clackers/study/check/history_set.hpp"
#include "clackers/study/program.hpp"
#include "clackers/study/program/program_runner.hpp"
#include "clackers/study/refinement.hpp"

namespace clackers::study {

/// One program on one case: its ladder, which refinement may change, and the runs made of it.
class ProgramStudy {
 public:
  /// `plan` is the first ladder, of steps; its coarsest step is {h} where `tolerances` is not empty.
  ProgramStudy(ProgramRunner runner, std::string name, cases::Case problem, CaseSummary summary,
               const RefinementPlan& plan, std::vector<double> tolerances, const Claim& claim,
               const std::atomic<bool>* interrupt);

  /// The runs that a ladder needs and that were not made yet, coarsest first.
  std::vector<ProgramRun> missing(const RefinementPlan& plan) const;
  /// Makes a run and compares its history. From any thread.
  void make(const ProgramRun& run);
  /// Expected time of these runs by that of a step of the longest run so far [s].
  double expected_seconds(const std::vector<ProgramRun>& runs) const;

  /// Assesses all runs; `plan` is the ladder that they belong to.
  void assess(const RefinementPlan& plan);
  /// The next ladder: next_plan(), also where nothing is claimed and the behaviour is open; none for
  /// tolerances.
  NextPlan next() const;
  void close(RefinementEnd end, double next_seconds = 0.0);
  bool is_closed() const { return is_closed_; }
  const RefinementPlan& plan() const { return plan_; }
  Subject finish() { return std::move(subject_); }

 private:
  void take(const ProgramRun& run, const ProgramOutput& output);
  void add_failed(const ProgramRun& run, std::string code, std::string sentence,
                  std::string printed);
  bool skipped(const ProgramRun& run);
  double resolution(const ProgramRun& run) const;

  ProgramRunner runner_;
  HistorySet histories_;
  const RefinementPlan asked_;
  RefinementPlan plan_;
  std::vector<double> tolerances_;
  const std::atomic<bool>* interrupt_;
  Subject subject_;
  bool is_closed_ = false;

  std::mutex guard_;             // of what follows
  std::set<long long> made_;     // numbers of steps
  int repeated_ = 0;             // runs in a row whose failure smaller steps share
  ProgramOutput last_repeated_;  // the last of them
  long long longest_ = 0;        // steps of the longest run that was timed
  double longest_seconds_ = 0.0;
  bool is_interrupted_ = false;
};

}  // namespace clackers::study
