#include "clackers/solvers/plugin.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/solvers/plugin/plugin_report.hpp"
#include "clackers/solvers/process.hpp"
#include "clackers/solvers/program_runner.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

// In the folder of a run, where its process starts.
constexpr auto report_name = "report.txt";

// Where the library was when its run ended, and why if that is known.
void complete(const fs::path& folder, SolverOutput& output) {
  const auto report = read_plugin_report(folder / report_name);
  if (!report.code.empty()) {
    output.failure_code = report.code;
    output.failure = report.sentence;
  } else if (output.failure.empty() && report.stage != "end") {
    output.failure_code = Code("plugin-failed").name();
    output.failure = "it ended the process, with exit status 0";
  } else if (output.failure_code == Code("program-failed").name()) {
    output.failure_code = Code("plugin-failed").name();
  }
  if (output.failure.empty()) return;
  if (!output.failure.ends_with('.')) output.failure += '.';
  output.failure = fmt::format("{}: {}", report.stage, output.failure);
  output.would_repeat = output.would_repeat || report.stage == "load" || report.stage == "prepare";
}

// The host's process with a library, which takes the place of the shell's, so that a crash is its.
std::string command_of(const PluginRequest& request, const fs::path& library) {
  std::string command = "exec ";
  for (const auto& word : request.host) command += shell_quoted(word) + ' ';
  return command + shell_quoted(library.string()) + ' ' + report_name;
}

fs::path library_of(const Plugin& plugin) {
  std::error_code error;
  if (fs::is_regular_file(plugin.library, error))
    return fs::absolute(plugin.library).lexically_normal();
  throw FileError(fmt::format("verify --plugin {}: {}; allowed: a shared library.", plugin.library,
                              error ? error.message() : "not a file"),
                  "cannot-read");
}

// What a library says of itself in a process of its own.
PluginReport report_of(const std::string& command, double timeout, WorkFolder& work,
                       const std::atomic<bool>* interrupt) {
  const RunFolder folder(work, "plugin", {});
  run_process(
      {.command = command, .folder = folder.path().string(), .timeout = timeout, .output = {}},
      interrupt);
  auto report = read_plugin_report(folder.path() / report_name);
  if (report.code == Code("not-a-plugin").name())
    throw InputError("verify --plugin: " + report.sentence, "not-a-plugin");
  return report;
}

}  // namespace

std::vector<SolverSubject> subjects_of(const PluginRequest& request,
                                       const std::atomic<bool>* interrupt) {
  require_positive("verify", "timeout", request.timeout);
  const auto folder = std::make_shared<WorkFolder>(request.work);
  std::vector<SolverSubject> subjects;
  for (const auto& plugin : request.plugins) {
    const auto library = library_of(plugin);
    const auto load = command_of(request, library);
    const auto report = report_of(load, request.timeout, *folder, interrupt);
    const CommandTemplate command(load + " {case:text} {h} {n} {tolerance} {out} {events}");
    auto& subject = subjects.emplace_back();
    subject.kind = record::SubjectKind::plugin;
    subject.name = !plugin.name.empty()   ? plugin.name
                   : !report.name.empty() ? report.name
                                          : library.stem().string();
    subject.claim = request.expect.value_or(Claim{});
    if (report.by_tolerance) subject.tolerances = tolerances_of(request);
    subject.prepare =
        ProgramRunner::maker(command, subject.name, request, folder, {".npy", complete});
  }
  return subjects;
}

}  // namespace clackers::solvers
