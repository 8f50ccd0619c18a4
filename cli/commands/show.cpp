#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/write.hpp"
#include "clackers/tables/listing.hpp"
#include "clackers/tables/respond.hpp"
#include "cli/command.hpp"
#include "cli/commands/dials.hpp"
#include "cli/files/report_page.hpp"
#include "cli/files/results.hpp"
#include "cli/options.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

struct ShowOptions {
  CommonOptions common;
  std::vector<std::string> settings;
  std::string name, behind, threshold, report, problem;
};

// Refuses a name that is neither a case nor the beginning of a method's specification.
void require_method(const std::string& specification) {
  std::vector<std::string> known;
  for (const auto& row : tables::list("methods").rows)
    known.push_back(std::get<std::string>(row.front()));
  const auto name = specification.substr(0, specification.find_first_of(":+"));
  if (std::ranges::find(known, name) != known.end()) return;
  for (const auto& entry : cases::entries()) known.push_back(entry.name);
  refuse_name("case or method", name, known, "clackers list");
}

std::vector<record::Sheet> sheets_of(const ShowOptions& options) {
  if (options.name.empty())
    throw InputError(
        "show needs a CASE or METHOD, for example three-parameter. All names: clackers list",
        "bad-syntax");
  const auto settings = read_settings(options.settings, options.problem);
  const double threshold = options.threshold.empty()
                               ? cases::default_threshold
                               : read_number("--threshold", options.threshold);
  if (is_case(options.name)) return tables::show_case(options.name, settings, threshold);
  require_method(options.name);
  if (!settings.empty() || !options.threshold.empty())
    throw InputError("show " + options.name +
                         ": --set and --threshold are for cases. Parameters of a method stand in "
                         "its name: newmark:beta=0.25",
                     "bad-syntax");
  return tables::show_method(options.name);
}

int run(ShowOptions options, const std::string& line) {
  options.name = case_of(options.name, options.behind, options.problem);
  ReportPage page(options.report, options.common, OnInterrupt::stop);
  Results results(options.common, OnInterrupt::stop);
  const auto sheets = sheets_of(options);
  // Only json has a place for it.
  const bool with_problem = results.format() == report::Format::json && is_case(options.name);
  const auto problem =
      with_problem
          ? tables::show_problem(options.name, read_settings(options.settings, options.problem))
          : std::string();
  report::write(sheets, "clackers/show/1", results.format(), results.stream(), results.style(),
                problem);
  results.finish();
  if (!page.wanted()) return 0;
  std::optional<record::CaseRecord> motion;
  std::optional<report::Dials> dials;
  if (is_case(options.name)) {
    const auto test_case =
        cases::make(options.name, read_settings(options.settings, options.problem));
    motion = tables::response_record(test_case);
    dials = usual_dials(test_case);
  }
  return page.write(report::html(sheets, options.name, record::provenance(line),
                                 motion ? &*motion : nullptr, "show", dials))
             ? 0
             : 4;
}

}  // namespace

void add_show(Grammar& root) {
  const auto options = std::make_shared<ShowOptions>();
  auto* app = root.add_subcommand("show", "CASE|METHOD", "one case or method in full");
  set_help(
      *app,
      {.examples = "  clackers show three-parameter --set N=3,xi1=0.1\n"
                   "  clackers show newmark:beta=0.25,gamma=0.5\n"
                   "  clackers show generalized-alpha:rho=0.8 --report page.html\n",
       .about = "Of a case: parameters, derived constants, the indicators I_ms, T_L, T_S and "
                "I_OC, the admissibility margin, the conditioning and the first impacts. Of "
                "a method: what it claims; period elongation, amplitude decay, spectral radius "
                "and overshoot of its integrator; its parameters and its card.",
       .usage = "  clackers show CASE|METHOD [--set name=value,...] [--threshold x]\n"
                "                [--report FILE.html]\n"
                "  clackers show --problem FILE\n"});
  app->add_option("NAME", options->name, "A case or a method. All names: clackers list.")
      ->option_text("CASE|METHOD");
  add_case_option(*app, options->behind);
  add_set_option(*app, options->settings);
  add_problem_option(*app, options->problem);
  app->add_option("--threshold", options->threshold,
                  "A frequency contributes non-trivially where its amplitude is above this part of "
                  "the spectral peak (T_S and I_OC depend on it); between 0 and 1, dimensionless. "
                  "Default: 0.1.")
      ->option_text("x");
  app->add_option("--report", options->report,
                  "Also write a page with the tables and figures, of a case its motion as an "
                  "animation, that opens without a network, whole or not at all.")
      ->writes_file("FILE.html");
  add_common_options(*app, options->common);
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
