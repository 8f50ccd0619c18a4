#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/tables/listing.hpp"
#include "clackers/tables/listing/show_sheets.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::tables {
namespace {

constexpr std::size_t impacts_shown = 6;

// The equations of the paper, where a case has some.
std::string title_of(const cases::CaseEntry& entry) {
  const bool of_paper = entry.equations.find("Eq.") != std::string::npos;
  return fmt::format("{}: {}{}", entry.name, entry.summary,
                     of_paper ? fmt::format(" Of the paper: {}.", entry.equations) : "");
}

record::Sheet parameter_sheet(const cases::Case& test_case) {
  record::Sheet sheet{"clackers/parameters/1",
                      title_of(*test_case.entry),
                      {{"parameter", "", "as typed after --set"},
                       {"value", "", "in use"},
                       {"unit", "", ""},
                       {"allowed", "", ""},
                       {"meaning", "", ""}},
                      {}};
  for (std::size_t i = 0; i < test_case.values.size(); ++i) {
    const auto& p = test_case.entry->parameters[i];
    const auto& value = test_case.values[i].second;
    const record::Cell cell =
        value.is_word() ? record::Cell(value.text()) : record::Cell(double(value));
    sheet.rows.push_back({p.name, cell, p.unit, p.allowed, p.meaning});
  }
  return sheet;
}

record::Sheet constant_sheet(std::string schema, std::string title,
                             const std::vector<Quantity>& constants) {
  record::Sheet sheet{std::move(schema),
                      std::move(title),
                      {{"name", "", ""}, {"value", "", ""}, {"unit", "", ""}, {"meaning", "", ""}},
                      {}};
  for (const auto& c : constants) sheet.rows.push_back({c.name, c.value, c.unit, c.meaning});
  return sheet;
}

// Without the states of the masses, which fill more than a page where there are many.
void keep_impacts_alone(record::Sheet& sheet) {
  record::drop_columns(sheet, [&](std::size_t c) {
    const char first = sheet.columns[c].name.front();
    return first == 'u' || first == 'v';
  });
}

bool has_several_contacts(const cases::Case& test_case) {
  return test_case.problem.contacts.size() > 1;
}

record::Sheet impact_sheet(const cases::Case& test_case) {
  const auto rows = impacts(test_case);
  const auto total = test_case.motion->impact_count(test_case.motion->end());
  record::Sheet sheet{rows->schema(), {}, rows->columns(), {}};
  std::vector<record::Cell> row;
  while (sheet.rows.size() < impacts_shown && rows->next(row)) sheet.rows.push_back(row);
  if (test_case.motion->dof() > 2) keep_impacts_alone(sheet);
  if (accumulates(*test_case.motion))
    sheet.title = fmt::format("Impacts: infinitely many; the first {} of {} that are resolved",
                              sheet.rows.size(), total);
  else
    sheet.title = total <= static_cast<long long>(sheet.rows.size())
                      ? fmt::format("Impacts: {}", total)
                      : fmt::format(
                            "Impacts: the first {} of {}; all: clackers respond {} "
                            "--impacts",
                            sheet.rows.size(), total, test_case.entry->name);
  if (total > 0 && has_several_contacts(test_case)) sheet.title += impact_contacts_note;
  return sheet;
}

std::optional<record::Sheet> closed_sheet(const cases::Case& test_case) {
  const auto closed = test_case.motion->closed_contacts();
  if (closed.empty()) return std::nullopt;
  record::Sheet sheet{
      "clackers/closed-contacts/1",
      fmt::format("Contacts that stay closed: {}{}", closed.size(),
                  has_several_contacts(test_case) ? " (contacts numbered from 1)" : ""),
      {{"contact", "", "number of the contact, from 1"},
       {"from", "s", "its force begins"},
       {"until", "s", "its force ends, or the run"},
       {"uncertainty", "s", "of `from`"},
       {"begins", "", "how"},
       {"ends", "", "how"}},
      {}};
  for (const auto& c : closed) {
    if (sheet.rows.size() == impacts_shown) break;
    const auto count = test_case.motion->impact_count(c.from);
    const bool by_impact = count > 0 && test_case.motion->impact(count).t == c.from;
    const auto begins = c.accumulates
                            ? fmt::format(
                                  "infinitely many impacts, those after t = {:.10g} s within "
                                  "the error bound",
                                  c.resolved)
                        : by_impact    ? "impact without rebound"
                        : c.from > 0.0 ? "landing without speed"
                                       : "closed at the start; Newton's law holds for all closed "
                                         "contacts at once";
    sheet.rows.push_back({double(c.contact + 1), c.from, c.until, c.begins.hi - c.begins.lo, begins,
                          std::string(c.opens ? "opens" : "end of the run")});
  }
  return sheet;
}

// u1 - 2 u2 of the direction (1, -2).
std::string sum_of(const Eigen::VectorXd& direction) {
  std::string text;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    const double factor = direction[i], size = std::abs(factor);
    if (factor == 0.0) continue;
    text += text.empty() ? (factor < 0.0 ? "-" : "") : (factor < 0.0 ? " - " : " + ");
    text += size == 1.0 ? fmt::format("u{}", i + 1) : fmt::format("{:g} u{}", size, i + 1);
  }
  return text;
}

