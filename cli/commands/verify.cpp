#include "clackers/study/verify.hpp"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/report/case_studies.hpp"
#include "clackers/report/changes.hpp"
#include "clackers/report/write.hpp"
#include "clackers/study/baseline.hpp"
#include "clackers/study/case_studies.hpp"
#include "clackers/study/listing.hpp"
#include "cli/command.hpp"
#include "cli/files/input_files.hpp"
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
  std::vector<std::string> methods, cases, settings;
  std::string levels, coarsest, neighbours, jobs, report, baseline;
  bool all = false;
};

study::VerifyRequest request_of(const Options& options, const std::string& line) {
  constexpr auto any = std::numeric_limits<int>::max();
  const auto whole = [](const char* name, const std::string& text, int lowest, int standard) {
    return text.empty() ? standard : static_cast<int>(read_whole(name, text, lowest, any));
  };
  study::VerifyRequest request;
  request.methods = options.methods;
  if (options.all)
    for (const auto& row : study::list("pairs").rows)
      request.methods.push_back(std::get<std::string>(row.front()));
  if (!options.cases.empty()) request.case_name = options.cases.front();
  request.settings = read_settings(options.settings);
  auto& plan = request.plan;
  plan.levels = whole("--levels", options.levels, 1, plan.levels);
  plan.neighbours = whole("--neighbours", options.neighbours, 1, plan.neighbours);
  if (!options.coarsest.empty()) plan.coarsest = read_number("--coarsest", options.coarsest);
  request.jobs = whole("--jobs", options.jobs, 1, request.jobs);
  request.command = line;
  return request;
}

[[noreturn]] void refuse_usage(const std::string& sentence) {
  throw InputError("verify " + sentence, "bad-syntax");
}

void check(const Options& options) {
  if (options.all && !options.methods.empty())
    refuse_usage("--all runs every method; leave " + options.methods.front() + " or --all out.");
  for (const auto& method : options.methods)
    for (const auto& entry : cases::entries())
      if (entry.name == method)
        refuse_usage(fmt::format("{0}: this is a case, not a method. Write --case {0}", method));
}

study::Record run_study(const Options& options, const study::VerifyRequest& request) {
  ProgressLine line("verify", options.common.quiet);
  return study::verify(
      request, [&](double share) { line.report(share); }, &interrupt_flag());
}

using Changes = std::optional<study::BaselineComparison>;

const study::BaselineComparison* pointer(const Changes& changes) {
  return changes ? &*changes : nullptr;
}

void print(const study::Record& record, const Changes& changes, Results& to) {
  report::write(record, to.format(), to.stream(), to.style(), pointer(changes));
  to.finish();
}

// A format without a place for changes leaves them to standard error.
void note_changes(const study::BaselineComparison& changes) {
  std::ostringstream text;
  report::write_changes(changes, text, {});
  std::istringstream lines(text.str());
  for (std::string line; std::getline(lines, line);) note(line);
}

// Before the work: what cannot be compared must not be found out afterwards.
std::optional<study::Record> baseline_of(const Options& options,
                                         const study::VerifyRequest& request) {
  if (options.baseline.empty()) return {};
  auto baseline = read_baseline(options.baseline);
  study::require_same_study(request, baseline);
  return baseline;
}

void check_several(const Options& options, report::Format format) {
  const std::string hint = "leave one --case, or take --format json.";
  if (!options.baseline.empty())
    refuse_usage("--baseline compares studies of one case; leave one --case.");
  if (!options.report.empty()) refuse_usage("--report shows one case; " + hint);
  if (!report::takes_several_cases(format))
    refuse_usage("--format " + options.common.format + " has no place for several cases; " + hint);
}

