#include "clackers/tables/respond.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/write.hpp"
#include "clackers/tables/listing.hpp"
#include "cli/command.hpp"
#include "cli/commands/dials.hpp"
#include "cli/files/film.hpp"
#include "cli/files/paths.hpp"
#include "cli/files/report_page.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

struct RespondOptions {
  CommonOptions common;
  std::vector<std::string> settings;
  std::string name, behind, samples, step, times, digits, sensitivity, highest, report, film,
      problem, at;
  bool impacts = false, plot = false, energy = false, spectrum = false, forces = false;

  int ways() const {
    return int(!samples.empty()) + int(!step.empty()) + int(!times.empty()) + int(impacts);
  }
};

// What the rows are of, where it is not the response; empty when it is.
std::vector<std::string> other_kinds(const RespondOptions& options) {
  std::vector<std::string> kinds;
  if (options.energy) kinds.push_back("--energy");
  if (options.spectrum) kinds.push_back("--spectrum");
  if (!options.at.empty()) kinds.push_back("--at");
  if (options.forces) kinds.push_back("--forces");
  if (!options.sensitivity.empty()) kinds.push_back("--sensitivity");
  return kinds;
}

void check(const RespondOptions& options) {
  const std::string ways = "one of --samples n, --step h, --times FILE and --impacts";
  if (options.name.empty())
    refuse_usage("respond",
                 "needs a CASE, for example three-parameter. All names: clackers list cases");
  if (options.ways() > 1) refuse_usage("respond", "takes only " + ways + ".");
  if (options.ways() == 0 && !options.plot && options.report.empty() && options.film.empty())
    refuse_usage("respond",
                 "needs times: " + ways + ", or --plot, --report or --film for only a picture.");
  if (options.ways() == 0 && !options.common.out.empty())
    refuse_usage("respond",
                 "--out needs rows to write: " + ways + ". The picture goes to standard output.");
  if (!options.digits.empty() && options.plot)
    refuse_usage("respond",
                 "draws --plot with doubles and cannot show --digits. Leave one of the two out.");
}

void check_kind(const RespondOptions& options) {
  const auto kinds = other_kinds(options);
  if (!options.highest.empty() && !options.spectrum)
    refuse_usage("respond",
                 "--highest is the highest frequency of --spectrum; add it, or leave it out.");
  if (kinds.empty()) return;
  if (kinds.size() > 1)
    refuse_usage("respond",
                 "takes only one of --at, --energy, --forces, --spectrum and --sensitivity; " +
                     kinds[0] + " and " + kinds[1] + " were given.");
  if (options.impacts && options.at.empty())
    refuse_usage("respond", kinds[0] + " has rows of its own and takes no --impacts.");
  if (!options.digits.empty())
    refuse_usage("respond", kinds[0] + " is computed in doubles and takes no --digits.");
  if (options.ways() == 0)
    refuse_usage(
        "respond",
        kinds[0] + (options.spectrum ? " needs --samples n, the number of frequencies."
                                     : " needs times: one of --samples n, --step h" +
                                           std::string(options.at.empty() ? "" : ", --impacts") +
                                           " and --times FILE."));
  if (options.spectrum && options.samples.empty())
    refuse_usage("respond",
                 "--spectrum takes frequencies, not times: --samples n of them up to --highest w.");
  if (options.spectrum && options.highest.empty())
    refuse_usage("respond", "--spectrum needs --highest w, the highest frequency in rad/s.");
}

// What cannot be written together or where it is to go.
void check_format(const RespondOptions& options, const Results& results) {
  const bool npy = results.format() == report::Format::npy;
  if (npy && !options.digits.empty())
    refuse_usage("respond", "--digits is text and --format npy holds doubles. Use csv or json.");
  if (npy && results.is_terminal())
    refuse_usage("respond",
                 "--format npy is bytes that a terminal cannot show. Add --out FILE, or send them "
                 "to a program.");
  if (options.plot && !results.is_file() && results.format() != report::Format::table)
    refuse_usage(
        "respond",
        "--plot with --format " + options.common.format +
            " would draw inside what a program reads. Add --out FILE for the rows, or leave "
            "one of the two out.");
}

