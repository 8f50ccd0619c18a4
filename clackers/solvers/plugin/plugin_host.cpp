#include <fmt/format.h>

#include <charconv>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <system_error>

#include "clackers/base/error.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/solvers/plugin.hpp"
#include "clackers/solvers/plugin/plugin_library.hpp"
#include "clackers/solvers/plugin/plugin_output.hpp"
#include "clackers/solvers/plugin/plugin_report.hpp"

namespace clackers::solvers {
namespace {

template <class Number>
Number number_in(const std::string& text) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size())
    throw InputError(fmt::format("plug-in: \"{}\" is not a number.", text), "not-a-number");
  return value;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw FileError(path + ": cannot be read.", "cannot-read");
  return text;
}

// Calls the library, and keeps the report on disk ahead of it.
class PluginProcess {
 public:
  PluginProcess(std::string library, std::string report)
      : library_(std::move(library)), path_(std::move(report)) {}

  bool failed() const { return !report_.code.empty(); }

  /// Does `work`. The report names the first stage that failed, else the last one.
  void step(const char* stage, const std::function<void()>& work) {
    if (!failed()) report_.stage = stage;
    write(report_, path_);
    try {
      work();
    } catch (const Error& error) {
      fail(error.code().name(), error.what());
    } catch (const std::exception& error) {
      fail("plugin-failed", fmt::format("an exception left it: {}", error.what()));
    } catch (...) {
      fail("plugin-failed", "an exception left it");
    }
  }

  void load() {
    step("load", [&] {
      solver_ = &load_plugin(library_);
      report_.name = solver_->name == nullptr ? "" : solver_->name;
      report_.by_tolerance = solver_->refines == CLACKERS_SOLVER_TOLERANCE;
    });
  }

  void run(const model::ImpactProblem<>& problem, const clackers_solver_run& run,
           PluginOutput& output) {
    const PluginProblem handed(problem);
    void* state = nullptr;
    if (solver_->prepare != nullptr)
      step("prepare", [&] { take(solver_->prepare(handed.get(), &output, &state), output); });
    if (!failed())
      step("run", [&] {
        output.accept(true);
        take(solver_->run(state, handed.get(), &run, &output), output);
        output.accept(false);
      });
    if (solver_->free != nullptr) step("free", [&] { solver_->free(state); });
    if (failed()) return;
    step("run", [&] {
      output.commit();
      take(0, output);
    });
  }

  /// The last report; the library is not called any more.
  void finish() {
    if (!failed()) report_.stage = "end";
    write(report_, path_);
  }

 private:
  void take(std::int32_t result, PluginOutput& output) {
    if (result != 0)
      output.set_failure("plugin-failed",
                         fmt::format("it returned {}, without host->fail", result));
    if (!output.failure_code().empty()) fail(output.failure_code(), output.failure());
  }

  void fail(std::string_view code, std::string sentence) {
    if (failed()) return;
    report_.code = code;
    report_.sentence = std::move(sentence);
  }

  std::string library_, path_;
  PluginReport report_;
  const clackers_solver* solver_ = nullptr;
};

}  // namespace

bool host_plugin(const std::vector<std::string>& arguments) {
  if (arguments.size() != 2 && arguments.size() != 8)
    refuse("plug-in", "arguments", fmt::to_string(arguments.size()),
           "LIBRARY REPORT [PROBLEM STEP STEPS TOLERANCE HISTORY EVENTS]", {}, "bad-syntax");
  // The library may go to another folder.
  const auto path = [&](std::size_t i) { return std::filesystem::absolute(arguments[i]); };
  PluginProcess process(path(0).string(), path(1).string());
  if (arguments.size() == 2) {
    process.load();
  } else {
    const auto problem = model::problem_from_text(text_of(arguments[2]), arguments[2]);
    PluginOutput output(static_cast<int>(problem.dof()), path(6), path(7));
    const clackers_solver_run run{.step = number_in<double>(arguments[3]),
                                  .steps = number_in<std::int64_t>(arguments[4]),
                                  .tolerance = number_in<double>(arguments[5])};
    process.load();
    if (!process.failed()) process.run(problem, run, output);
  }
  process.finish();
  return !process.failed();
}

}  // namespace clackers::solvers
