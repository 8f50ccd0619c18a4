#include "cli/options.hpp"

#include <fmt/format.h>

namespace clackers::cli {

void add_common_options(Command& command, CommonOptions& options, report::Content content) {
  const auto formats = report::formats_of(content);
  std::string names, notes;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    names += fmt::format("{}{}", i == 0 ? "" : "|", formats[i].name);
    notes += fmt::format("{}{} ({})",
                         i == 0                    ? ""
                         : i + 1 == formats.size() ? " or "
                                                   : ", ",
                         formats[i].name, formats[i].note);
  }
  command.add_option("--format", options.format, notes + ". Default: table.")->option_text(names);
  command
      .add_option("--out", options.out,
                  "Write the result to FILE instead of standard output, whole or not at all.")
      ->writes_file("FILE");
  command.add_flag("--quiet", options.quiet,
                   "No progress and no notes on standard error; refusals still appear.");
  command.add_flag("--no-color", options.no_color,
                   "No colors; the environment variable NO_COLOR does the same.");
}

void add_case_option(Command& command, std::string& name) {
  command.add_option("--case", name, "The case, instead of naming it first.")->option_text("CASE");
}

void add_set_option(Command& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "Parameters of the case in SI units: xi1=0.1,N=3 (may be repeated). Their names, "
                  "units and ranges: clackers show CASE.")
      ->option_text("name=value,...");
}

void add_problem_option(Command& command, std::string& path) {
  command
      .add_option(
          "--problem", path,
          "Instead of a case, a problem of your own: M, C, K, contacts, start, loads and end in "
          "a TOML file, SI units, or what show CASE --format json writes (the case piecewise). Its "
          "format: the manual's how-to \"Solve a problem of your own\".")
      ->reads_file("FILE");
}

void add_report_option(Command& command, std::string& path) {
  command
      .add_option("--report", path,
                  "Also write a page with verdicts, figures and provenance that opens without a "
                  "network, whole or not at all.")
      ->writes_file("FILE.html");
}

}  // namespace clackers::cli
