#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/diagnose/observation.hpp"
#include "clackers/measure/errors/meter.hpp"
#include "clackers/measure/errors/shared_states.hpp"
#include "clackers/measure/impacts/shared_impacts.hpp"
#include "clackers/record/record.hpp"
#include "clackers/solvers/solver.hpp"

namespace clackers::study {

class SharedRuns;

/// A case under study.
struct StudyCase {
  cases::Case problem;
  record::CaseSummary summary;
  std::vector<measure::SharedInstant> shared;     ///< those of the reference
  double closest_impacts = 0.0;                   ///< of the reference [s]
  std::shared_ptr<measure::SharedStates> states;  ///< of the reference; may be null
  std::shared_ptr<const measure::Scales> scales;  ///< of errors; may be null
  std::shared_ptr<SharedRuns> runs;               ///< of methods that run alike; may be null
};

StudyCase study_case(cases::Case problem);

/// What is made of a run beside its errors.
struct Wanted {
  int history_bins = 0;      ///< of the error against time, 0 for none
  bool metrics = false;      ///< measure all of them: the run is stored whole
  bool observation = false;  ///< only what diagnosis needs, of a run that was made before
};

/// A run to make.
struct RunTask {
  solvers::SolverRun run;  ///< of an adaptive method `steps` are those to expect
  Wanted wanted{};

  /// The step [s] or the tolerance.
  double resolution() const { return run.tolerance > 0.0 ? run.tolerance : run.step; }
};

/// What a run gave.
struct Measured {
  record::Run run{};
  /// Displacements at the end over the largest envelopes, for self-convergence; empty for none.
  std::vector<double> end_u{};
  std::optional<diagnose::Observation> observation{};
  double seconds = 0.0;       ///< time of the assessment [s]; 0: not known, as of a reused run
  bool would_repeat = false;  ///< the failure is one that smaller steps share
};

/// What is known of a candidate before its runs.
struct CandidateFacts {
  record::Subject subject{};  ///< kind, name, claim, resolution, contact time and refusal
  /// Levels of its own, descending, instead of those of a plan: tolerances where the subject is
  /// resolved by them, else steps [s].
  std::vector<double> levels{};
  /// Order of a method in smooth motion. An adaptive one is expected to take
  /// 2.5 tolerance^(-1/order) steps a fast period; a solver takes the coarsest step of the plan.
  double order = 0.0;
  bool is_serial = false;  ///< its runs are made one at a time
  bool has_ends = false;   ///< its runs keep end_u
};

/// What is judged by its runs on one case: a method, a program or a callable.
class Candidate {
 public:
  virtual ~Candidate() = default;
  virtual CandidateFacts facts() const = 0;
  /// The runs that will be asked for, before the first of them.
  virtual void expect(std::span<const RunTask>) {}
  /// Work to expect. Only the progress shown depends on it.
  virtual double cost(const RunTask& task) const = 0;
  /// Makes a run and compares it with the reference. Nothing when interrupted. May be called from
  /// several threads at once, unless the candidate is serial.
  virtual std::optional<Measured> run(const RunTask& task, TaskShare& share,
                                      const std::atomic<bool>* interrupt) = 0;
};

}  // namespace clackers::study
