#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clackers/campaign/specification.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/solvers/solver.hpp"

// The unit of work: one system with one method over its ladder.
namespace clackers::campaign {

/// Consecutive tasks [first, last).
struct TaskBlock {
  long long first = 0, last = 0;

  long long size() const { return last - first; }
  bool operator==(const TaskBlock&) const = default;
};

/// What a task leaves, in the columns of Tables without "task" and "run". A pure function of the
/// specification and the task's number, but for `seconds`.
struct TaskRows {
  long long task = 0;
  std::vector<record::Cell> subject;
  std::vector<std::vector<record::Cell>> runs;  ///< run 1 is the first of the coarsest level
  std::vector<double> seconds;                  ///< processor time of each run
};

/// The columns of a campaign's tables, taken from the one table of report/columns.hpp.
struct Tables {
  std::vector<record::Column>
      subjects;                      ///< task, system, set_NAME..., all columns of a subject's row
  std::vector<record::Column> runs;  ///< task, run, the columns that differ between runs, metrics
};
Tables tables_of(const Specification& specification);

/// The commands of a specification, ready to run; an entry for each method, empty for those of the
/// catalogue. Throws as solvers::subjects_of() does.
std::vector<std::optional<solvers::SolverSubject>> solvers_of(const Specification& specification);

class PreparedSystem;

/// Runs tasks one after another; keeps the last system prepared. For one thread.
class TaskRunner {
 public:
  /// Both must outlive the runner.
  TaskRunner(const Specification& specification,
             const std::vector<std::optional<solvers::SolverSubject>>& solvers);
  ~TaskRunner();
  TaskRunner(const TaskRunner&) = delete;
  TaskRunner& operator=(const TaskRunner&) = delete;

  /// The rows of a task; nothing when interrupted. A system that its case refuses and a method that
  /// refuses the system are finished tasks whose subject has the refusal.
  std::optional<TaskRows> run(long long task, const std::atomic<bool>* interrupt = nullptr);

 private:
  const Specification& specification_;
  const std::vector<std::optional<solvers::SolverSubject>>& solvers_;
  std::unique_ptr<PreparedSystem> prepared_;
};

}  // namespace clackers::campaign
