#include "clackers/solvers/program_runner.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "clackers/base/error.hpp"
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

// Of a history on standard output [bytes]: 1 KiB a step and 64 MiB more.
std::size_t most_printed_rows(const SolverRun& run) {
  return (std::size_t{64} << 20) + (static_cast<std::size_t>(run.steps) << 10);
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
                  "too much on standard output, or no end of it; write the history to {out}");
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
                             const model::ImpactProblem<>& problem, const ProcessOptions& options,
                             std::shared_ptr<WorkFolder> folder)
    : command_(std::move(command)),
      title_(fmt::format("{}-{}", name, case_name)),
      json_(problem_file_json(case_name, problem)),
      text_(problem_file_text(problem)),
      timeout_(options.timeout),
      fresh_(options.fresh),
      environment_(options.environment),
      folder_(std::move(folder)) {}

std::function<std::unique_ptr<Solver>(const cases::Case&)> ProgramRunner::maker(
    const CommandTemplate& command, const std::string& name, const ProcessOptions& options,
    const std::shared_ptr<WorkFolder>& folder) {
  return [=](const cases::Case& problem) {
    return std::make_unique<ProgramRunner>(command, name, problem.entry->name, problem.problem,
                                           options, folder);
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

SolverOutput ProgramRunner::output_of(const SolverRun& run, const RunFolder& mine,
                                      const std::atomic<bool>* interrupt) const {
  mine.write("problem.json", json_);
  mine.write("problem.txt", text_);
  const auto& folder = mine.path();
  const auto history = folder / history_name;
  const bool prints_history = !command_.uses("out");
  auto result = run_process({.command = command_in(folder, run),
                             .folder = folder.string(),
                             .timeout = timeout_,
                             .output = prints_history ? history.string() : std::string(),
                             .most_output = most_printed_rows(run),
                             .removes_folder = true},
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
  auto key = command_in({}, run) + '\n' + command_.identity() + json_;
  for (const auto& name : environment_)
    if (const char* value = std::getenv(name.c_str())) key += fmt::format("\n{}={}", name, value);
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
  SolverOutput output;
  try {
    RunFolder mine(*folder_, title, key);
    output = output_of(run, mine, interrupt);
    if (output.interrupted) return output;
    output.failure = without_folder(output.failure, mine.path());
    output.printed = without_folder(std::move(output.printed), mine.path());
    if (folder_->keeps_failures() && !output.printed.empty())
      mine.write("printed.txt", output.printed);
    const auto place = mine.commit(output.history.has_value());
    if (output.history) output.history = (place / history_name).string();
    if (output.events) output.events = (place / events_name).string();
  } catch (const FileError& error) {
    // A full disk, or what the program has done to its folder, costs this run only.
    output.history.reset();
    if (output.failure.empty()) output.failure = error.what();
    if (output.failure_code.empty()) output.failure_code = error.code().name();
    output.would_repeat = error.code() == Code("cannot-write");
  }
  return output;
}

}  // namespace clackers::solvers
