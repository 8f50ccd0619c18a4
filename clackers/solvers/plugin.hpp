#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/solvers/program.hpp"

// `clackers verify --plugin`: solvers of others in shared libraries, see clackers_solver.h. Every call
// of a library is made in a process of its own.
namespace clackers::solvers {

/// A plug-in to assess.
struct Plugin {
  std::string library;  ///< path of the shared library
  std::string name;  ///< in every output; empty: its own, or its file without folder and extension
};

/// What plug-ins are asked for. `tolerances` are the levels of those that refine by tolerance.
struct PluginRequest : ProcessOptions {
  std::vector<Plugin> plugins;
  /// The program and its first arguments that call host_plugin() with the arguments behind them.
  std::vector<std::string> host;
};

/// The plug-ins as verify() takes solvers. A run fails where a function of the library fails, where it
/// crashes, ends its process or passes the time limit, and by states that are none. Throws InputError
/// (not-a-plugin) for a library that cannot be loaded or has no solver of a known version, FileError
/// for one that cannot be read and where the folder of runs cannot be made. A library that crashes
/// while it is loaded is a subject whose runs fail.
std::vector<SolverSubject> subjects_of(const PluginRequest& request,
                                       const std::atomic<bool>* interrupt = nullptr);

/// The work of the process: loads the library, calls it, and writes what came of it to files that
/// subjects_of() named in `arguments`. False where something failed, which a file then says. The
/// caller has set signals and std::terminate to their defaults, so that a crash is one.
bool host_plugin(const std::vector<std::string>& arguments);

}  // namespace clackers::solvers
