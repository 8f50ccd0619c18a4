#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/decks/deck.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/write.hpp"
#include "cli/command.hpp"
#include "cli/files/output_folder.hpp"
#include "cli/files/paths.hpp"
#include "cli/files/results.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  CommonOptions common;  ///< its `out` is the folder
  std::string name, behind, problem, to, method;
  std::vector<std::string> settings;
  bool list = false;
};

record::Sheet format_sheet() {
  record::Sheet sheet;
  sheet.title = "Formats of clackers export";
  sheet.columns = {{"format", "", ""}, {"program", "", ""}, {"contact", "", ""}, {"run", "", ""}};
  for (const auto& format : decks::formats())
    sheet.rows.push_back(
        {format.name, format.program, format.contact,
         format.needs.empty() ? std::string("no") : "by our tests: " + format.needs});
  return sheet;
}

decks::Subject subject_of(const ExportOptions& options, const std::string& line) {
  decks::Subject subject;
  auto name = case_of(options.name, options.behind, options.problem);
  if (name.empty()) name = cases::default_case();
  auto chosen = cases::make(name, read_settings(options.settings, options.problem));
  subject.problem = std::move(chosen.problem);
  subject.motion = std::move(chosen.motion);
  subject.command = line;
  subject.method = options.method;
  if (!options.problem.empty()) return subject;
  subject.check.push_back(name);
  for (const auto& setting : options.settings)
    subject.check.insert(subject.check.end(), {"--set", setting});
  return subject;
}

void write_file(const OutputFolder& folder, const decks::DeckFile& file) {
  const auto path = fs::path(folder.folder()) / file.name;
  errno = 0;
  std::ofstream stream(path, std::ios::binary);
  stream << file.text;
  if (!stream.flush())
    fail_to_write((fs::path(folder.path()) / file.name).string(), errno != 0 ? errno : EIO);
  if (file.is_program)
    fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                    fs::perm_options::add);
}

int run(const ExportOptions& options, const std::string& line) {
  if (options.list) {
    Results results(options.common, OnInterrupt::stop);
    const auto sheet = format_sheet();
    record::SheetRows rows(sheet);
    report::write(rows, results.format(), results.stream(), results.style());
    results.finish();
    return 0;
  }
  if (options.to.empty() || options.common.out.empty())
    throw InputError(
        "export needs --to FORMAT and --out FOLDER: clackers export stop --to scipy --out stop. All "
        "formats: clackers export --list",
        "bad-syntax");
  const auto& format = decks::format_of(options.to);
  const auto files = decks::deck(format, subject_of(options, line));
  OutputFolder folder(options.common.out, decks::file_names());
  for (const auto& file : files) write_file(folder, file);
  folder.commit();
  if (!options.common.quiet)
    note(fmt::format("Wrote {0}: a model for {1}. Run and judge it with: {0}/run", folder.path(),
                     format.program));
  return 0;
}

}  // namespace

void add_export(Grammar& root) {
  const auto options = std::make_shared<ExportOptions>();
  auto* app =
      root.add_subcommand("export", "CASE --to FORMAT", "a case as a model of another program");
  set_help(
      *app,
      {.examples = "  clackers export --list\n"
                   "  clackers export three-parameter --to calculix --out pair\n"
                   "  clackers export stop --set eta=0.7 --to scipy --out stop\n"
                   "  clackers export --problem frame.toml --to opensees-tcl --out frame\n"
                   "  clackers export stop --to fmu2 --method rk4 --out stop-rk4\n",
       .about =
           "Writes a case, or a problem of your own, as a complete model of another program: masses, springs, "
           "dampers, loads, the initial state, the contact of that program, and a script `run`, "
           "which runs it on a ladder of steps or tolerances and judges the motions with clackers check. "
           "What a format cannot express is refused.",
       .usage = "  clackers export [CASE] --to FORMAT --out FOLDER [--set name=value,...]\n"
                "           [--method METHOD]\n"
                "  clackers export --problem FILE --to FORMAT --out FOLDER\n"
                "  clackers export --list\n"});
  app->add_option("CASE", options->name,
                  "The case (clackers list cases). Default: three-parameter.");
  add_case_option(*app, options->behind);
  add_set_option(*app, options->settings);
  add_problem_option(*app, options->problem);
  app->add_option("--to", options->to, "The format (clackers export --list).")
      ->option_text("FORMAT");
  app->add_option(
         "--method", options->method,
         "With fmu2 and fmu3: an explicit Runge-Kutta method, impacts located, whose motion "
         "co-simulation gives instead of the exact one, a step a communication step.")
      ->option_text("METHOD");
  app->add_flag("--list", options->list, "The formats, and which of them our tests run.");
  add_common_options(*app, options->common);
  app->get_option("--out")
      ->description(
          "The folder to write, whole or not at all. A deck that was not run is replaced; a folder that "
          "holds other files is refused. With --list a file.")
      ->option_text("FOLDER");
  app->get_option("--out")->kind = ValueKind::text;
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
