#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/write.hpp"
#include "cli/command.hpp"
#include "cli/commands/dials.hpp"
#include "cli/files/report_page.hpp"
#include "cli/options.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

constexpr auto default_file = "clackers-explore.html";

struct ExploreOptions {
  CommonOptions common;  ///< its `out` is the page
  std::vector<std::string> settings;
  std::string name = "three-parameter";
};

// Where a person looks at a desktop; the browser stays when this command ends.
void open_in_browser(std::string file) {
  if (isatty(STDERR_FILENO) == 0 ||
      (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr))
    return;
  std::string program = "xdg-open";
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  (void)posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ);
}

int run(const ExploreOptions& options, const std::string& line) {
  const auto dials = dials_of(cases::make(options.name, read_settings(options.settings)));
  const auto file = options.common.out.empty() ? default_file : options.common.out;
  ReportPage page(file, options.common, OnInterrupt::stop, "--out");
  if (!page.write(report::explore(dials, record::provenance(line)))) return 4;
  if (options.common.out.empty()) open_in_browser(file);
  return 0;
}

}  // namespace

void add_explore(Grammar& root) {
  const auto options = std::make_shared<ExploreOptions>();
  auto* app = root.add_subcommand("explore", "[CASE]", "a page with dials that move the motion");
  set_help(*app, {.examples = "  clackers explore\n"
                              "  clackers explore synchronized-pair --set X=5,eta=0.7\n",
                  .about = "Writes a page that opens without a network: dials for the frequency "
                           "ratio, damping, duration, mass ratio and restitution move the exact "
                           "motion of two colliding masses, its animation, phase portrait and "
                           "energies; beside it stand runs of RK4, Newmark, a penalty spring and "
                           "Moreau-Jean at a step of your choice, with their order. Without --out "
                           "the page is clackers-explore.html and is opened where there is a "
                           "desktop.",
                  .usage = "  clackers explore [CASE] [--set name=value,...] [--out FILE.html]\n"});
  app->add_option("CASE", options->name,
                  "Where the dials stand at first: three-parameter or synchronized-pair. Default: "
                  "three-parameter.");
  add_set_option(*app, options->settings);
  add_common_options(*app, options->common);
  app->get_option("--out")
      ->description("The page. Default: clackers-explore.html.")
      ->option_text("FILE.html");
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
