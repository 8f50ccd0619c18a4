#include "clackers/campaign/engines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "clackers/base/check.hpp"
#include "clackers/base/text.hpp"
#include "clackers/campaign/run.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/write.hpp"
#include "clackers/solvers/process.hpp"
#include "cli/command.hpp"
#include "cli/commands/campaign/atlas_folder.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/progress_line.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

namespace fs = std::filesystem;
using campaign::Engine;

constexpr auto default_folder = "clackers-engines";
constexpr double most_build = 600.0, most_version = 60.0;  // [s]

struct EnginesOptions {
  CommonOptions common;  ///< its `out` is the folder of run and page
  std::string action = "list", engines, jobs;
  std::vector<std::string> names, cases, settings;
  bool all = false;
};

// Beside the command: share/clackers/engines of an installed one, engines of a build below the sources.
std::string engines_folder(const EnginesOptions& options) {
  if (!options.engines.empty()) return options.engines;
  std::error_code error;
  for (auto at = fs::read_symlink("/proc/self/exe", error).parent_path(); at.has_relative_path();
       at = at.parent_path())
    for (const auto* name : {"share/clackers/engines", "engines"})
      if (fs::exists(at / name / "door.mjs")) return (at / name).string();
  return "engines";
}

// What a command of an engine.toml printed, without the line's end; nothing where it fails.
std::string printed_by(const std::string& command, double timeout) {
  const auto done = solvers::run_process({command, ".", timeout, {}}, &interrupt_flag());
  using End = solvers::ProcessResult::End;
  if (done.end == End::interrupted) throw Interrupted();
  if (done.end != End::exited || done.status != 0) return {};
  return done.printed.substr(0, done.printed.find('\n'));
}

std::vector<std::string> versions_of(std::span<const Engine> engines, bool quiet) {
  std::vector<std::string> versions;
  ProgressLine line("engines", quiet);
  for (const auto& engine : engines) {
    versions.push_back(printed_by(engine.filled(engine.version), most_version));
    line.report(double(versions.size()) / double(engines.size()),
                static_cast<long long>(versions.size()), "engines");
  }
  return versions;
}

void write_sheet(const EnginesOptions& options, const record::Sheet& sheet) {
  Results results(options.common, OnInterrupt::stop);
  record::SheetRows rows(sheet);
  report::write(rows, results.format(), results.stream(), results.style());
  results.finish();
}

// Compiles the programs of C++; nothing where there is none or it was compiled before.
std::string program_of(const Engine& engine, const std::string& folder) {
  if (engine.build.empty()) return {};
  const auto program = fs::absolute(fs::path(folder) / "programs" / engine.id);
  if (fs::exists(program)) return program.string();
  fs::create_directories(program.parent_path());
  const auto unfinished = program.string() + ".new";
  const auto done = solvers::run_process(
      {engine.filled(engine.build, unfinished), ".", most_build, {}}, &interrupt_flag());
  using End = solvers::ProcessResult::End;
  if (done.end == End::interrupted) throw Interrupted();
  if (done.end != End::exited || done.status != 0) {
    note(fmt::format("{} is skipped: it does not compile: {}", engine.id,
                     done.printed.substr(0, done.printed.find('\n'))));
    return {};
  }
  fs::rename(unfinished, program);
  return program.string();
}

bool is_wanted(const EnginesOptions& options, const Engine& engine) {
  return options.names.empty() ||
         std::ranges::find(options.names, engine.id) != options.names.end();
}

// A setting that no engine has is a slip.
void require_settings(const EnginesOptions& options, std::span<const Engine> engines) {
  for (const auto& name : options.settings) {
    std::vector<std::string> known;
    for (const auto& engine : engines)
      if (is_wanted(options, engine))
        for (const auto& setting : engine.settings) known.push_back(setting.name);
    if (std::ranges::find(known, name) == known.end())
      refuse_name("setting", name, known, "clackers engines list");
  }
}

// The engines and settings that were asked for and are installed; the others are named.
std::vector<campaign::EngineRun> wanted_runs(const EnginesOptions& options,
                                             std::span<const Engine> engines,
                                             const std::string& folder) {
  std::vector<campaign::EngineRun> runs;
  for (const auto& engine : engines) {
    if (!is_wanted(options, engine)) continue;
    const auto version = printed_by(engine.filled(engine.version), most_version);
    if (version.empty()) {
      note(fmt::format("{} is skipped: it is not installed. {}", engine.id, engine.installation()));
      continue;
    }
    const auto program = program_of(engine, folder);
    if (!engine.build.empty() && program.empty()) continue;
    for (const auto& setting : engine.settings)
      if (options.settings.empty() ||
          std::ranges::find(options.settings, setting.name) != options.settings.end())
        runs.push_back({&engine, &setting, version, program});
  }
  return runs;
}

// "stop:eta=0.7" as lines of TOML.
std::string cases_of(const EnginesOptions& options) {
  if (options.cases.empty()) return std::string(campaign::engine_cases());
  std::string text;
  for (const auto& item : options.cases) {
    const auto colon = item.find(':');
    text += fmt::format("[[cases]]\ncase = \"{}\"\n", item.substr(0, colon));
    if (colon != std::string::npos) text += fmt::format("set = {{ {} }}\n", item.substr(colon + 1));
  }
  return text;
}