std::optional<record::Sheet> spring_sheet(const cases::Case& test_case) {
  const auto* springs = model::one_sided_springs(test_case.problem);
  if (springs == nullptr) return std::nullopt;
  const auto& contacts = springs->contacts();
  record::Sheet sheet{
      "clackers/one-sided-springs/1",
      fmt::format("Contacts with a stiffness, one-sided springs without impacts: {}",
                  contacts.size()),
      {{"force", "", "its column of respond --forces"},
       {"displacement", "", "direction . u, compressed below the gap"},
       {"gap", "m", "where it closes"},
       {"stiffness", "N/m", ""}},
      {}};
  for (std::size_t j = 0; j < contacts.size(); ++j)
    sheet.rows.push_back({fmt::format("force{}", test_case.problem.contacts.size() + j + 1),
                          sum_of(contacts[j].direction), contacts[j].gap,
                          springs->stiffnesses()[j]});
  return sheet;
}

record::Sheet claim_sheet(const methods::Facts& facts) {
  record::Sheet sheet{"clackers/facts/1",
                      facts.name,
                      {{"fact", "", ""}, {"value", "", ""}, {"meaning", "", ""}},
                      {}};
  const auto& claim = facts.through_impacts;
  sheet.rows.push_back(
      {"smooth_order", facts.smooth_order, "order of u and v while nothing collides"});
  sheet.rows.push_back({"stability_limit", facts.stability_limit,
                        "largest omega h of undamped smooth motion; inf: every step is stable, 0: "
                        "it grows in every short step"});
  if (!std::isnan(facts.radius_at_infinity))
    sheet.rows.push_back({"radius_at_infinity", facts.radius_at_infinity,
                          "spectral radius at infinite omega h, undamped"});
  sheet.rows.push_back({"behaviour", std::string(to_string(claim.behaviour)),
                        "claimed through impacts; clackers explain says what it means"});
  if (claim.order > 0.0)
    sheet.rows.push_back({"order", claim.order,
                          claim.behaviour == Behaviour::irregular
                              ? "claimed of the upper envelope of the displacement error"
                              : "claimed of the displacement error"});
  if (facts.model_order > 0.0)
    sheet.rows.push_back({"model_order", facts.model_order,
                          "the error of the contact law falls as stiffness^-model_order"});
  if (!claim.reason.empty())
    sheet.rows.push_back({"reason", claim.reason, "of the claimed behaviour"});
  sheet.rows.push_back({"reports_impacts", std::string(facts.reports_impacts ? "yes" : "no"),
                        "whether a run reports its impacts"});
  return sheet;
}

