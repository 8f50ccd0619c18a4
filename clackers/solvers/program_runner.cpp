#include "clackers/solvers/program_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <system_error>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/solvers/process.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

constexpr auto history_name = "history.csv", events_name = "events.csv",
               seconds_name = "seconds.txt", runs_name = "runs.txt";

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

void set_failure(SolverOutput& output, const FileError& error) {
  output.failure = error.what();
  output.failure_code = error.code().name();
  output.would_repeat = error.code() == Code("cannot-write");
}

double resolution_of(const SolverRun& run) {
  return run.tolerance > 0.0 ? run.tolerance : run.step;
}

// What stands before the history in a line of the file {runs}.
std::string line_of(const SolverRun& run) {
  return fmt::format("{} {} ", resolution_of(run), run.steps);
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

ProgramRunner::ProgramRunner(CommandTemplate command, std::string name,
                             const cases::Case& test_case, const ProcessOptions& options,
                             std::shared_ptr<WorkFolder> folder)
    : command_(std::move(command)),
      title_(fmt::format("{}-{}", name, test_case.entry->name)),
      json_(problem_file_json(test_case.entry->name, test_case.problem, test_case.mesh)),
      text_(problem_file_text(test_case.problem)),
      timeout_(options.timeout),
      fresh_(options.fresh),
      environment_(options.environment),
      folder_(std::move(folder)) {}

std::function<std::unique_ptr<Solver>(const cases::Case&)> ProgramRunner::maker(
    const CommandTemplate& command, const std::string& name, const ProcessOptions& options,
    const std::shared_ptr<WorkFolder>& folder) {
  return [=](const cases::Case& test_case) {
    return std::make_unique<ProgramRunner>(command, name, test_case, options, folder);
  };
}

std::string ProgramRunner::command_in(const fs::path& folder, const SolverRun& run) const {
  return command_.filled({{"case", (folder / "problem.json").string()},
                          {"case:text", (folder / "problem.txt").string()},
                          {"h", fmt::format("{}", run.step)},
                          {"n", fmt::format("{}", run.steps)},
                          {"tolerance", fmt::format("{}", run.tolerance)},
                          {"events", (folder / events_name).string()},
                          {"out", (folder / history_name).string()},
                          {"runs", (folder / runs_name).string()},
                          {"runs:tolerance", (folder / runs_name).string()}});
}

void ProgramRunner::write_problem(const RunFolder& mine) const {
  mine.write("problem.json", json_);
  mine.write("problem.txt", text_);
}

SolverOutput ProgramRunner::output_of(const SolverRun& run, const RunFolder& mine,
                                      const std::atomic<bool>* interrupt) const {
  write_problem(mine);
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
  output.seconds = result.seconds;
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

std::string ProgramRunner::title_of(const SolverRun& run) const {
  return run.tolerance > 0.0 ? fmt::format("{}-rtol{}", title_, run.tolerance)
                             : fmt::format("{}-h{}", title_, run.step);
}

// The paths of a run's own folder are no part of what it does.
std::string ProgramRunner::key_of(const SolverRun& run) const {
  auto key = command_in({}, run) + '\n' + command_.identity() + json_;
  if (command_.makes_all_runs()) key += '\n' + line_of(run);
  for (const auto& name : environment_)
    if (const char* value = std::getenv(name.c_str())) key += fmt::format("\n{}={}", name, value);
  return key;
}

std::optional<SolverOutput> ProgramRunner::found(const SolverRun& run) const {
  if (fresh_) return {};
  const auto folder = folder_->find(title_of(run), key_of(run));
  if (!folder) return {};
  SolverOutput output;
  output.reused = true;
  output.history = (*folder / history_name).string();
  if (is_filled(*folder / events_name)) output.events = (*folder / events_name).string();
  std::ifstream(*folder / seconds_name) >> output.seconds;
  return output;
}

// Puts the folder in its place.
void ProgramRunner::finish(SolverOutput& output, RunFolder& mine, const SolverRun& run) const {
  try {
    output.failure = without_folder(output.failure, mine.path());
    output.printed = without_folder(std::move(output.printed), mine.path());
    if (folder_->keeps_failures() && !output.printed.empty())
      mine.write("printed.txt", output.printed);
    if (output.seconds > 0.0) mine.write(seconds_name, fmt::format("{}\n", output.seconds));
    const auto place = mine.commit(output.history.has_value());
    if (output.history) output.history = (place / history_name).string();
    if (output.events) output.events = (place / events_name).string();
    if (output.failure.empty() || !folder_->keeps_failures()) return;
    if (command_.makes_all_runs())
      write_file(place / runs_name, line_of(run) + (place / history_name).string() + '\n');
    output.failure +=
        fmt::format(" Again: cd {} && {}", shell_quoted(place.string()), command_in(place, run));
  } catch (const FileError& error) {
    // A full disk, or what the program has done to its folder, costs this run only.
    output.history.reset();
    if (output.failure.empty()) output.failure = error.what();
    if (output.failure_code.empty()) output.failure_code = error.code().name();
    output.would_repeat = error.code() == Code("cannot-write");
  }
}

SolverOutput ProgramRunner::run(const SolverRun& run, const std::atomic<bool>* interrupt) {
  if (command_.makes_all_runs()) {
    const std::lock_guard lock(guard_);
    if (!made_.contains(resolution_of(run))) {
      auto runs = std::exchange(expected_, {});
      if (std::ranges::find(runs, resolution_of(run), resolution_of) == runs.end())
        runs.push_back(run);
      make_all(std::move(runs), interrupt);
    }
    return made_.at(resolution_of(run));
  }
  if (auto output = found(run)) return *output;
  SolverOutput output;
  try {
    RunFolder mine(*folder_, title_of(run), key_of(run));
    output = output_of(run, mine, interrupt);
    if (!output.interrupted) finish(output, mine, run);
  } catch (const FileError& error) {
    set_failure(output, error);
  }
  return output;
}

void ProgramRunner::expect(std::vector<SolverRun> runs) {
  const std::lock_guard lock(guard_);
  expected_ = std::move(runs);
}

// A program that fails, or is ended, may have written a part of the last history that there is.
void ProgramRunner::make_all(std::vector<SolverRun> runs, const std::atomic<bool>* interrupt) {
  SolverOutput ended;
  std::deque<RunFolder> folders;
  std::erase_if(runs, [&](const SolverRun& run) {
    auto output = found(run);
    if (output) made_[resolution_of(run)] = std::move(*output);
    return made_.contains(resolution_of(run));
  });
  if (runs.empty()) return;
  try {
    std::string lines;
    for (const auto& run : runs) {
      const auto& mine = folders.emplace_back(*folder_, title_of(run), key_of(run));
      write_problem(mine);
      lines += line_of(run) + (mine.path() / history_name).string() + '\n';
    }
    const auto& folder = folders.front().path();
    folders.front().write(runs_name, lines);
    const double timeout = timeout_ * double(runs.size());
    auto result = run_process({.command = command_in(folder, runs.front()),
                               .folder = folder.string(),
                               .timeout = timeout,
                               .removes_folder = true},
                              interrupt);
    ended.printed = std::move(result.printed);
    take_end(ended, result, timeout);
  } catch (const FileError& error) {
    set_failure(ended, error);
  }
  bool is_last = ended.interrupted || !ended.failure.empty();
  for (std::size_t i = runs.size(); i-- > 0;) {
    auto output = ended;
    if (i < folders.size()) {
      const auto history = folders[i].path() / history_name;
      if (is_filled(history) && !std::exchange(is_last, false)) {
        output = {};
        output.history = history.string();
      } else if (!output.interrupted && output.failure.empty()) {
        set_failure(output, "program-output", "no output: its file in {runs} is missing or empty");
      }
      if (!output.interrupted) finish(output, folders[i], runs[i]);
    }
    made_[resolution_of(runs[i])] = std::move(output);
  }
}

}  // namespace clackers::solvers
