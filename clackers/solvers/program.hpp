#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/solvers/solver.hpp"

// `clackers verify --exec`: methods that are programs of others.
namespace clackers::solvers {

/// The refusal of shared libraries, which earlier versions loaded.
inline constexpr std::string_view instead_of_plugin =
    "plugin: shared libraries are no longer loaded. Compile the solver with clackers_main.h and give "
    "the program as exec: './solver {case:text} {n} {out}'.";

/// A program to assess.
struct Program {
  /// For the shell, with placeholders: {case} and {case:text} are files with the problem, {h} the
  /// step [s], {n} the number of steps, {tolerance} one of the request's tolerances, {events} a file
  /// for impacts, which may be left out, {out} the file for the history; without {out} the
  /// history is standard output. A command with {runs} or {runs:tolerance} is run once for the whole
  /// ladder: a file with a line for each run, its step or tolerance, number of steps and history.
  std::string command;
  std::string name;  ///< in every output; empty: the program's file without folder and extension
  record::Labels labels{};
};

/// How programs are run.
struct ProcessOptions {
  std::optional<Claim> expect;  ///< of every one
  /// Each a level for solvers that refine by tolerance, whose step is the coarsest; empty:
  /// 1e-3, 1e-4, ..., 1e-10.
  std::vector<double> tolerances;
  double timeout = 60.0;  ///< of a run [s], > 0
  std::string work;       ///< folder to keep the runs in; empty: the user's cache
  bool fresh = false;     ///< runs that were made before are made again
  /// Variables of the environment on which runs depend: made again for other values of them.
  std::vector<std::string> environment{};
};

/// What programs are asked for. `tolerances` are the levels of commands with {tolerance}.
struct ProgramRequest : ProcessOptions {
  std::vector<Program> programs;
};

/// The programs as verify() takes solvers. A run fails by a crash, the time limit, an exit status
/// other than 0, no history, or one that cannot be read. Throws InputError for commands that
/// CommandTemplate refuses, FileError where the folder of runs cannot be made.
std::vector<SolverSubject> subjects_of(const ProgramRequest& request);

/// The tolerances of adaptive solvers and methods where none are asked for.
inline constexpr std::string_view default_tolerances = "1e-3:1e-10";

/// The tolerances that are asked for, or the default ones.
std::vector<double> tolerances_of(const ProcessOptions& options);

/// "1e-3:1e-12" (a tolerance a decade, both ends included) or "1e-3,1e-6": descending tolerances in
/// (0, 1]. Throws InputError for any other text.
std::vector<double> tolerances_from(std::string_view text);

}  // namespace clackers::solvers
