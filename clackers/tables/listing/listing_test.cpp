#include "clackers/tables/listing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clackers/base/codes.hpp"
#include "clackers/base/error.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::tables {
namespace {

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
  return "accepted";
}

// The cell of the row whose first cell is `name`, in the column of that name.
record::Cell cell(const record::Sheet& sheet, const std::string& name, const std::string& column) {
  const auto place = std::ranges::find(sheet.columns, column, &record::Column::name);
  if (place == sheet.columns.end()) return std::string("no such column");
  for (const auto& row : sheet.rows)
    if (row.front() == record::Cell{name})
      return row[static_cast<std::size_t>(place - sheet.columns.begin())];
  return std::string("no such row");
}

bool holds(const record::Sheet& sheet, const std::string& name) {
  return std::ranges::any_of(sheet.rows,
                             [&](const auto& row) { return row.front() == record::Cell{name}; });
}

TEST(Listing, EverySheetIsRectangular) {
  std::vector<record::Sheet> sheets{explain(""), explain("proper")};
  for (const auto* kind : {"cases", "integrators", "contacts", "methods", "pairs", "metrics"})
    sheets.push_back(list(kind));
  for (const auto& sheet : show_case("three-parameter", {}, 0.1)) sheets.push_back(sheet);
  for (const auto& sheet : show_method("newmark")) sheets.push_back(sheet);
  for (const auto& sheet : sheets) {
    SCOPED_TRACE(sheet.title);
    EXPECT_FALSE(sheet.rows.empty());
    EXPECT_EQ(sheet.schema.substr(0, 9), "clackers/");
    EXPECT_EQ(sheet.schema.substr(sheet.schema.size() - 2), "/1");
    for (const auto& row : sheet.rows) EXPECT_EQ(row.size(), sheet.columns.size());
  }
}

TEST(Listing, OfCasesHoldsThemAll) {
  const auto sheet = list("cases");
  EXPECT_EQ(sheet.rows.size(), cases::entries().size());
  EXPECT_EQ(cell(sheet, "three-parameter", "equations"),
            record::Cell{std::string("Eq. (25)-(26)")});
  EXPECT_EQ(cell(sheet, "three-parameter", "parameters"),
            record::Cell{std::string("N=2 xi1=0.05 a_t=1")});
  const auto summary = std::get<std::string>(cell(sheet, "three-parameter", "summary"));
  EXPECT_NE(summary.find("The default case."), std::string::npos);
  EXPECT_EQ(std::get<std::string>(cell(sheet, "stop", "summary")).find("default"),
            std::string::npos);
}

TEST(Listing, OfMethodsComesFromTheRegistry) {
  for (const auto& entry : methods::entries()) {
    EXPECT_EQ(holds(list("integrators"), entry.name), entry.kind == "integrator") << entry.name;
    EXPECT_EQ(holds(list("contacts"), entry.name), entry.kind == "contact") << entry.name;
  }
  const auto all = list("methods");
  EXPECT_EQ(all.rows.size(), methods::entries().size());
  EXPECT_EQ(cell(all, "rk4", "kind"), record::Cell{std::string("integrator")});
  EXPECT_NE(all.title.find("Default panel: newmark, central-difference"), std::string::npos);
  EXPECT_EQ(list("pairs").rows.size(), methods::pairs().size());
  EXPECT_EQ(cell(list("pairs"), "rk4+event-driven", "claim"), record::Cell{std::string("proper")});
  EXPECT_EQ(cell(list("pairs"), "rk4+event-driven", "order"), record::Cell{4.0});
  EXPECT_EQ(cell(list("pairs"), "rk4+event-driven", "smooth_order"), record::Cell{4.0});
}

TEST(Listing, OfContactsHasALawARow) {
  const auto sheet = list("contacts");
  EXPECT_EQ(cell(sheet, "penalty:law=hertz", "summary"),
            record::Cell{std::string("F = k d^1.5, elastic")});
  EXPECT_FALSE(holds(sheet, "penalty:law=linear"));
}

