#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/study/progress.hpp"
#include "clackers/study/record.hpp"
#include "clackers/study/verify.hpp"

// `clackers verify --exec`: methods that are programs of others.
namespace clackers::study {

/// A program to assess.
struct Program {
  /// For the shell, with placeholders: {case} and {case:text} are files with the problem, {h} the
  /// step [s], {n} the number of steps, {tolerance} one of the request's tolerances, {events} a file
  /// for collisions, which may be left out, {out} the file for the history; without {out} the
  /// history is standard output.
  std::string command;
  std::string name;  ///< in every output; empty: the program's file without folder and extension
};

/// What verify() is asked for beside methods.
struct ProgramRequest {
  std::vector<Program> programs;
  std::optional<Claim> expect;  ///< of every program
  /// Each a level for commands with {tolerance}, whose {h} is the coarsest step; empty:
  /// 1e-3, 1e-4, ..., 1e-10.
  std::vector<double> tolerances;
  double timeout = 60.0;  ///< of a run [s], > 0
  std::string work;       ///< folder to keep the runs in; empty: the user's cache
  bool fresh = false;     ///< runs that were made before are made again
};

/// The default ladder of programs, whose runs cost a start each.
inline constexpr int default_program_levels = 6, default_program_samples = 4;

/// As verify(), with programs behind the methods; no methods means none. A run that fails (crash,
/// time limit, exit status, no history, one that cannot be read) is a failed run of its step with
/// what it printed. After three runs in a row that could not be started or passed the time limit,
/// those of smaller steps are not made. Throws as verify() does, for commands that CommandTemplate refuses and
/// for two subjects of one name; FileError where the folder of runs cannot be written.
Record verify(const VerifyRequest& request, const ProgramRequest& programs,
              const Progress& progress = {}, const std::atomic<bool>* interrupt = nullptr);

/// The failure of the first run, where every run of every subject failed and some subject is a
/// program; nullptr otherwise.
const Run* failure_of_all(const Record& record);

/// "1e-3:1e-12" (a tolerance a decade, both ends included) or "1e-3,1e-6": descending tolerances in
/// (0, 1]. Throws InputError for any other text.
std::vector<double> tolerances_from(std::string_view text);

}  // namespace clackers::study
