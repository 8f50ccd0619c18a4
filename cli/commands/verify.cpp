#include "clackers/study/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/solvers/program.hpp"
#include "clackers/study/options.hpp"
#include "clackers/study/path/path.hpp"
#include "clackers/study/system_study.hpp"
#include "clackers/tables/listing.hpp"
#include "cli/command.hpp"
#include "cli/commands/verify_programs.hpp"
#include "cli/files/film.hpp"
#include "cli/files/record_output.hpp"
#include "cli/files/report_page.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "cli/progress_line.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

struct Options {
  CommonOptions common;
  std::vector<std::string> methods, cases, settings, requirements, only;
  std::map<std::string, std::string> numbers;  ///< by the names of study::verify_options()
  std::string report, film, baseline, problem, path;
  bool all = false;
  ProgramOptions programs;
};

std::map<std::string, double> numbers_of(const Options& options) {
  using Kind = study::VerifyOption::Kind;
  std::map<std::string, double> numbers;
  for (const auto& option : study::verify_options()) {
    const std::string key(option.name), name = "--" + key;
    const auto& text = options.numbers.at(key);
    if (text.empty()) continue;
    numbers[key] = option.kind == Kind::whole      ? double(read_whole(name, text, 1, option.most))
                   : option.kind == Kind::duration ? read_duration(name, text)
                                                   : read_number(name, text);
  }
  return numbers;
}

study::VerifyRequest request_of(const Options& options, const std::string& line) {
  study::VerifyRequest request;
  request.methods = options.methods;
  if (options.all)
    for (const auto& row : tables::list("pairs").rows)
      request.methods.push_back(std::get<std::string>(row.front()));
  request.cases = options.cases;
  request.settings = read_settings(options.settings, options.problem);
  if (!options.problem.empty())
    for (request.cases = {case_of({}, {}, options.problem)}; const auto& name : options.cases)
      case_of(name, {}, options.problem);
  study::set_options(request, numbers_of(options));
  const auto& tolerances = options.programs.tolerances;
  if (!tolerances.empty()) request.plan.tolerances = solvers::tolerances_from(tolerances);
  request.command = line;
  request.solvers = program_subjects(options.programs);
  return request;
}

[[noreturn]] void refuse_usage(const std::string& sentence) {
  throw InputError("verify " + sentence, "bad-syntax");
}

// As typed, with a hyphen for the blank in the words of a record.
const std::vector<std::string> verdict_names{"disagrees", "undecided", "agrees", "not-claimed",
                                             "refused"};

std::vector<std::string> verdicts_to_show(const Options& options) {
  if (!options.only.empty() && options.common.format != "table")
    refuse_usage("--only: this is for tables; leave --only or --format " + options.common.format +
                 " out.");
  auto words = options.only;
  for (auto& word : words) {
    if (std::ranges::find(verdict_names, word) == verdict_names.end())
      refuse_name("verdict", word, verdict_names,
                  fmt::format("{}", fmt::join(verdict_names, ", ")));
    std::ranges::replace(word, '-', ' ');
  }
  return words;
}

