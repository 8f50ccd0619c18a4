#include "clackers/campaign/atlas.hpp"

#include <fmt/format.h>

#include <memory>
#include <set>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/campaign/run.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/write.hpp"
#include "cli/command.hpp"
#include "cli/commands/campaign/atlas_folder.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

constexpr auto default_folder = "clackers-atlas";

struct AtlasOptions {
  CommonOptions common;  ///< its `out` is the folder, or the file of --submit
  std::string jobs, specification;
  std::string submit, command, expect, author;
  std::vector<std::string> merge;
};

void require_fitting(const AtlasOptions& options) {
  const bool submits = !options.submit.empty();
  if (submits && !options.merge.empty())
    refuse_usage("atlas",
                 "--merge: --submit writes a file, --merge reads files; give one of the two.");
  if (submits && options.common.out.empty())
    refuse_usage("atlas", "--submit writes a file: give it with --out FILE.db.");
  const bool is_program = !options.command.empty();
  if (!options.expect.empty() && !is_program)
    refuse_usage("atlas", "--expect: this is for programs; add --exec 'COMMAND'.");
  if ((is_program || !options.author.empty()) && !submits)
    refuse_usage("atlas", "--exec and --author go with --submit NAME --out FILE.db.");
}

std::string specification_text(const AtlasOptions& options) {
  return options.specification.empty()
             ? std::string(campaign::atlas_specification())
             : campaign::Specification::read(options.specification).text();
}

std::string specification_name(const AtlasOptions& options) {
  return options.specification.empty() ? "atlas.toml" : options.specification;
}

campaign::MethodEntry submitted(const AtlasOptions& options) {
  using Kind = campaign::MethodEntry::Kind;
  if (!options.command.empty())
    return {Kind::command, options.command, options.submit, options.expect};
  return {Kind::catalogue, options.submit, {}, {}};
}

int submit(const AtlasOptions& options, const std::string& line) {
  const auto entry = submitted(options);
  const auto specification = campaign::Specification::from_toml(
      campaign::with_methods(specification_text(options), {&entry, 1}),
      specification_name(options));
  OutputFile file(options.common.out, OnInterrupt::stop);
  const TemporaryFolder folder;
  const auto database = folder.path() + "/runs.db";
  {
    auto store = campaign::Store::create_or_open(database, specification);
    const auto done = run_tasks(store, {}, jobs_from(options.jobs), options.common.quiet);
    if (done.interrupted) throw Interrupted();
    store.sign(
        {options.author.empty() ? options.submit : options.author, record::provenance(line)});
  }
  file.stream() << read_file(database, {}, longest_file);
  file.commit();
  if (!options.common.quiet)
    note(fmt::format("Wrote {}: {} tasks. Merge them into an atlas with: clackers atlas --merge {}",
                     options.common.out, specification.tasks(), options.common.out));
  return 0;
}

// The databases of others that the page shows: those of the folder, but for the ones that are
// replaced, and the new ones. Each is checked before anything is written.
std::vector<campaign::Store> others_of(const AtlasFolder& folder,
                                       const std::vector<std::string>& added) {
  auto files = folder.others();
  std::set<std::string> places;
  for (const auto& file : added) {
    if (!places.insert(folder.place_of(file)).second)
      refuse("atlas", "--merge", file, "each name once",
             "Two files would take one place in results; rename one.", "bad-syntax");
    std::erase(files, folder.place_of(file));
  }
  files.insert(files.end(), added.begin(), added.end());
  std::vector<campaign::Store> others;
  for (const auto& file : files)
    campaign::require_results(others.emplace_back(campaign::Store::open(file)));
  return others;
}

// How many methods got which verdict, a row a case.
void print_verdicts(const campaign::Store& store, Results& results) {
  const auto rows = store.query(
      "SELECT \"case\", count(DISTINCT system) AS systems, sum(verdict = 'agrees') AS agrees, "
      "sum(verdict = 'disagrees') AS disagrees, sum(verdict = 'not claimed') AS not_claimed, "
      "sum(verdict = 'undecided') AS undecided, sum(verdict = 'refused') AS refused FROM subjects "
      "GROUP BY \"case\" ORDER BY min(task)");
  report::write(*rows, results.format(), results.stream(), results.style());
  results.finish();
}

