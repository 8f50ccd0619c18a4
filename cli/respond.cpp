#include "clackers/study/respond.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/report/write.hpp"
#include "cli/command.hpp"
#include "cli/help.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/times_file.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

struct Options {
  CommonOptions common;
  std::vector<std::string> settings;
  std::string name, samples, step, times;
  bool collisions = false, plot = false;

  int ways() const {
    return int(!samples.empty()) + int(!step.empty()) + int(!times.empty()) + int(collisions);
  }
};

[[noreturn]] void refuse_usage(const std::string& sentence) {
  throw InputError("respond " + sentence, "bad-syntax");
}

void check(const Options& options) {
  const std::string ways = "one of --samples n, --step h, --times FILE and --collisions";
  if (options.name.empty())
    refuse_usage("needs a CASE, for example three-parameter. All names: clackers list cases");
  if (options.ways() > 1) refuse_usage("takes only " + ways + ".");
  if (options.ways() == 0 && !options.plot)
    refuse_usage("needs times: " + ways + ", or --plot for a picture alone.");
  if (options.ways() == 0 && !options.common.out.empty())
    refuse_usage("--out needs rows to write: " + ways + ". The picture goes to standard output.");
}

// What cannot be printed together.
void check_picture(const Options& options, const Results& results) {
  if (options.plot && !results.is_file() && results.format() != report::Format::table)
    refuse_usage("--plot with --format " + options.common.format +
                 " would draw inside what a program reads. Add --out FILE for the rows, or leave "
                 "one of the two out.");
}

std::unique_ptr<study::RowSource> rows_of(const Options& options, const cases::Case& which) {
  const double end = which.motion->end();
  if (options.collisions) return study::collisions(which);
  if (!options.times.empty()) {
    study::TimeGrid grid;
    grid.times = read_times(options.times, end);
    return study::respond(which, grid);
  }
  if (!options.step.empty())
    return study::respond(which, study::grid_every(read_number("--step", options.step), end));
  constexpr long long any = 1LL << 53;  // what makes sense is the study's to say
  return study::respond(which,
                        study::grid_of(read_whole("--samples", options.samples, -any, any), end));
}

std::string picture(const cases::Case& which, const report::Style& style) {
  // Marks closer than a column cannot be told apart; 1000 are more than any terminal shows.
  constexpr long long most_marks = 1000;
  const auto& motion = *which.motion;
  std::vector<double> impact_times;
  const auto count = std::min(motion.impact_count(motion.end()), most_marks);
  for (long long k = 1; k <= count; ++k) impact_times.push_back(motion.impact(k).t);
  // Eight points a column let a fast oscillation be seen as a band instead of a false slow one.
  return report::plot(study::response_curve(which, 8 * style.width), impact_times, style);
}

int run(const Options& options) {
  check(options);
  Results results(options.common, OnInterrupt::stop);
  check_picture(options, results);
  const auto which = cases::make(options.name, read_settings(options.settings));
  const auto rows = options.ways() > 0 ? rows_of(options, which) : nullptr;
  if (options.plot) {
    OutputStream out(1, "standard output", OnInterrupt::stop);
    out << picture(which, standard_style(options.common.no_color));
    out.finish();
  }
  if (!rows) return 0;
  report::write(*rows, results.format(), results.stream(), results.style());
  results.finish();
  return 0;
}

}  // namespace

Command add_respond(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  auto* app = root.add_subcommand("respond");
  set_help(
      *app,
      {.examples = "  clackers respond three-parameter --samples 1001 --format csv\n"
                   "  clackers respond stop --set eta=0.5 --plot\n",
       .about = "The exact motion of a case. Columns t [s], side, then u [m], v [m/s] and a "
                "[m/s^2] of each mass. Where a time is the double nearest to a collision two "
                "rows stand: side - before it and side + after it.",
       .usage = "  clackers respond CASE [--set name=value,...]\n"
                "           (--samples n | --step h | --times FILE | --collisions) [--plot]\n"});
  app->add_option("CASE", options->name, "The case. All names: clackers list cases.");
  add_set_option(*app, options->settings);
  app->add_option("--samples", options->samples,
                  "Equally spaced times from 0 to the end of the case, both included; 2 to 1e9.")
      ->option_text("n");
  app->add_option("--step", options->step, "Times 0, h, 2 h, ... up to the end; h in seconds.")
      ->option_text("h");
  app->add_option("--times", options->times,
                  "Times from a text file, one a line, in seconds; - reads standard input. What "
                  "follows # or % is a comment.")
      ->option_text("FILE");
  app->add_flag("--collisions", options->collisions,
                "The collisions instead: k, t [s], u1 [m], velocities before and after [m/s], "
                "impulse [N s], energy before and after [J].");
  app->add_flag("--plot", options->plot,
                "Draw the displacements in the terminal; alone, or above the rows.");
  add_common_options(*app, options->common);
  return {app, [options](const std::string&) { return run(*options); }};
}

}  // namespace clackers::cli
