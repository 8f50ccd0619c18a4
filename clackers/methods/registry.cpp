#include "clackers/methods/registry.hpp"

#include <fmt/format.h>

#include <array>
#include <tuple>

#include "clackers/base/error.hpp"
#include "clackers/base/suggest.hpp"
#include "clackers/methods/cards.hpp"
#include "clackers/methods/contact/moreau_jean.hpp"
#include "clackers/methods/integrators/central_difference.hpp"
#include "clackers/methods/integrators/generalized_alpha.hpp"
#include "clackers/methods/integrators/newmark.hpp"
#include "clackers/methods/integrators/rk4.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

// Compiled in the source files of the types.
extern template IntegratorRow integrator_row<Newmark>();
extern template IntegratorRow integrator_row<CentralDifference>();
extern template IntegratorRow integrator_row<Rk4>();
extern template IntegratorRow integrator_row<GeneralizedAlpha>();
extern template MethodRow method_row<MoreauJean>();

namespace {

const std::array<IntegratorRow, 4>& integrators() {
  static const std::array<IntegratorRow, 4> all = {
      integrator_row<Newmark>(), integrator_row<CentralDifference>(), integrator_row<Rk4>(),
      integrator_row<GeneralizedAlpha>()};
  return all;
}

const std::array<MethodRow, 1>& methods_alone() {
  static const std::array<MethodRow, 1> all = {method_row<MoreauJean>()};
  return all;
}

template <class... Treatment>
void add_treatments(std::vector<Entry>& all, std::tuple<Treatment...>*) {
  (all.push_back(entry_of<Treatment>("contact", card(Treatment::name))), ...);
}

std::vector<Entry> build_entries() {
  std::vector<Entry> all;
  for (const auto& row : integrators()) all.push_back(row.entry(card(row.name)));
  add_treatments(all, static_cast<Treatments*>(nullptr));
  for (const auto& row : methods_alone()) all.push_back(row.entry(card(row.name)));
  return all;
}

std::vector<std::string> names(std::string_view kind, std::string_view or_kind = {}) {
  std::vector<std::string> all;
  for (const auto& entry : entries())
    if (entry.kind == kind || entry.kind == or_kind) all.push_back(entry.name);
  return all;
}

std::string_view contact_or_default(const MethodSpecification& specification) {
  return specification.contact ? std::string_view(specification.contact->name) : "event-driven";
}

}  // namespace

std::span<const Entry> entries() {
  static const std::vector<Entry> all = build_entries();
  return all;
}

std::shared_ptr<const Method> method(std::string_view text) {
  const MethodSpecification specification = parse_specification(text);
  const auto& first = specification.first;
  for (const auto& row : methods_alone()) {
    if (row.name != first.name) continue;
    if (specification.contact)
      throw InputError(
          fmt::format("clackers: method \"{}\": {} brings its own contact treatment; allowed: "
                      "{} alone.",
                      text, first.name, first.name),
          "bad-syntax");
    return row.make(first.settings);
  }
  for (const auto& row : integrators()) {
    if (row.name != first.name) continue;
    const auto treatment = contact_or_default(specification);
    const auto settings = specification.contact ? specification.contact->settings : Settings{};
    if (auto joined = row.join(first.settings, treatment, settings)) return joined;
    refuse_name("contact treatment", treatment, names("contact"), "clackers list contacts");
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
