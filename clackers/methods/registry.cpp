#include "clackers/methods/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "clackers/base/error.hpp"
#include "clackers/base/suggest.hpp"
#include "clackers/methods/method_specification.hpp"

namespace clackers::methods {

struct Newmark;
struct CentralDifference;
struct Rk4;
struct GeneralizedAlpha;
struct EventDriven;
struct Reversal;
struct Penalty;
struct MoreauJean;

namespace {

// Integrators, contact treatments, standalone methods.
std::span<const Row> rows() {
  static const std::array all{row<Newmark>(),          row<CentralDifference>(), row<Rk4>(),
                              row<GeneralizedAlpha>(), row<EventDriven>(),       row<Reversal>(),
                              row<Penalty>(),          row<MoreauJean>()};
  return all;
}

std::vector<std::string> names(std::string_view kind, std::string_view or_kind = {}) {
  std::vector<std::string> all;
  for (const auto& entry : entries())
    if (entry.kind == kind || entry.kind == or_kind) all.push_back(entry.name);
  return all;
}

}  // namespace

std::span<const Entry> entries() {
  static const auto all = [] {
    std::vector<Entry> list;
    for (const auto& row : rows()) list.push_back(row.entry);
    return list;
  }();
  return all;
}

std::shared_ptr<const Method> method(std::string_view text) {
  const auto [first, contact] = parse_specification(text);
  for (const auto& row : rows()) {
    if (row.entry.name != first.name || row.make == nullptr) continue;
    if (contact && row.entry.kind == "method")
      throw InputError(
          fmt::format("clackers: method \"{}\": {} brings its own contact treatment; allowed: "
                      "{} alone.",
                      text, first.name, first.name),
          "bad-syntax");
    const auto treatment = contact.value_or(Term{"event-driven", {}});
    if (auto made = row.make(first.settings, treatment.name, treatment.settings)) return made;
    refuse_name("contact treatment", treatment.name, names("contact"), "clackers list contacts");
  }
  refuse_name("method", first.name, names("integrator", "method"), "clackers list methods");
}

std::vector<std::string> pairs() {
  std::vector<std::string> all;
  for (const auto& integrator : names("integrator"))
    for (const auto& contact : names("contact")) all.push_back(integrator + '+' + contact);
  for (const auto& alone : names("method")) all.push_back(alone);
  return all;
}

std::vector<std::string> default_panel() {
  return {"newmark",          "central-difference", "rk4",        "generalized-alpha:rho=0.8",
          "newmark+reversal", "newmark+penalty",    "moreau-jean"};
}

}  // namespace clackers::methods
