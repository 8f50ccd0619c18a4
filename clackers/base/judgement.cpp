#include "clackers/base/judgement.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "clackers/base/error.hpp"

namespace clackers {
namespace {

template <class Value>
using Named = std::pair<Value, std::string_view>;

constexpr std::array<Named<Behaviour>, 7> behaviours{{{Behaviour::exact, "exact"},
                                                      {Behaviour::proper, "proper"},
                                                      {Behaviour::reduced, "reduced"},
                                                      {Behaviour::irregular, "irregular"},
                                                      {Behaviour::stagnating, "stagnating"},
                                                      {Behaviour::divergent, "divergent"},
                                                      {Behaviour::undecided, "undecided"}}};

constexpr std::array<Named<Verdict>, 4> verdicts{{{Verdict::agrees, "agrees"},
                                                  {Verdict::disagrees, "disagrees"},
                                                  {Verdict::not_claimed, "not claimed"},
                                                  {Verdict::undecided, "undecided"}}};

template <class Table, class Value>
std::string_view name_of(const Table& table, Value value) {
  return std::ranges::find(table, value, &Table::value_type::first)->second;
}

template <class Table>
auto read(const Table& table, std::string_view text, std::string_view what,
          std::string_view allowed) {
  const auto row = std::ranges::find(table, text, &Table::value_type::second);
  if (row == table.end()) refuse("clackers", what, text, allowed, {}, "unknown-name");
  return row->first;
}

}  // namespace

std::string_view to_string(Behaviour behaviour) { return name_of(behaviours, behaviour); }
std::string_view to_string(Verdict verdict) { return name_of(verdicts, verdict); }

Behaviour behaviour_from(std::string_view text) {
  return read(behaviours, text, "behaviour",
              "exact, proper, reduced, irregular, stagnating, divergent, undecided");
}

Verdict verdict_from(std::string_view text) {
  return read(verdicts, text, "verdict", "agrees, disagrees, not claimed, undecided");
}

}  // namespace clackers
