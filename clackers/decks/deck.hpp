#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

// Ready-to-run models of a problem for other programs.
namespace clackers::decks {

/// What is exported.
struct Subject {
  model::ImpactProblem<> problem;
  /// The words behind `clackers check` that name it: {"three-parameter", "--set", "N=3"}. Empty: it is
  /// in the file problem.json of the deck.
  std::vector<std::string> check;
  std::string command;  ///< that wrote it, for the first line of the model
  std::shared_ptr<const model::Motion> motion{};  ///< the exact one, for units that give it
  std::string method{};  ///< of a unit that gives its motion instead: "rk4"
};

struct DeckFile {
  std::string name, text;
  bool is_program = false;
};

/// A program that models are written for.
struct Format {
  std::string name;     ///< of --to
  std::string program;  ///< "CalculiX 2.20"
  std::string contact;  ///< what takes the place of the contact
  std::string needs;    ///< the package of Debian; empty: the deck was not run by us
  std::string probe;    ///< a command of the shell that ends well where the program is there
  std::vector<DeckFile> (*write)(const Subject& subject);  ///< none: `contact` says why not
};

/// All formats, those that our tests run first.
std::span<const Format> formats();
/// Throws InputError (unknown-name) with did-you-mean.
const Format& format_of(std::string_view name);

/// The files of a deck: the model, and `run`, which runs it on a ladder of steps or tolerances and ends
/// with the `clackers check` that judges it. Throws InputError (no-deck) for a problem that the format
/// cannot express.
std::vector<DeckFile> deck(const Format& format, const Subject& subject);

/// The names of all files that any deck may have.
std::vector<std::string> file_names();

}  // namespace clackers::decks