std::unique_ptr<record::RowSource> rows_of(const RespondOptions& options,
                                           const cases::Case& test_case) {
  const double end = test_case.motion->end();
  const bool digits = !options.digits.empty();
  const auto count = digits ? read_whole("--digits", options.digits, 1, 1000) : 0;
  const auto respond = [&](const tables::TimeGrid& grid) {
    if (options.energy) return tables::energies(test_case, grid);
    if (!options.at.empty()) {
      std::vector<double> places;
      for (const auto& part : parts_of("--at", options.at))
        places.push_back(read_number("--at", part));
      return tables::points(test_case, grid, places);
    }
    if (options.forces) return tables::forces(test_case, grid);
    if (!options.sensitivity.empty())
      return tables::sensitivity(test_case, grid, options.sensitivity);
    return digits ? tables::respond(test_case, grid, count) : tables::respond(test_case, grid);
  };
  if (options.impacts && !options.at.empty()) return respond(tables::contact_grid(test_case));
  if (options.impacts)
    return digits ? tables::impacts(test_case, count) : tables::impacts(test_case);
  if (!options.times.empty()) {
    tables::TimeGrid grid;
    grid.times = read_times(options.times, end);
    return respond(grid);
  }
  if (!options.step.empty())
    return respond(tables::grid_every(read_number("--step", options.step), end));
  constexpr long long any = 1LL << 53;  // what makes sense is the study's to say
  const auto samples = read_whole("--samples", options.samples, -any, any);
  if (options.spectrum)
    return tables::spectrum(test_case, samples, read_number("--highest", options.highest));
  return respond(tables::grid_of(samples, end));
}

std::string picture(const cases::Case& test_case, const report::Style& style) {
  // Marks closer than a column coincide; 1000 are more than any terminal shows.
  constexpr long long most_marks = 1000;
  const auto& motion = *test_case.motion;
  std::vector<double> impact_times;
  const auto count = std::min(motion.impact_count(motion.end()), most_marks);
  for (long long k = 1; k <= count; ++k) impact_times.push_back(motion.impact(k).t);
  // Eight points a column let a fast oscillation be seen as a band instead of a false slow one.
  return report::plot(tables::response_curve(test_case, 8 * style.width), impact_times, style);
}

std::string page_of(const cases::Case& test_case, const RespondOptions& options,
                    const std::string& line) {
  const auto motion = tables::response_record(test_case);
  return report::html(
      tables::show_case(options.name, read_settings(options.settings, options.problem),
                        cases::default_threshold),
      options.name, record::provenance(line), &motion, "respond", usual_dials(test_case));
}

int run(RespondOptions options, const std::string& line) {
  options.name = case_of(options.name, options.behind, options.problem);
  check_kind(options);
  check(options);
  ReportPage page(options.report, options.common, OnInterrupt::stop);
  Film film(options.film, options.common, OnInterrupt::stop);
  Results results(options.common, OnInterrupt::stop, report::Content::numbers);
  check_format(options, results);
  const auto test_case =
      cases::make(options.name, read_settings(options.settings, options.problem));
  const auto rows = options.ways() > 0 ? rows_of(options, test_case) : nullptr;
  if (rows) {
    write_rows(*rows, results, "respond", options.common.quiet);
    results.finish();
  }
  if (options.plot) {
    OutputStream out(1, "standard output", OnInterrupt::stop);
    out << picture(test_case, standard_style(options.common.no_color));
    out.finish();
  }
  bool written = !page.wanted() || page.write(page_of(test_case, options, line));
  if (film.wanted()) written = film.write(tables::response_record(test_case)) && written;
  return written ? 0 : 4;
}

}  // namespace

