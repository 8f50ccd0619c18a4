#pragma once

#include <string>
#include <vector>

#include "clackers/solvers/program.hpp"
#include "cli/command.hpp"

namespace clackers::cli {

/// The options of `verify` for programs of others.
struct ProgramOptions {
  std::vector<std::string> commands, names;
  std::string tolerances, expect, timeout, work;
  bool fresh = false;

  bool any() const { return !commands.empty(); }
};

/// Adds --exec and what goes with them. `options` must outlive the parsing.
void add_program_options(Command& command, ProgramOptions& options);

/// The programs. Throws InputError for values that cannot be read, and for options of programs without
/// any, and what subjects_of() throws.
std::vector<study::SolverSubject> program_subjects(const ProgramOptions& options);

/// The ladder of a study with programs: shorter where nothing else is asked for.
study::RefinementRequest program_plan(study::RefinementRequest plan, bool has_neighbours);

/// 4, with a message, where every run of all programs failed; else `exit_code`.
int exit_code_of_programs(const record::Record& record, int exit_code);

}  // namespace clackers::cli