TEST(Listing, OfMetricsNamesWhatARunIsJudgedBy) {
  EXPECT_EQ(cell(list("metrics"), "impact-time-max", "unit"), record::Cell{std::string("s")});
  EXPECT_EQ(cell(list("metrics"), "v-max", "across_impacts"), record::Cell{std::string("no")});
  EXPECT_EQ(cell(list("metrics"), "v-l1", "across_impacts"), record::Cell{std::string("yes")});
  EXPECT_EQ(cell(list("metrics"), "u-max", "unit"), record::Cell{std::string("m")});
  EXPECT_EQ(cell(list("metrics"), "u-max-relative", "unit"), record::Cell{std::string()});
}

TEST(Listing, RefusesUnknownKindsWithASuggestion) {
  EXPECT_EQ(refusal([] { list("case"); }),
            "clackers: no list \"case\". Did you mean \"cases\"? All names: cases, integrators, "
            "contacts, methods, pairs, metrics, diagnoses [unknown-name]");
}

TEST(Explain, TellsOneCodeOrAll) {
  const auto all = explain("");
  EXPECT_EQ(all.rows.size(), code_table().size());
  for (const auto& entry : code_table()) {
    const auto one = explain(entry.name);
    ASSERT_EQ(one.rows.size(), 1u) << entry.name;
    EXPECT_EQ(one.rows[0][0], record::Cell{std::string(entry.name)});
    EXPECT_EQ(one.rows[0][1], record::Cell{std::string(entry.kind)});
    if (entry.kind == "diagnosis") continue;
    EXPECT_EQ(one.rows[0][2], record::Cell{std::string(entry.meaning)});
  }
}

TEST(Explain, OfADiagnosisEndsWithItsCure) {
  EXPECT_EQ(explain("impact-doubled").rows[0][2],
            record::Cell{std::string("One impact was applied twice. Check the detection of "
                                     "contacts just after an impact.")});
  EXPECT_EQ(explain("columns-exchanged").rows[0][2],
            record::Cell{std::string("Columns are in another order than their names. Read them "
                                     "with --columns.")});
}

TEST(Explain, RefusesUnknownCodesWithASuggestion) {
  EXPECT_EQ(refusal([] { explain("not-od"); }),
            "clackers: no code \"not-od\". Did you mean \"not-odd\"? All names: clackers explain "
            "[unknown-name]");
}

TEST(ShowCase, TellsParametersConstantsIndicatorsAndImpacts) {
  const auto sheets = show_case("three-parameter", {{"N", 5.0}}, 0.2);
  ASSERT_EQ(sheets.size(), 6u);
  EXPECT_EQ(cell(sheets[0], "N", "value"), record::Cell{5.0});
  EXPECT_EQ(cell(sheets[0], "xi1", "value"), record::Cell{0.05});
  EXPECT_EQ(cell(sheets[0], "xi1", "allowed"), record::Cell{std::string("0 or 1e-60 <= xi1 < 1")});
  EXPECT_NE(sheets[0].title.find("Eq. (25)-(26)"), std::string::npos);
  EXPECT_EQ(cell(sheets[1], "X", "value"), record::Cell{21.0});
  EXPECT_EQ(cell(sheets[1], "T", "unit"), record::Cell{std::string("s")});
  EXPECT_EQ(cell(sheets[2], "threshold", "value"), record::Cell{0.2});
  EXPECT_EQ(sheets[3].title, "Impacts: 6");
  EXPECT_EQ(sheets[3].rows.size(), 6u);
  EXPECT_EQ(sheets[3].columns[1].name, "t");
}

TEST(ShowCase, ShowsTheFirstImpactsOfManyAndSaysSo) {
  const auto sheets = show_case("three-parameter", {{"a_t", 50.0}}, 0.1);
  EXPECT_EQ(sheets[3].rows.size(), 6u);
  EXPECT_EQ(sheets[3].title,
            "Impacts: the first 6 of 318; all: clackers respond three-parameter --impacts");
  EXPECT_EQ(show_case("sdof", {}, 0.1)[3].title, "Impacts: 0");
}