void add_respond(Grammar& root) {
  const auto options = std::make_shared<RespondOptions>();
  auto* app = root.add_subcommand("respond", "CASE ...", "the exact motion of a case");
  set_help(
      *app,
      {.examples = "  clackers respond three-parameter --samples 1001 --format csv\n"
                   "  clackers respond stop --set eta=0.5 --plot\n"
                   "  clackers respond three-parameter --sensitivity k2 --samples 201\n"
                   "  clackers respond stop --spectrum --samples 201 --highest 20\n",
       .about = "The exact motion of a case. Columns t [s], side, then u [m], v [m/s] and a "
                "[m/s^2] of each mass. Where a time is the double nearest to an impact two "
                "rows stand: side - before it and side + after it.",
       .usage = "  clackers respond CASE [--set name=value,...]\n"
                "           (--samples n | --step h | --times FILE | --impacts)\n"
                "           [--digits n] [--plot] [--report FILE.html] [--film FILE.webm|gif]\n"
                "  clackers respond CASE [--set ...]\n"
                "           (--energy | --forces | --at x,... | --sensitivity NAME)\n"
                "           (--samples n | --step h | --times FILE) [--plot]\n"
                "  clackers respond CASE [--set ...] --at x,... --impacts\n"
                "  clackers respond CASE [--set ...] --spectrum --samples n --highest w\n"});
  app->add_option("CASE", options->name, "The case. All names: clackers list cases.");
  add_case_option(*app, options->behind);
  add_set_option(*app, options->settings);
  add_problem_option(*app, options->problem);
  app->add_option(
         "--samples", options->samples,
         "Equally spaced times from 0 to the end of the case, both included; 2 to 1e9. With "
         "--spectrum, frequencies from 0 to the highest.")
      ->option_text("n");
  app->add_option("--step", options->step, "Times 0, h, 2 h, ... up to the end; h in seconds.")
      ->option_text("h");
  app->add_option(
         "--times", options->times,
         "Times in seconds from a text file, one a line, or from the column t of a history; - "
         "reads standard input. What follows # or % is a comment.")
      ->reads_file("FILE");
  app->add_flag(
      "--impacts", options->impacts,
      "The impacts instead: k, t [s], of several contacts which, from 0, u1 [m], velocities "
      "before and after [m/s], impulse [N s], energy before and after [J]. With --at, the points "
      "where the contact of the bars or the string closes and opens.");
  app->add_flag("--collisions", options->impacts, "The former name of --impacts.");
  app->add_flag(
      "--energy", options->energy,
      "At the times, the energy instead: kinetic, potential of springs and constant loads, "
      "dissipated by dashpots and friction so far, lost at impacts so far, work of loads "
      "that vary and of belts so far, the total of the first four less the work [J], and the "
      "momentum [kg m/s].");
  app->add_flag(
      "--forces", options->forces,
      "At the times, the forces of contacts that stay closed, then of one-sided springs, instead: "
      "force1, force2, ... [N], 0 for open ones; their impulses so far, with those of impacts: impulse1, ... [N s]; then "
      "the forces of dry friction: friction1, ... [N].");
  app->add_option(
         "--at", options->at,
         "At the times, points of the case's bars or string instead, at x from the contact [m] (of "
         "string-on-obstacle from its left end): u [m], v [m/s] and stress [N/m^2] or transverse force [N] of each, then force [N], impulse "
         "[N s] and energies [J].")
      ->option_text("x,...");
  app->add_option(
         "--sensitivity", options->sensitivity,
         "At the times, the response columns differentiated by NAME: m1 m2 k1 k2 c1 c2 eta "
         "gap u10 u20 v10 v20 with all else fixed, or a parameter of the case with all "
         "that follows from it; class:m1, class:k1 where both have the name.")
      ->option_text("NAME");
  app->add_flag("--spectrum", options->spectrum,
                "The Fourier transform of the displacements over the run instead: omega [rad/s], "
                "real and imaginary part [m s] of each mass; takes --samples and --highest.");
  app->add_option("--highest", options->highest, "The highest frequency of --spectrum, in rad/s.")
      ->option_text("w");
  app->add_option("--digits", options->digits,
                  "Correctly rounded to n significant digits, 1 to 1000, from an enclosure; with "
                  "--samples, --step, --times or --impacts, whose t is then the true instant.")
      ->option_text("n");
  app->add_flag("--plot", options->plot,
                "Draw the displacements in the terminal; alone, or below the rows.");
  app->add_option("--report", options->report,
                  "Also write a page with the response and the motion as an animation, which opens "
                  "without a network, whole or not at all.")
      ->writes_file("FILE.html");
  add_film_option(*app, options->film);
  add_common_options(*app, options->common, report::Content::numbers);
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