int run(const AtlasOptions& options, const std::string& line) {
  require_fitting(options);
  if (!options.submit.empty()) return submit(options, line);
  auto common = options.common;
  common.out.clear();  // the counts go to standard output
  Results results(common, OnInterrupt::finish);
  const auto jobs = jobs_from(options.jobs);
  const auto specification =
      campaign::Specification::from_toml(specification_text(options), specification_name(options));
  const AtlasFolder folder(options.common.out.empty() ? default_folder : options.common.out);
  const auto others = others_of(folder, options.merge);
  folder.begin(specification);

  auto store = campaign::Store::create_or_open(folder.database(), specification);
  const auto done = run_tasks(store, {}, jobs, options.common.quiet);
  std::string page;
  if (store.finished().size() > 0)
    page = campaign::campaign_page(store, others, "atlas", record::provenance(line));
  folder.take_in(options.merge);
  if (!page.empty()) folder.write_page(page);
  print_verdicts(store, results);
  if (done.interrupted) {
    report_error("interrupted; what was finished is stored. The same command continues.",
                 "interrupted");
    return 130;
  }
  if (!options.common.quiet) note(fmt::format("Wrote {}", folder.page()));
  return 0;
}

}  // namespace

void add_atlas(Grammar& root) {
  const auto options = std::make_shared<AtlasOptions>();
  auto* app =
      root.add_subcommand("atlas", "[--out FOLDER]", "every method on many systems, as a map");
  set_help(
      *app,
      {.examples =
           "  clackers atlas\n"
           "  clackers atlas --out atlas --jobs 2\n"
           "  clackers atlas --submit newmark:beta=0.3+penalty --out newmark.db\n"
           "  clackers atlas --submit ours --exec './solver {case} {h} {out}' --out our.db\n"
           "  clackers atlas --merge our.db\n",
       .about =
           "Runs the campaign that comes with clackers: every method on pairs over a grid of their "
           "parameters and on the systems beyond the pair. FOLDER receives index.html, a page that "
           "opens without a network: a matrix of verdicts, convergence plots, maps of order and error, "
           "Pareto fronts and performance profiles; atlas.db, the database of the campaign; atlas.toml, "
           "its specification; and results/, the merged databases of others. After an interruption "
           "the same command continues the atlas.",
       .usage = "  clackers atlas [--out FOLDER] [--jobs n] [--specification FILE.toml]\n"
                "           [--merge FILE.db ...]\n"
                "  clackers atlas --submit METHOD [--author NAME] --out FILE.db\n"
                "  clackers atlas --submit NAME --exec COMMAND\n"
                "           [--expect BEHAVIOUR[:ORDER]] [--author NAME] --out FILE.db\n"});
  app->add_option("--jobs", options->jobs, "Threads. Default: one per processor.")
      ->option_text("n");
  app->add_option(
         "--specification", options->specification,
         "Systems, methods and ladder as for `clackers campaign`, instead of the default ones.")
      ->reads_file("FILE.toml");
  app->add_option(
         "--submit", options->submit,
         "Run only this method on all systems, and write the results with their provenance as a "
         "database for --merge. With --exec it is the name of your program.")
      ->option_text("METHOD");
  app->add_option("--exec", options->command,
                  "Your program, a command for the shell, as of `clackers verify --exec`.")
      ->option_text("COMMAND");
  app->add_option("--expect", options->expect,
                  "What your program should show: proper:2, reduced:1, irregular:1, exact, "
                  "stagnating[:REASON] or divergent. Default: nothing is claimed.")
      ->option_text("BEHAVIOUR[:ORDER|REASON]");
  app->add_option("--author", options->author,
                  "Author of the results, shown on the page. Default: METHOD.")
      ->option_text("NAME");
  app->add_option(
         "--merge", options->merge,
         "Merge a database that --submit wrote; the page shows its rows with their author. "
         "May be repeated. A file of the same name is replaced.")
      ->reads_file("FILE.db");
  add_common_options(*app, options->common);
  app->get_option("--out")
      ->description(
          "The folder of the atlas; one of another command is refused. Default: "
          "clackers-atlas. With --submit the file.")
      ->option_text("FOLDER|FILE.db");
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
