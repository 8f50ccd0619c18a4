#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/campaign/store.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"

// Physics engines and solvers of others, each a folder with engine.toml and one program.
namespace clackers::campaign {

/// One way to run an engine.
struct EngineSetting {
  std::string name;    ///< "default", "tuned"
  std::string words;   ///< behind the command
  std::string why;     ///< what is set, and why
  std::string expect;  ///< "proper:2"; empty: nothing is claimed
};

/// What an engine shows, one command each: scripts/engines measures it.
struct EngineFact {
  std::string text, setting, case_word;  ///< "stop:eta=0.7"
};

/// What engine.toml says. `{folder}` in `version`, `build` and `command` is the engine's folder, and
/// `{program}` the file that `build` makes.
struct Engine {
  std::string id;      ///< of the folder: "bullet"
  std::string folder;  ///< absolute
  std::string name, integrates, licence;
  std::vector<std::string> debian;  ///< packages
  std::string npm;                  ///< package
  std::string version;              ///< prints the version; fails where the engine is not installed
  std::string build;                ///< empty: nothing is compiled
  std::string command;              ///< for `verify --exec`, without the words of a setting
  std::vector<std::string> sources, traps;
  std::vector<double> steps;  ///< [s], descending, where those of the ladder take too long
  std::vector<EngineSetting> settings;
  std::vector<EngineFact> facts;

  /// `text` with `{folder}` and `{program}` as quoted words of a shell.
  std::string filled(std::string_view text, const std::string& program = {}) const;
  /// How to install it.
  std::string installation() const;
};

/// The engines in the folders below `path`, by name. Throws FileError (cannot-read) where there is
/// none, InputError for an engine.toml that is no TOML or lacks a key.
std::vector<Engine> engines_in(const std::string& path);

/// Throws InputError (unknown-name) with did-you-mean.
const Engine& engine_of(std::span<const Engine> engines, const std::string& id);

/// A setting to run: an engine that is installed, its version and program.
struct EngineRun {
  const Engine* engine;
  const EngineSetting* setting;
  std::string version, program;
};

/// The text of a campaign: each run a subject "bullet/tuned 3.24", each case of `cases`, lines of
/// TOML, a system.
std::string engines_specification(std::span<const EngineRun> runs, std::string_view cases);

/// The cases of engines: the pair of the paper, one whose last impacts are slow, a mass at a
/// stop, buildings.
std::string_view engine_cases();

/// One page with style inside, without scripts: how many engines converge, a matrix of settings and
/// cases, error against processor time, facts. All of it is read from the store.
std::string engines_page(const Store& store, const record::Provenance& from);

/// A row an engine: name, version, how it integrates, settings, licence. `versions` has an entry for
/// each; empty: not installed.
record::Sheet engine_list(std::span<const Engine> engines, std::span<const std::string> versions);

/// What engine.toml says of one, a row a fact.
record::Sheet engine_sheet(const Engine& engine, const std::string& version);

}  // namespace clackers::campaign
