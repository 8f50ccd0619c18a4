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

}  // namespace

std::string_view to_string(Behaviour behaviour) { return name_of(behaviours, behaviour); }
std::string_view to_string(Verdict verdict) { return name_of(verdicts, verdict); }

Behaviour behaviour_from(std::string_view text) {
  const auto row = std::ranges::find(behaviours, text, &decltype(behaviours)::value_type::second);
  if (row == behaviours.end())
    refuse("clackers", "behaviour", text,
           "exact, proper, reduced, irregular, stagnating, divergent, undecided", {},
           "unknown-name");
  return row->first;
}

bool converges(Behaviour behaviour) {
  return behaviour == Behaviour::proper || behaviour == Behaviour::reduced ||
         behaviour == Behaviour::irregular || behaviour == Behaviour::exact;
}

}  // namespace clackers
