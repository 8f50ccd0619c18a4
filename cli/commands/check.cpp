#include "clackers/study/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/files/input_file.hpp"
#include "clackers/input/joined_table.hpp"
#include "clackers/input/results/result_table.hpp"
#include "clackers/report/write.hpp"
#include "clackers/study/check/against.hpp"
#include "cli/command.hpp"
#include "cli/files/record_output.hpp"
#include "cli/files/report_page.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "cli/progress_line.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

struct CheckOptions {
  CommonOptions common;
  std::vector<std::string> files, names, labels, against, settings, events, requirements;
  std::vector<std::size_t> starts, against_starts;  // of each name, of --against, in the files
  std::string first_case, case_name, columns, steps, tolerances, expect, tolerance, metrics, report,
      baseline, problem, reader, nodes, component;
  bool impacts = false;
};

std::vector<double> numbers_of(std::string_view option, std::string_view text) {
  std::vector<double> numbers;
  for (const auto& part : parts_of(option, text)) numbers.push_back(read_number(option, part));
  return numbers;
}

std::string reader_names() {
  std::string names;
  for (const auto& reader : input::result_readers())
    names += (names.empty() ? "" : ", ") + reader.name;
  return names;
}

input::ResultChoice results_of(const CheckOptions& options) {
  const auto nodes =
      options.nodes.empty() ? std::vector<std::string>{} : parts_of("--node", options.nodes);
  return input::result_choice(options.reader, nodes, options.component, "--component");
}

// Nodes and directions are those of result files; a pipe is read once, and so not looked into.
void require_result_file(const CheckOptions& options) {
  const bool by_node = !options.nodes.empty();
  if (!by_node && options.component.empty()) return;
  const auto choice = results_of(options);
  const auto may_have_nodes = [&](const std::string& given) {
    return std::ranges::any_of(input::joined_paths(given), [&](const std::string& path) {
      if (!std::filesystem::is_regular_file(path)) return true;
      InputFile file(path);
      return input::result_reader_of(file, choice) != nullptr;
    });
  };
  if (std::ranges::none_of(options.files, may_have_nodes) &&
      std::ranges::none_of(options.against, may_have_nodes))
    refuse("check", by_node ? "--node" : "--component", by_node ? options.nodes : options.component,
           "beside a result file of another program",
           "The columns of a table are named by its header or --columns.", "bad-syntax");
}

// Each name with the files behind it.
std::vector<study::NamedHistories> subjects_of(const CheckOptions& options) {
  const auto& [files, starts] = std::tie(options.files, options.starts);
  if (options.names.empty()) return {{.files = {files.begin(), files.end()}}};
  if (starts.front() > 0)
    refuse("check", "FILE before the first --name", files.front(),
           "every FILE behind the --name of its solver", {}, "bad-syntax");
  std::vector<study::NamedHistories> subjects;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const auto end = i + 1 < starts.size() ? starts[i + 1] : files.size();
    subjects.push_back(
        {{files.begin() + std::ptrdiff_t(starts[i]), files.begin() + std::ptrdiff_t(end)},
         options.names[i]});
  }
  return subjects;
}

study::CheckRequest request_of(const CheckOptions& options, const std::string& line) {
  study::CheckRequest request;
  request.subjects = subjects_of(options);
  request.case_name = case_of(options.first_case, options.case_name, options.problem);
  request.settings = read_settings(options.settings, options.problem);
  if (!options.columns.empty()) request.columns = parts_of("--columns", options.columns);
  request.results = results_of(options);
  request.events.assign(options.events.begin(), options.events.end());
  if (!options.steps.empty()) request.steps = numbers_of("--steps", options.steps);
  if (!options.tolerances.empty())
    request.tolerances = numbers_of("--tolerances", options.tolerances);
  request.labels = read_labels(options.labels);
  if (!options.expect.empty()) request.expect = study::claim_from(options.expect);
  if (!options.tolerance.empty()) request.tolerance = read_number("--tolerance", options.tolerance);
  if (!options.metrics.empty() && options.metrics != "all")
    refuse_name("metrics", options.metrics, std::vector<std::string>{"all"}, "all");
  request.command = line;
  return request;
}