bool is_method(const std::string& word) {
  try {
    study::subject_name(word);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// Cases among the methods are cases: "verify stop newmark".
void take_cases(Options& options) {
  auto& methods = options.methods;
  const auto first = std::stable_partition(methods.begin(), methods.end(),
                                           [](const auto& word) { return !is_case(word); });
  options.cases.insert(options.cases.begin(), first, methods.end());
  methods.erase(first, methods.end());
}

void check(const Options& options) {
  for (const auto& name : options.cases)
    if (!is_case(name) && is_method(name))
      refuse_usage(fmt::format("--case {0}: this is a method, not a case. Write verify {0}", name));
  if (options.all && !options.methods.empty())
    refuse_usage("--all runs every method; leave " + options.methods.front() + " or --all out.");
}

record::Record run_study(const Options& options, const study::VerifyRequest& request) {
  ProgressLine progress("verify", options.common.quiet);
  return study::verify(request, progress.callback(), &interrupt_flag());
}

// The other ladder, of meshes: orders and errors as sheets.
int run_path(const Options& options, const std::string& line) {
  for (const auto& [name, given] : {std::pair{"--film", !options.film.empty()},
                                    {"--tolerances", !options.programs.tolerances.empty()},
                                    {"--baseline", !options.baseline.empty()},
                                    {"--require", !options.requirements.empty()},
                                    {"--only", !options.only.empty()},
                                    {"--all", options.all},
                                    {"--problem", !options.problem.empty()},
                                    {"a second --case", options.cases.size() > 1}})
    if (given) refuse_usage(fmt::format("--path goes without {}; leave it or --path out.", name));
  const auto numbers = numbers_of(options);
  for (const auto& [name, value] : numbers)
    if (name != "levels" && name != "samples-per-level" && name != "jobs")
      refuse_usage(fmt::format("--path goes without --{}; the step follows from the mesh.", name));
  study::PathRequest request;
  request.methods = options.methods;
  request.case_name = options.cases.empty() ? "bar-wall" : options.cases.front();
  request.settings = read_settings(options.settings, {});
  request.solvers = program_subjects(options.programs);
  request.nu.clear();
  for (const auto& part : parts_of("--path", options.path))
    request.nu.push_back(read_number("--path", part));
  const auto take = [&](const char* name, int& to) {
    if (const auto found = numbers.find(name); found != numbers.end()) to = int(found->second);
  };
  take("levels", request.levels);
  take("samples-per-level", request.samples_per_level);
  take("jobs", request.jobs);
  Results results(options.common, OnInterrupt::finish);
  ReportPage page(options.report, options.common, OnInterrupt::finish);
  auto study = [&] {
    ProgressLine progress("verify", options.common.quiet);
    return study::follow_path(request, progress.callback(), &interrupt_flag());
  }();
  const bool written =
      !page.wanted() || page.write(report::html(study.sheets, request.case_name + " along a path",
                                                record::provenance(line), nullptr, "verify"));
  // For a person the curves say it.
  if (results.format() != report::Format::table) study.sheets.push_back(std::move(study.runs));
  report::write(study.sheets, "clackers/path/1", results.format(), results.stream(),
                results.style());
  results.finish();
  if (study.interrupted) report_error("interrupted; the finished rows were kept.", "interrupted");
  return study.interrupted ? 130 : written && !study.failed ? 0 : 4;
}

int run(Options options, const std::string& line) {
  take_cases(options);
  check(options);
  if (!options.path.empty()) return run_path(options, line);
  const auto request = request_of(options, line);
  const auto requirements = read_requirements(options.requirements);
  const RecordView view{.only = verdicts_to_show(options)};
  // Before the work: where it cannot go must not be found out afterwards.
  Results results(options.common, OnInterrupt::finish, report::Content::verdicts);
  const auto baseline = baseline_of(options.baseline, request);
  ReportPage page(options.report, options.common, OnInterrupt::finish);
  if (!options.film.empty() && request.cases.size() > 1)
    refuse_usage("--film shows one case; leave all but one out.");
  Film film(options.film, options.common, OnInterrupt::finish);

  const auto record = run_study(options, request);
  const RecordOutput output(record, baseline, options.common, view);
  bool written = !page.wanted() || page.write(output.html());
  if (film.wanted()) written = film.write(record.cases.front()) && written;
  try {
    if (!try_to_write([&] { output.write(results); })) {
      written = false;
      // The work is done; a person may still read it.
      CommonOptions standard;
      standard.no_color = options.common.no_color;
      if (results.is_file()) {
        Results terminal(standard, OnInterrupt::finish);
        try_to_write([&] { output.write(terminal); });
      }
    }
  } catch (const BrokenPipe&) {
    // `verify | head`: the reader had enough, the verdict still counts.
  }
  output.note_changes(results.format());
  if (record.interrupted) report_error("interrupted; the finished rows were kept.", "interrupted");
  report_failed_solvers(record);
  const int code = required_exit_code(record, requirements);
  return written ? code : 4;
}

}  // namespace

void add_verify(Grammar& root) {
  const auto options = std::make_shared<Options>();
  auto* app = root.add_subcommand("verify", "[METHOD ...]", "assess methods over a range of steps");
  set_help(
      *app,
      {.examples =
           "  clackers verify\n"
           "  clackers verify rk4 newmark:beta=0+penalty --case symmetric-pair --levels 10\n"
           "  clackers verify --report report.html --format json --out record.json\n"
           "  clackers verify --baseline record.json\n"
           "  clackers verify rk4 newmark --case stop --case symmetric-pair\n"
           "  clackers verify --all --only disagrees --only undecided\n"
           "  clackers verify newmark moreau-jean --case bar-wall --path 0.45\n"
           "  clackers verify --exec './solver {case} {h} {out}' --expect proper:2\n",
       .about =
           "Assesses time-integration methods: runs each with a sequence of steps on a case whose "
           "exact motion is known, and compares what was measured with what it claims. A "
           "method is integrator[:name=value,...][+contact[:name=value,...]]; without +contact "
           "impacts are located as events (event-driven). Your own programs (--exec) are run and "
           "compared in the same way. Exit code 0 when all agree, 1 when "
           "one disagrees, 3 when one stays undecided.",
       .usage = "  clackers verify [METHOD ...|--all] [--case CASE ...] [--set name=value,...]\n"
                "           [--levels n] [--coarsest h] [--samples-per-level n] [--budget TIME]\n"
                "           [--jobs n] [--require WHAT] [--baseline FILE.json]\n"
                "           [--only VERDICT] [--report FILE.html] [--film FILE.webm|gif]\n"
                "  clackers verify [METHOD ...] [--exec COMMAND ...] [--case CASE] --path nu,...\n"
                "           [--levels n] [--report FILE.html]\n"
                "  clackers verify [METHOD ...] --exec COMMAND ...\n"
                "           [--name NAME ...] [--expect BEHAVIOUR[:ORDER]] [--tolerances a:b]\n"
                "           [--timeout TIME] [--work FOLDER] [--fresh]\n"
                "           [--environment NAME,...] ...\n"});
  app->add_option("METHOD", options->methods,
                  "Methods, by name (clackers list pairs). Without any, the default panel "
                  "(clackers list methods). Cases may stand among them.");
  app->add_flag(
      "--all", options->all,
      "Every method (clackers list pairs): every integrator with every contact treatment that "
      "takes it, every contact law with two of them, and standalone methods.");
  app->add_option(
         "--case", options->cases,
         "The case (clackers list cases). Default: three-parameter. Several, each with its "
         "own --case, are assessed in turn and compared in a performance profile.")
      ->option_text("CASE");
  add_set_option(*app, options->settings);
  add_problem_option(*app, options->problem);
  for (const auto& option : study::verify_options()) {
    const auto name = "--" + std::string(option.name);
    auto& value = options->numbers[std::string(option.name)];
    app->add_option(name, value, std::string(option.meaning))
        ->option_text(std::string(option.placeholder));
    if (!option.former.empty())
      app->add_option("--" + std::string(option.former), value, "The former name of " + name + ".")
          ->option_text(std::string(option.placeholder));
  }
  app->add_option(
         "--path", options->path,
         "Instead of a fixed mesh: finer and finer meshes of a bar (default bar-wall, "
         "--levels 3, from `elements` on) with steps of nu h/c, 1e-3 to 100, against the "
         "bar itself. Prints orders and those to expect, and of each run the errors of "
         "integrator and mesh. With several nu a table of each method has the errors of "
         "every mesh and step, and the step at which both errors are equal. Programs "
         "(--exec) are to write u and v of all masses at every step; orders are those of a "
         "method of order 2 unless --expect has another.")
      ->option_text("nu,...");
  add_program_options(*app, options->programs);
  add_require_option(*app, options->requirements);
  app->add_option(
         "--only", options->only,
         "Show only methods with this verdict. May be repeated. All are run; reports and other "
         "formats have all.")
      ->option_text(fmt::format("{}", fmt::join(verdict_names, "|")));
  add_report_option(*app, options->report);
  add_film_option(*app, options->film);
  app->add_option(
         "--baseline", options->baseline,
         "An earlier record (--format json) of the same cases and steps, - for standard input: "
         "lists what changed since. The exit code follows from the verdicts only.")
      ->reads_file("FILE.json");
  add_common_options(*app, options->common, report::Content::verdicts);
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