int run_several(const Options& options, const study::VerifyRequest& request) {
  check_several(options, report::format_from(options.common.format, report::Content::verdicts));
  Results results(options.common, OnInterrupt::finish, report::Content::verdicts);
  const auto studies = [&] {
    ProgressLine line("verify", options.common.quiet);
    return study::verify_cases(
        request, options.cases, [&](double share) { line.report(share); }, &interrupt_flag());
  }();
  bool written = true;
  try {
    written = try_to_write([&] {
      report::write(studies, results.format(), results.stream(), results.style());
      results.finish();
    });
  } catch (const BrokenPipe&) {
    // `verify | head`: the reader had enough, the verdict still counts.
  }
  const int code = study::exit_code(studies);
  if (code == 130) report_error("interrupted; the finished rows were kept.", "interrupted");
  return written ? code : 4;
}

int run(const Options& options, const std::string& line) {
  check(options);
  const auto request = request_of(options, line);
  if (options.cases.size() > 1) return run_several(options, request);
  // Before the work: where it cannot go must not be found out afterwards.
  Results results(options.common, OnInterrupt::finish, report::Content::verdicts);
  const auto baseline = baseline_of(options, request);
  ReportPage page(options.report, options.common, OnInterrupt::finish);

  const auto record = run_study(options, request);
  Changes changes;
  if (baseline) changes = study::compare(record, *baseline);

  bool written = true;
  if (page.wanted()) written = page.write(report::html(record, pointer(changes)));
  try {
    if (!try_to_write([&] { print(record, changes, results); })) {
      written = false;
      // The work is done; a person may still read it.
      CommonOptions standard;
      standard.no_color = options.common.no_color;
      if (results.is_file()) {
        Results terminal(standard, OnInterrupt::finish);
        try_to_write([&] { print(record, changes, terminal); });
      }
    }
  } catch (const BrokenPipe&) {
    // `verify | head`: the reader had enough, the verdict still counts.
  }
  if (changes && !report::tells_changes(results.format()) && !options.common.quiet)
    note_changes(*changes);
  if (record.interrupted) report_error("interrupted; the finished rows were kept.", "interrupted");
  return written ? study::exit_code(record) : 4;
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
           "  clackers verify rk4 newmark --case stop --case symmetric-pair\n",
       .about =
           "Judges time-integration methods: runs each over a ladder of steps on a case whose "
           "exact motion is known, and compares what was measured with what it claims. A "
           "method is integrator[:name=value,...][+contact[:name=value,...]]; without +contact "
           "impacts are located as events (event-driven). Exit code 0 when all agree, 1 when "
           "one disagrees, 3 when one stays undecided.",
       .usage = "  clackers verify [METHOD ...|--all] [--case CASE ...] [--set name=value,...]\n"
                "           [--levels n] [--coarsest h] [--neighbours n] [--jobs n]\n"
                "           [--baseline FILE.json] [--report FILE.html]\n"});
  app->add_option("METHOD", options->methods,
                  "Methods, by name (clackers list pairs). Without any, the default panel "
                  "(clackers list methods).");
  app->add_flag("--all", options->all, "Every integrator with every contact treatment.");
  app->add_option(
         "--case", options->cases,
         "The case (clackers list cases). Default: three-parameter. Several, each with its "
         "own --case, are judged in turn and compared in a performance profile.")
      ->option_text("CASE");
  add_set_option(*app, options->settings);
  app->add_option("--levels", options->levels,
                  "Number of levels of the ladder, each with half the step of the one before. "
                  "Default: 8.")
      ->option_text("n");
  app->add_option("--coarsest", options->coarsest, "Largest step, in seconds. Default: 0.05.")
      ->option_text("h");
  app->add_option(
         "--neighbours", options->neighbours,
         "Neighbouring steps a level, in the ratio 2^(1/n); they show scatter. Default: 8.")
      ->option_text("n");
  app->add_option("--jobs", options->jobs, "Threads. Default: one a processor.")->option_text("n");
  add_report_option(*app, options->report);
  app->add_option(
         "--baseline", options->baseline,
         "An earlier record (--format json) of the same case and steps, - for standard "
         "input: says in words what changed since. The exit code stays that of the verdicts.")
      ->reads_file("FILE.json");
  add_common_options(*app, options->common);
  add_verdict_formats(*app);
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
