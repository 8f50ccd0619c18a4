#include "clackers/methods/registry.hpp"

#include <fmt/format.h>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/treatment.hpp"

namespace clackers::methods {

struct EventDriven;
struct Reversal;
struct Penalty;
struct MoreauJean;
struct NonsmoothGeneralizedAlpha;
struct D1Minus;
struct PaoliSchatzman;
struct CdLagrange;
struct ForwardIncrementLagrange;
struct AugmentedLagrangian;
struct NewmarkImplicitContact;
struct NewmarkPositionMultiplier;
struct PiecewiseExact;

template <class T>
Row row();

namespace {

constexpr auto panel_implicit = "newmark", panel_explicit = "central-difference";

template <class... Types>
void add(std::vector<Row>& all) {
  (all.push_back(row<Types>()), ...);
}

// Families of integrators, contact treatments, standalone methods.
std::vector<Row> all_rows() {
  std::vector<Row> all;
  for (const auto& family : families)
    for (auto& row : family()) all.push_back(std::move(row));
  add<EventDriven, Reversal, Penalty, MoreauJean, NonsmoothGeneralizedAlpha, D1Minus,
      PaoliSchatzman, CdLagrange, ForwardIncrementLagrange, AugmentedLagrangian,
      NewmarkImplicitContact, NewmarkPositionMultiplier, PiecewiseExact>(all);
  return all;
}

const std::vector<Row>& rows() {
  static const auto all = all_rows();
  return all;
}

const Row* find(std::string_view name) {
  for (const auto& row : rows())
    if (row.entry.name == name) return &row;
  return nullptr;
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

std::string_view card(std::string_view name) {
  const auto* row = find(name);
  return row != nullptr ? std::string_view(row->entry.card) : std::string_view();
}

std::shared_ptr<const Integrator> integrator(std::string_view text) {
  const auto [first, contact] = parse_specification(text);
  const auto* row = find(first.name);
  if (row == nullptr || !row->integrator)
    refuse_name("integrator", first.name, names("integrator"), "clackers list integrators");
  if (contact)
    throw InputError(fmt::format("clackers: integrator \"{}\" with a contact treatment; allowed: "
                                 "only {}.",
                                 text, first.name),
                     "bad-syntax");
  return row->integrator(first.settings);
}

std::shared_ptr<const Method> method(std::string_view text) {
  const auto [first, contact] = parse_specification(text);
  const auto* row = find(first.name);
  if (row == nullptr || row->treatment)
    refuse_name("method", first.name, names("integrator", "method"), "clackers list methods");
  if (row->method) {
    if (contact)
      throw InputError(
          fmt::format("clackers: method \"{}\": {} brings its own contact treatment; allowed: "
                      "only {}.",
                      text, first.name, first.name),
          "bad-syntax");
    return row->method(first.settings);
  }
  const auto integrator = row->integrator(first.settings);
  const auto of_contact = contact.value_or(Term{std::string(default_treatment), {}});
  const auto* treatment = find(of_contact.name);
  if (treatment == nullptr || !treatment->treatment)
    refuse_name("contact treatment", of_contact.name, names("contact"), "clackers list contacts");
  return std::make_shared<JoinedMethod>(integrator, treatment->treatment(of_contact.settings));
}

std::string short_name(const std::string& specification) {
  const auto plus = specification.rfind('+');
  const bool is_default =
      plus != specification.npos && specification.substr(plus + 1) == default_treatment;
  return is_default ? specification.substr(0, plus) : specification;
}

std::vector<std::string> pairs() {
  std::vector<std::string> all;
  for (const auto& name : names("integrator"))
    for (const auto& contact : names("contact"))
      if (!find(contact)->treatment({})->objection_to(integrator(name)->facts()))
        all.push_back(name + '+' + contact);
  for (const auto& entry : entries())
    if (entry.kind == "contact")
      for (const auto& variant : variants(entry))
        for (const auto integrator : {panel_implicit, panel_explicit})
          all.push_back(fmt::format("{}+{}", integrator, variant.specification));
  for (const auto& alone : names("method")) all.push_back(alone);
  return all;
}

std::vector<Variant> variants(const Entry& entry) {
  std::vector<Variant> all;
  for (const auto& parameter : entry.parameters)
    for (const auto& word : parameter.words)
      if (word.name != parameter.default_value.text())
        all.push_back({specification(entry.name, {&parameter, 1}, {{parameter.name, word.name}}),
                       word.summary});
  return all;
}

std::vector<std::string> default_panel() {
  return {panel_implicit,     panel_explicit,    "rk4",        "generalized-alpha:rho=0.8",
          "newmark+reversal", "newmark+penalty", "moreau-jean"};
}

}  // namespace clackers::methods
