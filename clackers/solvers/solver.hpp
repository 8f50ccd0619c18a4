#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/input/source.hpp"
#include "clackers/record/record.hpp"

// Solvers of others under test: a program or a callable. Each makes a history for each
// step or tolerance, and is judged by its histories.
namespace clackers::solvers {

/// One run of a solver.
struct SolverRun {
  double step = 0.0;       ///< [s]
  long long steps = 0;     ///< from the start to the end
  double tolerance = 0.0;  ///< of an adaptive solver; 0: none
};

/// What a run left.
struct SolverOutput {
  bool interrupted = false;
  std::optional<input::Source> history;  ///< nothing: the run failed
  std::optional<input::Source> events;   ///< nothing: none reported
  std::string failure_code;              ///< "program-failed", "program-timeout", ...
  std::string failure;                   ///< in a sentence, with its full stop
  std::string printed;                   ///< the last bytes that it printed
  bool reused = false;                   ///< of an earlier run
  double seconds = 0.0;                  ///< user time of the whole program [s]; 0: not known
  bool would_repeat = false;             ///< the failure is one that smaller steps share
  std::shared_ptr<const void> memory{};  ///< what holds the columns of history and events
};

/// A solver prepared for one case.
class Solver {
 public:
  virtual ~Solver() = default;
  /// The runs that will be asked for, before the first of them: for a solver that makes several at once.
  virtual void expect(std::vector<SolverRun>) {}
  /// Makes a run. May be called from several threads at once.
  virtual SolverOutput run(const SolverRun& run, const std::atomic<bool>* interrupt) = 0;
};

/// A solver to assess, before it is prepared.
struct SolverSubject {
  record::SubjectKind kind = record::SubjectKind::program;  ///< program or callable
  std::string name;                                         ///< in every output
  Claim claim;
  record::Labels labels{};  ///< of its user
  /// Levels of tolerances, descending, instead of steps; {h} is then the coarsest step.
  std::vector<double> tolerances;
  /// Steps [s], descending, instead of those of the plan; refinement adds none.
  std::vector<double> steps;
  std::function<std::unique_ptr<Solver>(const cases::Case& problem)> prepare;
};

}  // namespace clackers::solvers
