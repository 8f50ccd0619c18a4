#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "clackers/study/candidate.hpp"
#include "clackers/study/refinement.hpp"

namespace clackers::study {

/// One candidate on one case: its ladder, which refinement may change, what was run of it, and the
/// verdict. The case must outlive it.
class SubjectStudy {
 public:
  /// `plan` is the first ladder; `of_shown_run` is wanted of one run of a method.
  SubjectStudy(const StudyCase& problem, std::unique_ptr<Candidate> candidate,
               const record::RefinementPlan& plan, const Wanted& of_shown_run = {});
  /// Without a candidate: all runs are taken, as the histories of check() are.
  SubjectStudy(const StudyCase& problem, record::Subject subject);

  const record::Subject& subject() const { return subject_; }
  const record::RefinementPlan& plan() const { return plan_; }
  bool is_serial() const { return facts_.is_serial; }
  double cost(const RunTask& task) const { return candidate_->cost(task); }
  /// The runs that make() will be asked for.
  void expect(std::span<const RunTask> tasks) { candidate_->expect(tasks); }

  /// The runs that a ladder needs and that were not made yet: of a method the longest first, of a
  /// solver the coarsest. The shown run is the first of the finest level that metrics can be measured
  /// on.
  std::vector<RunTask> missing(const record::RefinementPlan& plan) const;
  /// The runs that diagnosis needs again: some of the finest of a method whose errors do not fall as
  /// those of smooth motion do. Histories of others were observed when they were compared.
  std::vector<RunTask> to_observe() const;
  /// Time of these runs by that of a step of the finest runs so far, on so many threads [s].
  double expected_seconds(std::span<const RunTask> tasks, int threads = 1) const;

  /// Makes a run. From any thread. After three failures in a row that smaller steps would share, those
  /// are not made.
  void make(const RunTask& task, TaskShare& share, const std::atomic<bool>* interrupt);
  /// Takes a run that was made. From any thread.
  void take(const RunTask& task, Measured measured);

  /// Makes `plan` the ladder and judges it; the levels of a method that lack a run are left out. A
  /// subject that lacks a run is incomplete.
  void assess(const record::RefinementPlan& plan);
  /// Looks for causes in the runs of to_observe().
  void explain();
  /// next_plan() of the subject; nothing for levels of its own. Of a solver also where nothing is
  /// claimed and the behaviour is open.
  NextPlan next() const;
  /// Ends refinement; `next_seconds` is what did not fit into the budget.
  void close(record::RefinementEnd end, double next_seconds = 0.0);
  bool is_closed() const { return is_closed_; }

  /// The subject with its runs, which are moved from, and with what the ends of a method's runs say
  /// without the reference.
  record::Subject finish();

 private:
  struct Made {
    solvers::SolverRun run;
    Measured measured;
  };
  // By resolution, coarsest first; several histories may have one.
  using Runs = std::multimap<double, Made, std::greater<>>;
  struct PlannedLevel {
    double nominal = 0.0;
    std::vector<solvers::SolverRun> runs;
  };
  struct Level {
    double nominal = 0.0;
    std::vector<Made*> runs;  // in runs_
  };

  bool is_method() const { return subject_.kind == record::SubjectKind::method; }
  bool by_tolerance() const {
    return subject_.refined_by == record::RefinementParameter::tolerance;
  }
  std::vector<PlannedLevel> planned(const record::RefinementPlan& plan) const;
  void group();
  void decide();
  std::optional<measure::SharedImpacts> shared_impacts() const;
  std::optional<record::SelfResult> self_convergence() const;

  const StudyCase& problem_;
  std::unique_ptr<Candidate> candidate_;
  CandidateFacts facts_;
  record::Subject subject_;  // without levels until finish()
  record::RefinementPlan first_{0.0, 0, 0}, plan_{0.0, 0, 0};
  Wanted of_shown_run_{};
  std::vector<Level> levels_;
  measure::Ladder ladder_;  // of levels_
  bool is_closed_ = false;

  std::mutex guard_;  // of what follows, while runs are made
  Runs runs_;
  std::vector<diagnose::Observation> observations_;
  int repeated_ = 0;           // runs in a row whose failure smaller steps share
  record::Run last_repeated_;  // the last of them
};

}  // namespace clackers::study
