#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/write.hpp"
#include "clackers/tables/listing.hpp"
#include "cli/command.hpp"
#include "cli/files/results.hpp"
#include "cli/options.hpp"
#include "paper/catalogue.hpp"

namespace clackers::cli {
namespace {

struct ListOptions {
  CommonOptions common;
  std::string kind;
};

// Together these name everything; the other kinds repeat a part of it.
constexpr auto shown_together = {"cases", "methods", "metrics"};

record::Sheet list(const std::string& kind) {
  if (kind == "columns") return report::list_columns();
  if (kind == "figures") return paper::list_figures();
  const auto kinds = listed_kinds();
  if (std::ranges::find(kinds, kind) == kinds.end())
    refuse_name("list", kind, kinds, fmt::format("{}", fmt::join(kinds, ", ")));
  return tables::list(kind);
}

// Metrics as people read them at 80 columns: a mark and the source are in the texts, so that the
// definitions have the width of the page.
record::Sheet for_people(const record::Sheet& metrics) {
  record::Sheet out{metrics.schema,
                    "Metrics (* need not vanish while impacts are a little early or late)",
                    {{"name", "", ""}, {"unit", "", ""}, {"meaning", "", "and who defined it"}},
                    {}};
  for (const auto& row : metrics.rows) {
    const auto text = [&](std::size_t column) {
      const auto* found = std::get_if<std::string>(&row[column]);
      return found == nullptr ? std::string() : *found;
    };
    const auto source = text(4) == "common" ? std::string() : fmt::format(" ({})", text(4));
    out.rows.push_back({text(0) + (text(2) == "no" ? " *" : ""), text(1), text(3) + source});
  }
  return out;
}

record::Sheet shown(record::Sheet sheet, report::Format format) {
  const bool is_metrics = sheet.schema == "clackers/metrics/1";
  return is_metrics && format == report::Format::table ? for_people(sheet) : sheet;
}

int run(const ListOptions& options) {
  Results results(options.common, OnInterrupt::stop);
  if (options.kind.empty()) {
    std::vector<record::Sheet> sheets;
    for (const auto* kind : shown_together)
      sheets.push_back(shown(tables::list(kind), results.format()));
    report::write(sheets, "clackers/list/1", results.format(), results.stream(), results.style());
  } else {
    const auto sheet = shown(list(options.kind), results.format());
    record::SheetRows rows(sheet);
    report::write(rows, results.format(), results.stream(), results.style());
  }
  results.finish();
  return 0;
}

}  // namespace

// Columns and figures are in modules above the one that lists the rest.
std::vector<std::string> listed_kinds() {
  auto kinds = tables::list_kinds();
  kinds.insert(kinds.end(), {"columns", "figures"});
  return kinds;
}

void add_list(Grammar& root) {
  const auto options = std::make_shared<ListOptions>();
  auto* app = root.add_subcommand("list", "[KIND]", "cases, methods, metrics and more");
  set_help(*app, {.examples = "  clackers list cases\n"
                              "  clackers list pairs --format csv\n",
                  .about = "Lists cases, methods, metrics and more, one line each.",
                  .usage = "  clackers list [cases|integrators|contacts|methods|pairs|metrics|\n"
                           "           columns|diagnoses|figures]\n"});
  app->add_option(
      "KIND", options->kind,
      "cases, methods (integrators, contact treatments, standalone methods, and the default "
      "panel), integrators, contacts, pairs (every integrator with every contact "
      "treatment that takes it, and what they claim), metrics, columns (of csv and json), "
      "diagnoses (causes that check and verify name) or figures (of clackers paper). "
      "Without it cases, methods and metrics.");
  add_common_options(*app, options->common);
  app->run = [options](const std::string&) { return run(*options); };
}

}  // namespace clackers::cli