// Without an exact motion: the exit code is that of the tolerance.
int run_against(const CheckOptions& options, const Command& command, const std::string& line) {
  constexpr auto fitting = std::to_array<std::string_view>(
      {"--against", "--columns", "--reader", "--node", "--component", "--steps", "--tolerances",
       "--tolerance", "--report", "--format", "--out"});
  const auto is_wrong = [&](const Option& option) {
    return std::ranges::find(fitting, option.name) == fitting.end() &&
           (!option.values().empty() || (option.name == "--impacts" && options.impacts));
  };
  const auto wrong = std::ranges::find_if(command.options, is_wrong);
  if (options.against.size() > 1)
    throw InputError("check: --against is given twice; allowed: once, between two sets of FILEs.",
                     "bad-syntax");
  if (wrong != command.options.end())
    throw InputError(
        fmt::format("check: {} is for an exact motion, and --against has none; leave one of them "
                    "out. Options that --against takes: {}.",
                    wrong->name, fmt::join(fitting.begin() + 1, fitting.end(), ", ")),
        "bad-syntax");
  study::AgainstRequest request;
  const auto middle = options.files.begin() + std::ptrdiff_t(options.against_starts.front());
  request.sets[0].assign(options.files.begin(), middle);
  request.sets[1].assign(options.against.begin(), options.against.end());
  request.sets[1].insert(request.sets[1].end(), middle, options.files.end());
  if (!options.columns.empty()) request.columns = parts_of("--columns", options.columns);
  if (!options.steps.empty()) request.steps = numbers_of("--steps", options.steps);
  if (!options.tolerances.empty())
    request.tolerances = numbers_of("--tolerances", options.tolerances);
  if (!options.tolerance.empty()) request.tolerance = read_number("--tolerance", options.tolerance);
  request.results = results_of(options);
  ReportPage page(options.report, options.common, OnInterrupt::stop);
  Results results(options.common, OnInterrupt::stop);
  auto found = study::check_against(request, &interrupt_flag());
  report::write(found.sheets, "clackers/against/1", results.format(), results.stream(),
                results.style());
  results.finish();
  found.sheets.push_back(std::move(found.differences));
  if (page.wanted() && !page.write(report::html(found.sheets, "Two solvers, no exact motion",
                                                record::provenance(line), nullptr, "check")))
    return 4;
  return !found.is_within ? 3 : *found.is_within ? 0 : 1;
}

record::Record run_check(const CheckOptions& options, const study::CheckRequest& request) {
  ProgressLine progress("check", options.common.quiet);
  return study::check(request, progress.callback(), &interrupt_flag());
}

// "check CASE FILE ...": a file of that name is ./CASE.
void take_case_first(CheckOptions& options) {
  const auto is_behind = [](std::size_t start) { return start > 0; };
  if (options.files.empty() || !is_case(options.files.front()) ||
      !std::ranges::all_of(options.starts, is_behind) ||
      !std::ranges::all_of(options.against_starts, is_behind))
    return;
  options.first_case = options.files.front();
  options.files.erase(options.files.begin());
  for (auto* starts : {&options.starts, &options.against_starts})
    for (auto& start : *starts) --start;
}

int run(CheckOptions options, const Command& command, const std::string& line) {
  take_case_first(options);
  require_result_file(options);
  if (!options.against.empty()) return run_against(options, command, line);
  const auto request = request_of(options, line);
  const auto requirements = read_requirements(options.requirements);
  const auto baseline = baseline_of(options.baseline, request);
  ReportPage page(options.report, options.common, OnInterrupt::stop);
  Results results(options.common, OnInterrupt::stop, report::Content::verdicts);
  const auto record = run_check(options, request);
  const RecordOutput output(record, baseline, options.common,
                            {.all_metrics = options.metrics == "all", .impacts = options.impacts});
  const bool written = !page.wanted() || page.write(output.html());
  try {
    output.write(results);
  } catch (const BrokenPipe&) {
    // `check | head`: the reader had enough, the verdict still counts.
  }
  output.note_changes(results.format());
  return written ? required_exit_code(record, requirements) : 4;
}

}  // namespace

