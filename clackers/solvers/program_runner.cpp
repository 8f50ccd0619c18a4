#include "clackers/solvers/program_runner.hpp"

#include <fmt/format.h>

#include <cstring>
#include <system_error>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/base/files.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/solvers/process.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

constexpr auto history_name = "history.csv", events_name = "events.csv";

bool is_filled(const fs::path& path) {
  std::error_code error;
  return fs::file_size(path, error) > 0 && !error;
}

std::string signal_text(int signal) {
  const char* description = ::sigdescr_np(signal);
  return description == nullptr ? fmt::format("signal {}", signal)
                                : fmt::format("signal {} ({})", signal, description);
}

std::string exit_text(int status) {
  // The words of POSIX for what a shell makes of a command that it waits for.
  if (status > 128 && ::sigdescr_np(status - 128) != nullptr)
    return fmt::format("exit status {}: {}", status, signal_text(status - 128));
  return fmt::format("exit status {}", status);
}

void set_failure(SolverOutput& output, Code code, std::string sentence) {
  output.failure_code = code.name();
  output.failure = std::move(sentence) + ".";
}

void take_end(SolverOutput& output, const ProcessResult& result, double timeout) {
  switch (result.end) {
    case ProcessResult::End::exited:
      if (result.status != 0) set_failure(output, "program-failed", exit_text(result.status));
      // What a shell returns for commands that it does not find or may not execute.
      output.would_repeat = result.status == 126 || result.status == 127;
      break;
    case ProcessResult::End::signalled:
      set_failure(output, "program-failed", "ended by " + signal_text(result.status));
      break;
    case ProcessResult::End::timed_out:
      set_failure(output, "program-timeout",
                  fmt::format("still running after {:g} s, see --timeout", timeout));
      output.would_repeat = true;
      break;
    case ProcessResult::End::interrupted:
      output.interrupted = true;
      break;
    case ProcessResult::End::flooded:
      set_failure(output, "program-output",
                  fmt::format("more than {} GiB on standard output", most_output >> 30));
      break;
    case ProcessResult::End::not_started:
      set_failure(output, "program-failed",
                  "not started: " + std::generic_category().message(result.status));
      output.would_repeat = true;
      break;
  }
}

}  // namespace

ProgramRunner::ProgramRunner(CommandTemplate command, std::string name, std::string_view case_name,
                             const model::ImpactProblem<>& problem, double timeout, bool fresh,
                             std::shared_ptr<WorkFolder> folder)
    : command_(std::move(command)),
      title_(fmt::format("{}-{}", name, case_name)),
      json_(problem_file_json(case_name, problem)),
      text_(problem_file_text(problem)),
      timeout_(timeout),
      fresh_(fresh),
      folder_(std::move(folder)) {}

std::function<std::unique_ptr<Solver>(const cases::Case&)> ProgramRunner::maker(
    const CommandTemplate& command, const std::string& name, const ProcessOptions& options,
    const std::shared_ptr<WorkFolder>& folder) {
  return [=, timeout = options.timeout, fresh = options.fresh](const cases::Case& problem) {
    return std::make_unique<ProgramRunner>(command, name, problem.entry->name, problem.problem,
                                           timeout, fresh, folder);
  };
}

std::string ProgramRunner::command_in(const fs::path& folder, const SolverRun& run) const {
  return command_.filled({{"case", (folder / "problem.json").string()},
                          {"case:text", (folder / "problem.txt").string()},
                          {"h", fmt::format("{}", run.step)},
                          {"n", fmt::format("{}", run.steps)},
                          {"tolerance", fmt::format("{}", run.tolerance)},
                          {"events", (folder / events_name).string()},
                          {"out", (folder / history_name).string()}});
}

SolverOutput ProgramRunner::output_of(const SolverRun& run, const fs::path& folder,
                                      const std::atomic<bool>* interrupt) const {
  write_file(folder / "problem.json", json_);
  write_file(folder / "problem.txt", text_);
  const auto history = folder / history_name;
  const bool prints_history = !command_.uses("out");
  auto result = run_process({.command = command_in(folder, run),
                             .folder = folder.string(),
                             .timeout = timeout_,
                             .output = prints_history ? history.string() : std::string()},
                            interrupt);
  SolverOutput output;
  output.printed = std::move(result.printed);
  take_end(output, result, timeout_);
  if (output.interrupted || !output.failure.empty()) return output;
  if (!is_filled(history)) {
    set_failure(output, "program-output",
                prints_history ? "nothing on standard output, and no {out} in the command"
                               : "no output: {out} is missing or empty");
    return output;
  }
  output.history = history.string();
  if (command_.uses("events") && is_filled(folder / events_name))
    output.events = (folder / events_name).string();
  return output;
}

SolverOutput ProgramRunner::run(const SolverRun& run, const std::atomic<bool>* interrupt) {
  // The paths of a run's own folder are no part of what it does.
  const auto key = command_in({}, run) + '\n' + command_.identity() + json_;
  const auto title = run.tolerance > 0.0 ? fmt::format("{}-rtol{}", title_, run.tolerance)
                                         : fmt::format("{}-h{}", title_, run.step);
  if (!fresh_)
    if (const auto found = folder_->find(title, key)) {
      SolverOutput output;
      output.reused = true;
      output.history = (*found / history_name).string();
      if (is_filled(*found / events_name)) output.events = (*found / events_name).string();
      return output;
    }
  RunFolder mine(*folder_, title, key);
  auto output = output_of(run, mine.path(), interrupt);
  if (output.interrupted) return output;
  output.failure = without_folder(output.failure, mine.path());
  output.printed = without_folder(std::move(output.printed), mine.path());
  if (folder_->keeps_failures() && !output.printed.empty())
    write_file(mine.path() / "printed.txt", output.printed);
  const auto place = mine.commit(output.history.has_value());
  if (output.history) output.history = (place / history_name).string();
  if (output.events) output.events = (place / events_name).string();
  return output;
}

}  // namespace clackers::solvers
