#include "clackers/tables/listing.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>

#include "clackers/base/check.hpp"
#include "clackers/base/codes.hpp"
#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::tables {
namespace {

const record::Column name_column{"name", "", "as typed"};
const record::Column summary_column{"summary", "", "in one line"};

std::string with_defaults(const auto& parameters) {
  std::string text;
  for (const auto& p : parameters)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", p.name, p.default_text());
  return text;
}

record::Sheet list_cases() {
  record::Sheet sheet{"clackers/cases/1",
                      "Cases",
                      {name_column,
                       {"equations", "", "of the paper"},
                       {"parameters", "", "with their defaults"},
                       summary_column},
                      {}};
  for (const auto& entry : cases::entries()) {
    const bool standard = entry.name == cases::default_case();
    sheet.rows.push_back({entry.name, entry.equations, with_defaults(entry.parameters),
                          entry.summary + (standard ? " The default case." : "")});
  }
  return sheet;
}

// The parameters of a variant are those of its entry.
void add_with_variants(record::Sheet& sheet, const methods::Entry& entry) {
  const auto parameters = with_defaults(entry.parameters);
  sheet.rows.push_back({entry.name, parameters, entry.summary});
  for (const auto& variant : methods::variants(entry))
    sheet.rows.push_back({variant.specification, record::Cell{}, variant.summary});
}

record::Sheet list_entries(std::string_view title, std::string_view schema, std::string_view kind) {
  record::Sheet sheet{std::string(schema),
                      std::string(title),
                      {name_column, {"parameters", "", "with their defaults"}, summary_column},
                      {}};
  for (const auto& entry : methods::entries())
    if (entry.kind == kind) add_with_variants(sheet, entry);
  return sheet;
}

// All that a specification can begin with or name behind its "+".
record::Sheet list_methods() {
  record::Sheet sheet{
      "clackers/methods/1",
      fmt::format("Methods: integrator+contact, or a standalone one. Default panel: {}",
                  fmt::join(methods::default_panel(), ", ")),
      {name_column,
       {"kind", "", "integrator, contact, or method (brings its own integration)"},
       {"parameters", "", "with their defaults"},
       summary_column},
      {}};
  for (const auto& entry : methods::entries())
    sheet.rows.push_back({entry.name, entry.kind, with_defaults(entry.parameters), entry.summary});
  return sheet;
}

// Whole methods with what each claims through impacts.
record::Sheet list_pairs() {
  record::Sheet sheet{
      "clackers/pairs/1",
      "Every method, with default parameters",
      {{"method", "", "as typed"},
       {"smooth_order", "", "order of u and v while nothing collides"},
       {"claim", "", "behaviour through impacts"},
       {"order", "", "order through impacts, of the upper envelope when irregular"}},
      {}};
  for (const auto& specification : methods::pairs()) {
    const auto facts = methods::method(specification)->facts();
    const auto& claim = facts.through_impacts;
    const bool has_order = claim.order > 0.0;
    sheet.rows.push_back({specification, facts.smooth_order,
                          std::string(to_string(claim.behaviour)),
                          has_order ? record::Cell{claim.order} : record::Cell{}});
  }
  return sheet;
}

// What a run is scored by, then the table of `check`, where a history is whole.
record::Sheet list_metrics() {
  record::Sheet sheet{"clackers/metrics/1",
                      "Metrics",
                      {name_column,
                       {"unit", "", "empty when dimensionless"},
                       {"across_impacts", "", "whether it is valid across jumps of velocity"},
                       {"meaning", "", ""},
                       {"source", "", "who defined it"}},
                      {}};
  for (const auto& metric : measure::metrics())
    sheet.rows.push_back({std::string(metric.name),
                          std::string(metric.unit == "1" ? "" : metric.unit),
                          metric.across_jumps ? "yes" : "no", std::string(metric.definition),
                          std::string(metric.source)});
  return sheet;
}

record::Sheet list_diagnoses() {
  record::Sheet sheet{"clackers/diagnoses/1",
                      "Causes that check and verify look for",
                      {{"code", "", ""},
                       {"unit", "", "of the value"},
                       {"value", "", "what it is"},
                       {"meaning", "", "and what to do about it"}},
                      {}};
  const auto cell = [](std::string_view text) {
    return text.empty() ? record::Cell{} : record::Cell{std::string(text)};
  };
  for (const auto& row : diagnose::causes())
    sheet.rows.push_back(
        {std::string(row.code.name()), cell(row.unit), cell(row.value), diagnose::meaning_of(row)});
  return sheet;
}

using Lister = std::function<record::Sheet()>;

const auto& listers() {
  static const auto table = std::to_array<std::pair<std::string, Lister>>({
      {"cases", list_cases},
      {"integrators",
       [] { return list_entries("Integrators", "clackers/integrators/1", "integrator"); }},
      {"contacts",
       [] { return list_entries("Contact treatments", "clackers/contacts/1", "contact"); }},
      {"methods", list_methods},
      {"pairs", list_pairs},
      {"metrics", list_metrics},
      {"diagnoses", list_diagnoses},
  });
  return table;
}

}  // namespace

std::vector<std::string> list_kinds() {
  std::vector<std::string> kinds;
  for (const auto& [name, lister] : listers()) kinds.push_back(name);
  return kinds;
}

record::Sheet list(std::string_view kind) {
  for (const auto& [name, lister] : listers())
    if (name == kind) return lister();
  const auto kinds = list_kinds();
  refuse_name("list", kind, kinds, fmt::format("{}", fmt::join(kinds, ", ")));
}

record::Sheet explain(std::string_view code) {
  record::Sheet sheet{"clackers/codes/1",
                      code.empty() ? "Codes" : "",
                      {{"code", "", "printed in brackets after a message"},
                       {"kind", "", "behaviour, reason, verdict, refusal or failure"},
                       {"meaning", "", "what happened and what to do about it"}},
                      {}};
  std::vector<std::string> known;
  for (const auto& entry : code_table()) {
    known.emplace_back(entry.name);
    if (code.empty() || code == entry.name)
      sheet.rows.push_back({std::string(entry.name), std::string(entry.kind),
                            entry.kind == "diagnosis"
                                ? diagnose::meaning_of(*diagnose::find_cause(entry.name))
                                : std::string(entry.meaning)});
  }
  if (sheet.rows.empty()) refuse_name("code", code, known, "clackers explain");
  return sheet;
}

}  // namespace clackers::tables
