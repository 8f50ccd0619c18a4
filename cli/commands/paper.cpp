#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/report/write.hpp"
#include "cli/command.hpp"
#include "cli/files/output_folder.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "cli/progress_line.hpp"
#include "paper/catalogue.hpp"
#include "paper/reproduce.hpp"

namespace clackers::cli {
namespace {

struct PaperOptions {
  CommonOptions common;  ///< its `out` is the folder
  std::vector<std::string> figures;
};

paper::Reproduction reproduce(const PaperOptions& options, const std::vector<paper::Entry>& chosen,
                              const OutputFolder& folder, const std::string& line) {
  ProgressLine progress("paper", options.common.quiet);
  return paper::reproduce(chosen, folder.folder(), line, progress.callback(), &interrupt_flag());
}

int run(const PaperOptions& options, const std::string& line) {
  const auto chosen = paper::chosen(options.figures);
  if (options.common.out.empty())
    throw InputError("paper writes a folder: give it with --out FOLDER.", "bad-syntax");
  auto common = options.common;
  common.out.clear();  // the claims go to standard output
  Results results(common, OnInterrupt::stop);
  OutputFolder folder(options.common.out, paper::listed_files(options.common.out));

  const auto made = reproduce(options, chosen, folder, line);
  if (made.interrupted) throw Interrupted();
  folder.commit();
  const auto sheet = paper::claims_of(made.figures, results.format() == report::Format::table);
  record::SheetRows rows(sheet);
  report::write(rows, results.format(), results.stream(), results.style());
  results.finish();
  for (const auto& missing : made.missing) report_error(missing.sentence, missing.code.name());
  if (!options.common.quiet) note(fmt::format("Wrote {}", folder.path()));
  return made.missing.empty() ? 0 : 4;
}

}  // namespace

void add_paper(Grammar& root) {
  const auto options = std::make_shared<PaperOptions>();
  auto* app =
      root.add_subcommand("paper", "[FIGURE ...]", "the paper's figures and claims, reproduced");
  set_help(
      *app,
      {.examples = "  clackers paper --out figures\n"
                   "  clackers paper fig12 figA3 --out two\n",
       .about =
           "Draws the figures of the paper with the library only, and compares each claim of its "
           "text with measured values. FOLDER receives of each figure a picture (svg, "
           "pdf), its numbers (csv) and its Vega-Lite specification (vl.json), then "
           "index.html, which shows all of it, and paper.json. The claims also go to standard "
           "output. Drawing needs the programs node and rsvg-convert; without them numbers "
           "and specifications are written all the same and the exit code is 4.",
       .usage = "  clackers paper [FIGURE ...] --out FOLDER\n"});
  app->add_option("FIGURE", options->figures,
                  "Figures, by name (clackers list figures). Without any, all.");
  add_common_options(*app, options->common);
  app->get_option("--out")
      ->description(
          "The folder to write, whole or not at all. An earlier one of this command is replaced; "
          "one that holds other files is refused.")
      ->option_text("FOLDER");
  app->get_option("--out")->kind = ValueKind::text;
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
