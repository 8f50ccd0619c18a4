#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "clackers/study/check/history_set.hpp"
#include "clackers/study/refinement.hpp"
#include "clackers/study/solver.hpp"

namespace clackers::study {

/// One solver on one case: its ladder, which refinement may change, and the runs made of it.
class SolverStudy {
 public:
  /// `plan` is the first ladder, of steps; where the subject has tolerances, its coarsest step goes
  /// with each of them.
  SolverStudy(const SolverSubject& asked, cases::Case problem, record::CaseSummary summary,
              const record::RefinementPlan& plan, const std::atomic<bool>* interrupt);

  /// The runs that a ladder needs and that were not made yet, coarsest first.
  std::vector<SolverRun> missing(const record::RefinementPlan& plan) const;
  /// Makes a run and compares its history. From any thread.
  void make(const SolverRun& run);
  /// Expected time of these runs by that of a step of the longest run so far [s].
  double expected_seconds(const std::vector<SolverRun>& runs) const;

  /// Assesses all runs; `plan` is the ladder that they belong to.
  void assess(const record::RefinementPlan& plan);
  /// The next ladder: next_plan(), also where nothing is claimed and the behaviour is open; none where the
  /// subject has levels of its own.
  NextPlan next() const;
  void close(record::RefinementEnd end, double next_seconds = 0.0);
  record::SubjectKind kind() const { return asked_.kind; }
  const record::RefinementPlan& plan() const { return plan_; }
  record::Subject finish() { return std::move(subject_); }

 private:
  void take(const SolverRun& run, const SolverOutput& output);
  void add_failed(const SolverRun& run, std::string code, std::string sentence,
                  std::string printed);
  bool skipped(const SolverRun& run);
  double resolution(const SolverRun& run) const;

  bool by_tolerance() const { return !asked_.tolerances.empty(); }

  const SolverSubject& asked_;
  std::unique_ptr<Solver> solver_;
  HistorySet histories_;
  const record::RefinementPlan first_;
  record::RefinementPlan plan_;
  const std::atomic<bool>* interrupt_;
  record::Subject subject_;

  std::mutex guard_;            // of what follows
  std::set<long long> made_;    // numbers of steps
  int repeated_ = 0;            // runs in a row whose failure smaller steps share
  SolverOutput last_repeated_;  // the last of them
  long long longest_ = 0;       // steps of the longest run that was timed
  double longest_seconds_ = 0.0;
  bool is_interrupted_ = false;
};

}  // namespace clackers::study
