#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/decks/deck.hpp"

// What the formats share.
namespace clackers::decks {

using Words = std::initializer_list<std::pair<std::string_view, std::string>>;

/// `text` with each "@name@" replaced by its value.
std::string filled(std::string_view text, Words words);

/// Throws InputError (no-deck): `format: why.`
[[noreturn]] void refuse_deck(std::string_view format, const std::string& why);

/// The first lines of a model behind `comment`: the command that wrote it, the program, the unit system,
/// and of a deck that we did not run that it was not.
std::string head(const Subject& subject, std::string_view format, std::string_view comment);

/// A level of the ladder: "N400" and its step [s], or "rtol1e-06" and its tolerance.
struct Level {
  std::string name;
  double value;
};

/// 1e-4 to 1e-10, a factor 10 each.
std::vector<Level> tolerances();
/// Steps of a whole number a run, halved `levels` - 1 times from at most `coarsest` [s].
std::vector<Level> steps(const model::ImpactProblem<>& problem, double coarsest, int levels = 5);
/// The shortest period of M a + K u = 0 [s]; that of the run where nothing oscillates.
double shortest_period(const model::ImpactProblem<>& problem);

/// The script `run`: `prepare` once, `solve` for each level with its name in $1 and its value in $2, then
/// the check of the files "$1" + `ending` with `options` behind it.
DeckFile run_script(const Subject& subject, const std::vector<Level>& levels,
                    std::string_view solve, std::string_view ending, std::string_view options,
                    std::string_view prepare = {});

}  // namespace clackers::decks