TEST(ShowCase, ListsContactsWithAStiffness) {
  const auto sheets = show_case("bar-between-stops", {{"elements", 4.0}}, 0.1);
  const auto& springs = sheets[4];
  EXPECT_EQ(springs.schema, "clackers/one-sided-springs/1");
  ASSERT_EQ(springs.rows.size(), 2u);
  EXPECT_EQ(cell(springs, "force1", "displacement"), record::Cell{std::string("u1")});
  EXPECT_EQ(cell(springs, "force1", "gap"), record::Cell{-0.25});
  EXPECT_EQ(cell(springs, "force2", "displacement"), record::Cell{std::string("-u3")});
  EXPECT_EQ(cell(springs, "force2", "stiffness"), record::Cell{4.0});
  EXPECT_EQ(cell(show_case("penalized-pair", {}, 0.1)[4], "force1", "displacement"),
            record::Cell{std::string("u1 - u2")});
}

TEST(ShowCase, RefusesAsTheCaseDoes) {
  EXPECT_NE(refusal([] { show_case("stopp", {}, 0.1); }).find("Did you mean \"stop\"?"),
            std::string::npos);
  EXPECT_NE(refusal([] {
              show_case("stop", {{"eta", 2.0}}, 0.1);
            }).find("[out-of-range]"),
            std::string::npos);
  EXPECT_NE(refusal([] { show_case("stop", {}, 2.0); }).find("threshold"), std::string::npos);
}

TEST(ShowMethod, TellsClaimParametersAndCards) {
  const auto sheets = show_method("newmark:beta=0+penalty");
  EXPECT_EQ(sheets.front().schema, "clackers/facts/1");
  EXPECT_EQ(cell(sheets.front(), "smooth_order", "value"), record::Cell{2.0});
  EXPECT_EQ(cell(sheets.front(), "behaviour", "value"), record::Cell{std::string("stagnating")});
  EXPECT_EQ(cell(sheets.front(), "reason", "value"),
            record::Cell{std::string("contact-stiffness")});
  const auto cards = std::ranges::count(sheets, "clackers/card/1", &record::Sheet::schema);
  EXPECT_EQ(cards, 2);
  const auto parameters =
      std::ranges::find(sheets, "clackers/parameters/1", &record::Sheet::schema);
  ASSERT_NE(parameters, sheets.end());
  EXPECT_EQ(cell(*parameters, "beta", "default"), record::Cell{std::string("0.25")});
}

TEST(ShowMethod, ShowsEverythingRegistered) {
  for (const auto& entry : methods::entries()) {
    const auto sheets = show_method(entry.name);
    const auto& card = sheets.back();
    const bool found = std::ranges::any_of(sheets, [&](const record::Sheet& sheet) {
      return sheet.schema == "clackers/card/1" && sheet.rows[0][0] == record::Cell{entry.card};
    });
    EXPECT_TRUE(found) << entry.name << card.title;
  }
  for (const auto& specification : methods::pairs())
    EXPECT_FALSE(show_method(specification).empty());
}

TEST(ShowMethod, ShowsATreatmentWithItsWordsAndTheirSources) {
  const auto sheets = show_method("penalty:law=ye");
  const auto words = std::ranges::find(sheets, "clackers/words/1", &record::Sheet::schema);
  ASSERT_NE(words, sheets.end());
  EXPECT_NE(std::get<std::string>(cell(*words, "ye", "source")).find("38, 1135-1142 (2009)"),
            std::string::npos);
  EXPECT_EQ(cell(show_method("rk4+penalty:law=ye").front(), "model_order", "value"),
            record::Cell{0.4});
}

TEST(ShowMethod, RefusesUnknownNames) {
  EXPECT_NE(refusal([] { show_method("penalty:law=yo"); }).find("Did you mean \"ye\"?"),
            std::string::npos);
  EXPECT_NE(refusal([] { show_method("newmrak"); }).find("Did you mean \"newmark\"?"),
            std::string::npos);
}

}  // namespace
}  // namespace clackers::tables
