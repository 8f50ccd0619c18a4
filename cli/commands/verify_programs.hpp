#pragma once

#include <string>
#include <vector>

#include "clackers/solvers/program.hpp"
#include "cli/command.hpp"

namespace clackers::cli {

/// The options of `verify` for programs of others.
struct ProgramOptions {
  std::vector<std::string> commands, names, labels, environment;
  std::string tolerances, expect, timeout, work;
  bool fresh = false;

  bool any() const { return !commands.empty(); }
};

/// Adds --exec and what goes with them. `options` must outlive the parsing.
void add_program_options(Command& command, ProgramOptions& options);

/// The programs. Throws InputError for values that cannot be read, and for options of programs without
/// any, and what subjects_of() throws.
std::vector<solvers::SolverSubject> program_subjects(const ProgramOptions& options);

/// Names the programs of which every run failed, and why.
void report_failed_solvers(const record::Record& record);

}  // namespace clackers::cli