void add_check(Grammar& root) {
  const auto options = std::make_shared<CheckOptions>();
  auto* app = root.add_subcommand("check", "FILE ...", "assess time histories of any program");
  set_help(
      *app,
      {.examples = "  clackers check disp.csv\n"
                   "  clackers check h0.01.csv h0.005.csv h0.0025.csv h0.00125.csv "
                   "--expect proper:2\n"
                   "  clackers check node.out --columns t,u1,u2 --events hits.csv "
                   "--tolerance 1e-3\n"
                   "  clackers check h*.npy --expect proper:2\n"
                   "  clackers check --name A a*.csv --name B b*.csv --report both.html\n"
                   "  ./solver | clackers check - --case stop\n",
       .about =
           "Assesses time histories that any program wrote, against the exact motion of a case. "
           "Text with comma, semicolon, tab or blank separation, or NumPy's format (.npy); columns "
           "t, u1, v1, a1, u2, ... by header, fields or --columns; a time that appears twice has "
           "both limits of a jump. Several files are levels of one method and give an order; with --name several "
           "methods stand in one table. "
           "Exit code 0 when the history agrees or nothing is expected, 1 when it disagrees or is "
           "of another motion, 3 when undecided.",
       .usage = "  clackers check [CASE] FILE ...|- [--case CASE] [--set name=value,...]\n"
                "  clackers check --name A FILE ... --name B FILE ... [...]\n"
                "  clackers check FILE ... --against FILE ... [--tolerance x]\n"
                "           [--columns t,u1,...] [--events FILE]\n"
                "           [--reader READER] [--node n1,n2,...] [--component 1|2|3]\n"
                "           [--steps h1,h2,...|--tolerances a,b,...]\n"
                "           [--expect BEHAVIOUR[:ORDER]] [--tolerance x] [--require WHAT]\n"
                "           [--metrics all] [--impacts] [--report FILE.html]\n"
                "           [--baseline FILE.json]\n"});
  app->add_option(
         "FILE", options->files,
         "Time histories: text, .npy or result files of other programs; - for standard input, a+b for "
         "files of columns joined on their times. A case may stand before them.")
      ->reads_file("");
  app->add_option("--name", options->names,
                  "The name of the solver that wrote the FILEs behind it, up to the next --name: "
                  "several solvers are judged in one table and page. Options with one value a "
                  "file count over all files.")
      ->option_text("NAME")
      ->divides(options->files, options->starts);
  add_label_option(*app, options->labels);
  app->add_option("--against", options->against,
                  "Compare the FILEs before it with those behind it, of a motion that nobody "
                  "knows: displacements of the finest two at common times, and each set with "
                  "itself. --tolerance is the largest difference over the largest displacement.")
      ->reads_file("FILE ...")
      ->divides(options->files, options->against_starts);
  app->add_option("--case", options->case_name,
                  "The case (clackers list cases). Default: three-parameter.")
      ->option_text("CASE");
  add_set_option(*app, options->settings);
  add_problem_option(*app, options->problem);
  app->add_option(
         "--columns", options->columns,
         "Names of the columns where a header lacks or differs, and of a plain .npy array: "
         "t,u1,_,v1; _ skips one.")
      ->option_text("t,u1,...");
  app->add_option(
         "--reader", options->reader,
         "Forces the reader of result files, which otherwise are known by their first bytes: " +
             reader_names() + "; or table.")
      ->option_text("READER");
  app->add_option("--node", options->nodes,
                  "Nodes of a result file, one a mass. Default: all, in the order of the file.")
      ->option_text("n1,n2,...");
  app->add_option(
         "--component", options->component,
         "Direction in a result file; coor1 reads the coordinate as u, not the displacement. Default: 1.")
      ->option_text("1|2|3|coor1|coor2|coor3");
  app->add_option(
         "--events", options->events,
         "Impacts of the history, text or .npy: a column t and optionally "
         "impulse,v1-,v1+,v2-,v2+; of a case with several contacts also contact, from 0. Of several "
         "histories one file each, in their order. Without it impacts are found in the "
         "history.")
      ->reads_file("FILE");
  app->add_option(
         "--steps", options->steps,
         "Step of each history [s], in the order of the files; also the time between rows "
         "of files without a column t. Default: h0.01, dt=0.01 or N400 (steps) in a file's "
         "name, else the median time between rows.")
      ->option_text("h1,h2,...");
  app->add_option("--tolerances", options->tolerances,
                  "Tolerance of each history of an adaptive solver, in the order of the files: the "
                  "levels are tolerances then. Default: rtol1e-06 in the files' names.")
      ->option_text("a,b,...");
  app->add_option("--expect", options->expect,
                  "What the histories should show: proper:2, reduced:1, irregular:1, exact, "
                  "stagnating[:REASON] or divergent; velocity:1, alone or behind a comma, for the "
                  "order of the velocities.")
      ->option_text("BEHAVIOUR[:ORDER|REASON]");
  app->add_option("--tolerance", options->tolerance,
                  "Largest error in u, relative to the largest envelope, of the finest history.")
      ->option_text("x");
  app->add_option(
         "--metrics", options->metrics,
         "all: every metric in the table, not only those that reports show first (clackers "
         "list metrics). csv and json always hold all.")
      ->option_text("all");
  app->add_flag("--impacts", options->impacts,
                "A table of the impacts of the finest history: speeds, restitution, momentum, "
                "lateness. json always holds it.");
  add_require_option(*app, options->requirements);
  add_report_option(*app, options->report);
  app->add_option(
         "--baseline", options->baseline,
         "An earlier record of check (--format json) of the same case, - for standard input: lists "
         "what changed since. The exit code follows from the verdicts only.")
      ->reads_file("FILE.json");
  add_common_options(*app, options->common, report::Content::verdicts);
  app->run = [options, app](const std::string& line) { return run(*options, *app, line); };
}

}  // namespace clackers::cli
