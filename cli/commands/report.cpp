#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "clackers/base/error.hpp"
#include "clackers/report/history.hpp"
#include "cli/command.hpp"
#include "cli/files/paths.hpp"
#include "cli/files/report_page.hpp"
#include "cli/files/results.hpp"
#include "cli/options.hpp"

namespace clackers::cli {
namespace {

struct ReportOptions {
  CommonOptions common;  ///< its `out` is the page
  std::vector<std::string> records;
};

int run(const ReportOptions& options, const std::string& line) {
  if (options.records.size() < 2)
    throw InputError(
        "report needs two records or more, oldest first: clackers report v1.json v2.json --out history.html",
        "bad-syntax");
  ReportPage page(options.common.out, options.common, OnInterrupt::stop, "--out");
  auto common = options.common;
  common.out.clear();  // the table goes to standard output
  Results results(common, OnInterrupt::stop);
  std::vector<record::Record> records;
  std::vector<std::string> names;
  std::vector<study::BaselineComparison> changes;
  for (const auto& path : options.records) {
    auto record = read_record(path, "report");
    if (!records.empty()) try {
        changes.push_back(study::compare(record, records.back()));
      } catch (const InputError& error) {
        throw InputError(fmt::format("{} and {}: {}", names.back(), path, error.what()),
                         error.code());
      }
    names.push_back(std::filesystem::path(path).stem().string());
    records.push_back(std::move(record));
  }
  const auto sheets = report::history_sheets(records, names, changes);
  report::write(sheets, "clackers/histories/1", results.format(), results.stream(),
                results.style());
  results.finish();
  if (page.wanted() &&
      !page.write(report::html(sheets, fmt::format("{} to {}", names.front(), names.back()),
                               record::provenance(line), nullptr, "report")))
    return 4;
  return record::exit_code(records.back());
}

}  // namespace

void add_report(Grammar& root) {
  const auto options = std::make_shared<ReportOptions>();
  auto* app = root.add_subcommand("report", "RECORD ...", "a history over versions, from records");
  set_help(
      *app,
      {.examples =
           "  clackers verify --exec './solver {case} {h} {out}' --format json --out v1.2.json\n"
           "  clackers report v1.0.json v1.1.json v1.2.json --out history.html\n",
       .about = "Draws order, error and cost over the records of one study, one a version or "
                "commit, oldest first, and marks what changed since the record before by the "
                "rules of --baseline: verdict, behaviour, order beyond both uncertainties, error "
                "at the finest common step, impacts, force evaluations. The name of a record is "
                "that of its file. The exit code is that of the newest record.",
       .usage = "  clackers report RECORD.json ... [--out FILE.html]\n"});
  app->add_option("RECORD", options->records,
                  "Records of verify or check (--format json), of the same cases and steps, oldest "
                  "first.")
      ->reads_file("RECORD.json");
  add_common_options(*app, options->common);
  app->get_option("--out")
      ->description("The page, which opens without a network. The table goes to standard output.")
      ->option_text("FILE.html");
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