record::Sheet word_sheet(const methods::Entry& entry, const Parameter& parameter) {
  record::Sheet sheet{
      "clackers/words/1",
      fmt::format("{} of {}", parameter.name, entry.name),
      {{parameter.name, "", "as typed"}, {"summary", "", "in one line"}, {"source", "", ""}},
      {}};
  for (const auto& word : parameter.words)
    sheet.rows.push_back({word.name, word.summary, word.source});
  return sheet;
}

void add_entry(std::vector<record::Sheet>& sheets, const methods::Entry& entry) {
  record::Sheet parameters{"clackers/parameters/1",
                           fmt::format("Parameters of {}", entry.name),
                           {{"parameter", "", "as typed"},
                            {"default", "", ""},
                            {"allowed", "", ""},
                            {"meaning", "", "with its unit"}},
                           {}};
  for (const auto& p : entry.parameters)
    parameters.rows.push_back({p.name, p.default_text(), p.allowed, p.meaning});
  if (!parameters.rows.empty()) sheets.push_back(std::move(parameters));
  for (const auto& p : entry.parameters)
    if (!p.words.empty()) sheets.push_back(word_sheet(entry, p));
  sheets.push_back({"clackers/card/1",
                    fmt::format("{} ({}): {}", entry.name, entry.kind, entry.summary),
                    {{"card", "", ""}},
                    {{entry.card}}});
}

std::string_view name_of(std::string_view term) { return term.substr(0, term.find(':')); }

const methods::Entry& entry_of(std::string_view term) {
  return *std::ranges::find(methods::entries(), name_of(term), &methods::Entry::name);
}

// False for a method that brings its own integration, and for what is no method.
bool is_integrator(std::string_view term) {
  return std::ranges::any_of(methods::entries(), [&](const methods::Entry& entry) {
    return entry.kind == "integrator" && entry.name == name_of(term);
  });
}

}  // namespace

std::vector<record::Sheet> show_case(std::string_view name, const cases::Settings& settings,
                                     double threshold) {
  const auto test_case = cases::make(name, settings, threshold);
  std::vector<record::Sheet> sheets{
      parameter_sheet(test_case),
      constant_sheet("clackers/constants/1", "Derived constants", test_case.constants),
      constant_sheet("clackers/indicators/1",
                     test_case.indicators.empty() ? "Indicators: none of this case" : "Indicators",
                     test_case.indicators),
      impact_sheet(test_case)};
  for (auto& more : {closed_sheet(test_case), spring_sheet(test_case),
                     harmonic_sheet(test_case, threshold), conditioning_sheet(test_case)})
    if (more) sheets.push_back(*more);
  return sheets;
}

std::string show_problem(std::string_view name, const cases::Settings& settings) {
  const auto test_case = cases::make(name, settings);
  return problem_members(test_case.problem, test_case.mesh);
}

std::vector<record::Sheet> show_method(std::string_view specification) {
  std::vector<record::Sheet> sheets;
  // A contact treatment alone is no method, yet it has a card to show.
  const auto first = methods::parse_specification(specification).first;
  for (const auto& entry : methods::entries())
    if (entry.kind == "contact" && entry.name == first.name) {
      complete(entry.name, entry.parameters, first.settings);
      add_entry(sheets, entry);
      return sheets;
    }
  const auto facts = methods::method(specification)->facts();
  sheets.push_back(claim_sheet(facts));
  const auto terms = methods::terms_of(facts.name);
  if (is_integrator(terms[0]) && !facts.is_adaptive)
    for (auto& sheet : amplification_sheets(*methods::integrator(terms[0])))
      sheets.push_back(std::move(sheet));
  for (const auto term : terms) add_entry(sheets, entry_of(term));
  return sheets;
}

}  // namespace clackers::tables
