#include "cli/commands/verify_programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "clackers/base/error.hpp"
#include "clackers/report/words/words.hpp"
#include "clackers/study/check.hpp"
#include "cli/messages.hpp"
#include "cli/values.hpp"

namespace clackers::cli {

void add_program_options(Command& command, ProgramOptions& options) {
  command
      .add_option(
          "--exec", options.commands,
          "Your own program as a method, a command for the shell: each step is one run. "
          "Placeholders: "
          "{case} a json file with the problem ({case:text} the same as key=value lines), {h} the "
          "step in seconds, {n} the number of steps, {tolerance} one of --tolerances, {out} the file "
          "for the history (without it: standard output), {events} a file for impacts, which may "
          "be left out. Each run has its own folder; files that the command names relative to the "
          "current folder are found. May be repeated and combined with METHODs.")
      ->option_text("COMMAND");
  command
      .add_option(
          "--name", options.names,
          "The name of a program in the results, one for each --exec in their order. Default: its "
          "file without folder and extension.")
      ->option_text("NAME");
  command
      .add_option(
          "--exec-batch", options.commands,
          "The same for a program whose start takes long: one process makes all runs of a ladder. "
          "Instead of {h}, {n}, {tolerance}, {out} and {events} it has {runs}, or "
          "{runs:tolerance}: a file with a line for each run: step or tolerance, number of steps, "
          "file for the history.")
      ->option_text("COMMAND");
  add_label_option(command, options.labels);
  command
      .add_option("--expect", options.expect,
                  "What programs should show: proper:2, reduced:1, irregular:1, exact, "
                  "stagnating[:REASON] or divergent. Default: nothing is claimed.")
      ->option_text("BEHAVIOUR[:ORDER|REASON]");
  command
      .add_option(
          "--tolerances", options.tolerances,
          "Levels of adaptive METHODs, and of commands with {tolerance}: one a decade, or a "
          "list. Default: 1e-3:1e-10.")
      ->option_text("a:b|x,y,...");
  command
      .add_option("--timeout", options.timeout,
                  "Time of one run of a program, in seconds or as 30s, 2min; then it is ended with "
                  "all that it started. Default: 60s.")
      ->option_text("TIME");
  command
      .add_option("--work", options.work,
                  "Keep the folders of all runs here. Default: good runs are kept in "
                  "$XDG_CACHE_HOME/clackers for 14 days, and reused while command, program, "
                  "problem and step are the same.")
      ->option_text("FOLDER");
  command
      .add_option("--environment", options.environment,
                  "Variables of the environment that the programs read: a run is repeated where "
                  "one of them has another value. Default: none is looked at.")
      ->option_text("NAME,...");
  command.add_flag("--fresh", options.fresh, "Repeat every run of the programs; reuse none.");
}

namespace {

void require_any(const ProgramOptions& options) {
  if (options.any()) return;
  const auto refuse_given = [](const char* option, bool is_given) {
    if (is_given)
      throw InputError(
          fmt::format("verify {}: this is for programs; add --exec 'COMMAND'.", option),
          "bad-syntax");
  };
  refuse_given("--name", !options.names.empty());
  refuse_given("--label", !options.labels.empty());
  refuse_given("--expect", !options.expect.empty());
  refuse_given("--timeout", !options.timeout.empty());
  refuse_given("--work", !options.work.empty());
  refuse_given("--fresh", options.fresh);
  refuse_given("--environment", !options.environment.empty());
}

solvers::ProcessOptions process_options_of(const ProgramOptions& options) {
  solvers::ProcessOptions process;
  if (!options.expect.empty()) process.expect = study::claim_from(options.expect);
  if (!options.tolerances.empty())
    process.tolerances = solvers::tolerances_from(options.tolerances);
  if (!options.timeout.empty()) process.timeout = read_duration("--timeout", options.timeout);
  process.work = options.work;
  process.fresh = options.fresh;
  for (const auto& names : options.environment)
    std::ranges::move(parts_of("--environment", names), std::back_inserter(process.environment));
  return process;
}

}  // namespace

std::vector<solvers::SolverSubject> program_subjects(const ProgramOptions& options) {
  require_any(options);
  const auto count = options.commands.size();
  if (!options.names.empty() && options.names.size() != count)
    refuse("verify", "--name", fmt::format("{} of them", options.names.size()),
           fmt::format("none, or one for each --exec, {} here", count), {}, "wrong-size");
  if (!options.any()) return {};
  solvers::ProgramRequest request{process_options_of(options), {}};
  for (std::size_t i = 0; i < count; ++i)
    request.programs.push_back({options.commands[i],
                                options.names.empty() ? std::string() : options.names[i],
                                read_labels(options.labels)});
  return solvers::subjects_of(request);
}

void report_failed_solvers(const record::Record& record) {
  if (record.interrupted) return;
  for (const auto& [problem, subject, first] : record::failed_solvers(record)) {
    const auto printed = report::printed_text(first->printed);
    const auto& score = first->score;
    auto sentence =
        fmt::format("{}{}: every run failed; the first one, at {}: {}", subject->name,
                    record.cases.size() > 1 ? " on " + problem->problem.name : std::string(),
                    report::resolution_text(*subject, score.step), score.failure);
    if (!sentence.ends_with('.')) sentence += '.';
    report_error(sentence + (printed.empty() ? "" : " It printed: " + printed), score.failure_code);
  }
}

}  // namespace clackers::cli
