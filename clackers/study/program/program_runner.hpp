#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>

#include "clackers/model/impact_problem.hpp"
#include "clackers/study/program/command_template.hpp"
#include "clackers/study/program/work_folder.hpp"

namespace clackers::study {

/// One run of a program.
struct ProgramRun {
  double step = 0.0;       ///< {h} [s]
  long long steps = 0;     ///< {n}
  double tolerance = 0.0;  ///< {tolerance}; 0: none
};

/// What a run left.
struct ProgramOutput {
  bool interrupted = false;
  std::filesystem::path history;  ///< empty: the run failed
  std::filesystem::path events;   ///< empty: none written
  std::string failure_code;       ///< "program-failed", "program-timeout", "program-output"
  std::string failure;            ///< in a sentence, with its full stop
  std::string printed;            ///< the last bytes that it printed; empty for a reused run
  bool reused = false;
  bool would_repeat = false;  ///< the failure is one that smaller steps share
};

/// Runs one program on one case. run() may be called from several threads.
class ProgramRunner {
 public:
  /// `timeout` of a run [s]; `fresh`: earlier runs are not reused. `folder` must outlive the runner.
  ProgramRunner(CommandTemplate command, std::string name, std::string_view case_name,
                const model::ImpactProblem<>& problem, double timeout, bool fresh,
                WorkFolder& folder);

  /// The result of an earlier run of the same command, with the same files of the program, problem,
  /// step and tolerance, if there is one; else that of a new run in a folder of its own, which holds
  /// problem.json and problem.txt. Throws FileError where the folder cannot be written.
  ProgramOutput run(const ProgramRun& run, const std::atomic<bool>* interrupt) const;

 private:
  std::string command_in(const std::filesystem::path& folder, const ProgramRun& run) const;
  ProgramOutput output_of(const ProgramRun& run, const std::filesystem::path& folder,
                          const std::atomic<bool>* interrupt) const;

  CommandTemplate command_;
  std::string title_;  ///< of the folders: name and case
  std::string json_, text_;
  double timeout_;
  bool fresh_;
  WorkFolder& folder_;
};

/// Sentences begin with a folder that has gone when they are read: its path is taken out of them.
std::string without_folder(std::string sentence, const std::filesystem::path& folder);

}  // namespace clackers::study
