#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/solvers/command_template.hpp"
#include "clackers/solvers/program.hpp"
#include "clackers/solvers/work_folder.hpp"

namespace clackers::solvers {

/// Runs one program on one case. run() may be called from several threads.
class ProgramRunner : public Solver {
 public:
  ProgramRunner(CommandTemplate command, std::string name, const cases::Case& test_case,
                const ProcessOptions& options, std::shared_ptr<WorkFolder> folder);

  /// What SolverSubject::prepare calls.
  static std::function<std::unique_ptr<Solver>(const cases::Case&)> maker(
      const CommandTemplate& command, const std::string& name, const ProcessOptions& options,
      const std::shared_ptr<WorkFolder>& folder);

  /// The result of an earlier run of the same command, with the same files of the program, problem,
  /// step and tolerance, if there is one; else that of a new run in a folder of its own, which holds
  /// problem.json and problem.txt. A folder that cannot be written is a failed run.
  SolverOutput run(const SolverRun& run, const std::atomic<bool>* interrupt) override;
  /// Of a command that makes all runs of a ladder in one process, what it makes then.
  void expect(std::vector<SolverRun> runs) override;

 private:
  std::string command_in(const std::filesystem::path& folder, const SolverRun& run) const;
  std::string title_of(const SolverRun& run) const;
  std::string key_of(const SolverRun& run) const;
  std::optional<SolverOutput> found(const SolverRun& run) const;
  SolverOutput output_of(const SolverRun& run, const RunFolder& mine,
                         const std::atomic<bool>* interrupt) const;
  void write_problem(const RunFolder& mine) const;
  void finish(SolverOutput& output, RunFolder& mine, const SolverRun& run) const;
  void make_all(std::vector<SolverRun> runs, const std::atomic<bool>* interrupt);

  CommandTemplate command_;
  std::string title_;  ///< of the folders: name and case
  std::string json_, text_;
  double timeout_;
  bool fresh_;
  std::vector<std::string> environment_;
  std::shared_ptr<WorkFolder> folder_;

  std::mutex guard_;  // of what one process makes for several runs
  std::vector<SolverRun> expected_;
  std::map<double, SolverOutput> made_;  // by step or tolerance
};

}  // namespace clackers::solvers