void write_page(const EnginesOptions& options, const campaign::Store& store,
                const std::string& folder, const std::string& line) {
  OutputFile file(folder + "/index.html", OnInterrupt::finish);
  file.stream() << campaign::engines_page(store, record::provenance(line));
  file.commit();
  if (!options.common.quiet) note(fmt::format("Wrote {}/index.html", folder));
}

int run_engines(const EnginesOptions& options, std::span<const Engine> engines,
                const std::string& line) {
  if (options.all == !options.names.empty())
    refuse_usage("engines run", "give the engines by name, or --all.");
  const auto folder = options.common.out.empty() ? default_folder : options.common.out;
  const auto jobs = jobs_from(options.jobs);
  require_settings(options, engines);
  for (const auto& item : options.cases) {
    const auto colon = std::min(item.find(':'), item.size());
    (void)cases::make(item.substr(0, colon), colon == item.size()
                                                 ? cases::Settings()
                                                 : read_settings({item.substr(colon + 1)}));
  }
  make_folder(folder);
  const auto runs = wanted_runs(options, engines, folder);
  if (runs.empty())
    throw FileError(
        "engines run: no engine that was named can be run here; clackers engines list shows them all.",
        "program-failed");
  const auto specification = campaign::Specification::from_toml(
      campaign::engines_specification(runs, cases_of(options)), "engines.toml");
  auto store = campaign::Store::create_or_open(folder + "/engines.db", specification);
  const auto done = run_tasks(store, {}, jobs, options.common.quiet);
  if (store.finished().size() > 0) write_page(options, store, folder, line);
  if (done.interrupted) throw Interrupted();
  auto common = options.common;
  common.out.clear();
  Results results(common, OnInterrupt::stop);
  const auto rows = store.query(
      "SELECT \"case\", method, behaviour, \"order\", u_error, diagnosis FROM subjects ORDER BY task");
  write_rows(*rows, results, "engines", common.quiet);
  results.finish();
  return 0;
}

int run(EnginesOptions& options, const std::string& line) {
  if (options.action == "page") {
    const auto folder = options.common.out.empty() ? default_folder : options.common.out;
    const auto database = folder + "/engines.db";
    if (!std::filesystem::exists(database))
      throw FileError(fmt::format("{}: there is no such file. It is made by: clackers "
                                  "engines run --all --out {}",
                                  database, folder),
                      "cannot-read");
    write_page(options, campaign::Store::open(database), folder, line);
    return 0;
  }
  const auto engines = campaign::engines_in(engines_folder(options));
  for (const auto& name : options.names) engine_of(engines, name);
  if (options.action == "list") {
    write_sheet(options, engine_list(engines, versions_of(engines, options.common.quiet)));
  } else if (options.action == "show") {
    if (options.names.size() != 1)
      refuse_usage("engines show", "give one engine: clackers engines show bullet");
    const auto& engine = engine_of(engines, options.names[0]);
    write_sheet(options,
                engine_sheet(engine, printed_by(engine.filled(engine.version), most_version)));
  } else if (options.action == "run") {
    return run_engines(options, engines, line);
  } else {
    refuse_name("action of engines", options.action,
                std::vector<std::string>{"list", "show", "run", "page"}, "clackers engines --help");
  }
  return 0;
}

}  // namespace

void add_engines(Grammar& root) {
  const auto options = std::make_shared<EnginesOptions>();
  auto* app = root.add_subcommand("engines", "[ACTION] [NAME ...]", "engines of others, judged");
  set_help(
      *app,
      {.examples = "  clackers engines list\n"
                   "  clackers engines show bullet\n"
                   "  clackers engines run bullet box2d --case stop:eta=0.7\n"
                   "  clackers engines run --all --out engines\n",
       .about =
           "Runs physics engines and solvers of others through impacts, in their defaults and tuned, "
           "and judges them. Each engine is a folder with engine.toml and one program; what "
           "is not installed is named with the package to install. FOLDER receives engines.db, "
           "the database of the campaign, and index.html, its page. After an interruption the "
           "same command continues.",
       .usage = "  clackers engines [list]\n"
                "  clackers engines show NAME\n"
                "  clackers engines run [NAME ...|--all] [--case CASE[:name=value,...]]\n"
                "           [--setting NAME] [--jobs n] [--out FOLDER]\n"
                "  clackers engines page [--out FOLDER]\n"});
  app->add_option(
         "ACTION", options->action,
         "list: all engines and their versions here. show: how one integrates, its settings and traps. "
         "run: judge engines. page: write the page of a database again.")
      ->option_text("list|show|run|page");
  app->add_option("NAME", options->names, "Engines, as list has them.");
  app->add_flag("--all", options->all, "run: all engines that are installed.");
  app->add_option(
         "--case", options->cases,
         "run: a case with its parameters; may be repeated. Default: three-parameter, synchronized-pair:eta=0.7, stop and buildings.")
      ->option_text("CASE[:name=value,...]");
  app->add_option("--setting", options->settings,
                  "run: only settings of this name; may be repeated.")
      ->option_text("NAME");
  app->add_option("--jobs", options->jobs, "Threads. Default: one per processor.")
      ->option_text("n");
  app->add_option("--engines", options->engines,
                  "The folder of the engines. Default: the one that comes with the command.")
      ->option_text("FOLDER");
  add_common_options(*app, options->common);
  app->get_option("--out")
      ->description(
          "run, page: the folder of the results. Default: clackers-engines. Otherwise the file of the list.")
      ->option_text("FOLDER|FILE");
  app->get_option("--out")->kind = ValueKind::text;
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
