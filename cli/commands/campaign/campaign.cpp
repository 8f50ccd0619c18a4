#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "cli/command.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"

namespace clackers::cli {
namespace {

struct ActionRow {
  std::string name;
  CampaignAction act;
  std::size_t most_files;
  std::vector<std::string> options;  // beside --format, --out, --quiet, --no-color
};

// A new action is a row here, its name in the help below, and its function.
const std::vector<ActionRow>& actions() {
  constexpr std::size_t any = 1000000;
  static const std::vector<ActionRow> rows{
      {"plan", plan_campaign, 1, {}},
      {"run", run_campaign, 1, {"--database", "--shard", "--jobs", "--yes"}},
      {"submit",
       submit_campaign,
       1,
       {"--database", "--jobs", "--yes", "--slurm", "--shards", "--sbatch", "--dry-run"}},
      {"status", show_status, 1, {}},
      {"merge", merge_shards, any, {}},
      {"export", export_rows, 1, {"--table", "--times"}},
      {"query", query_database, 2, {}},
      {"report", report_campaign, 1, {}},
  };
  return rows;
}

bool takes_specification(const ActionRow& action) {
  return action.name == "plan" || action.name == "run" || action.name == "submit";
}

void require_used(const ActionRow& action, const CampaignOptions& options) {
  const auto require = [&](const char* name, bool is_given) {
    if (!is_given || std::ranges::find(action.options, name) != action.options.end()) return;
    throw InputError(
        fmt::format("campaign {} takes no {}. See: clackers campaign --help", action.name, name),
        "bad-syntax");
  };
  require("--database", !options.database.empty());
  require("--shard", !options.shard.empty());
  require("--jobs", !options.jobs.empty());
  require("--yes", options.yes);
  require("--slurm", options.slurm);
  require("--shards", !options.shards.empty());
  require("--sbatch", !options.sbatch.empty());
  require("--dry-run", options.dry_run);
  require("--table", !options.table.empty());
  require("--times", options.times);
}

int run(const CampaignOptions& options, const std::string& line) {
  std::vector<std::string> names;
  for (const auto& action : actions()) names.push_back(action.name);
  const auto words = fmt::format("{}", fmt::join(names, ", "));
  if (options.action.empty())
    throw InputError(
        fmt::format("campaign needs an action: {}. See: clackers campaign --help", words),
        "bad-syntax");
  const auto action = std::ranges::find(actions(), options.action, &ActionRow::name);
  if (action == actions().end()) refuse_name("action of campaign", options.action, names, words);
  if (options.files.empty())
    throw InputError(
        fmt::format("campaign {} needs a file: clackers campaign {} {}", action->name, action->name,
                    takes_specification(*action) ? "SPEC.toml" : "DATABASE"),
        "bad-syntax");
  if (options.files.size() > action->most_files)
    throw InputError(
        fmt::format("campaign {}: one argument too many: \"{}\". See: clackers campaign "
                    "--help",
                    action->name, options.files.back()),
        "bad-syntax");
  require_used(*action, options);
  return action->act(options, line);
}

}  // namespace

void add_campaign(Grammar& root) {
  const auto options = std::make_shared<CampaignOptions>();
  auto* app =
      root.add_subcommand("campaign", "ACTION FILE ...", "assess methods on thousands of systems");
  set_help(
      *app,
      {.examples = "  clackers campaign plan spec.toml\n"
                   "  clackers campaign run spec.toml --database runs.db\n"
                   "  clackers campaign status runs.db\n"
                   "  clackers campaign export runs.db --format csv --out runs.csv\n"
                   "  clackers campaign query runs.db \"SELECT method, verdict FROM subjects\"\n"
                   "  clackers campaign run spec.toml --database runs.db --shard 3/16\n"
                   "  clackers campaign merge runs.db\n"
                   "  mpirun -n 64 clackers campaign run spec.toml\n"
                   "  clackers campaign submit spec.toml --slurm --shards 16\n"
                   "  clackers campaign report runs.db --out page.html\n",
       .about =
           "Runs every method of a specification on every system: cases with listed values, ranges or "
           "samples of their parameters. The results are rows of one SQLite database. A campaign "
           "that was interrupted continues when it is run again; rows do not depend on the number "
           "of "
           "threads, on their order or on interruptions. Under mpirun and srun the processes share "
           "the tasks. A specification reads:\n\n"
           "  methods = [\"newmark\", \"rk4\", \"moreau-jean\"]  # or [\"panel\"], [\"all\"]\n"
           "  [ladder]\n"
           "  levels = 5\n"
           "  [[cases]]\n"
           "  case = \"three-parameter\"\n"
           "  set = { N = [0, 1, 2], xi1 = { from = 0.0, to = 0.2, points = 4 } }",
       .usage = "  clackers campaign plan SPEC.toml\n"
                "  clackers campaign run SPEC.toml [--database FILE] [--shard i/n]\n"
                "           [--jobs n] [--yes]\n"
                "  clackers campaign submit SPEC.toml --slurm --shards n [--jobs n]\n"
                "           [--database FILE] [--sbatch name=value] [--dry-run] [--yes]\n"
                "  clackers campaign status DATABASE\n"
                "  clackers campaign merge DATABASE [FILE ...]\n"
                "  clackers campaign export DATABASE [--table runs|subjects] [--times]\n"
                "  clackers campaign query DATABASE \"SELECT ...\"\n"
                "  clackers campaign report DATABASE --out FILE.html\n"});
  app->add_option(
         "ACTION", options->action,
         "plan: systems, tasks, runs, and estimates of time and disk. run: run what is not "
         "finished yet. submit: run it as a job array of a cluster, and merge. status: how far a "
         "database is, and its verdicts. merge: add the "
         "tasks of shards, without FILEs those beside the database. export: all rows in "
         "order. query: a statement in SQL that reads. report: a page with a matrix of verdicts and "
         "its figures, which opens without a network.")
      ->option_text("plan|run|submit|status|merge|export|query|report");
  app->add_option(
         "FILE", options->files,
         "The specification (plan, run, submit), or the database; then shards (merge) or a "
         "statement (query).")
      ->kind = ValueKind::input_file;
  app->add_option("--database", options->database,
                  "The database of run; made where there is none. Default: the specification's "
                  "name with the ending .db, in the current folder.")
      ->option_text("FILE");
  app->add_option("--shard", options->shard,
                  "Run the i-th of n parts, into DATABASE.shard-i-of-n; for job arrays. merge adds "
                  "the parts to the database.")
      ->option_text("i/n");
  app->add_option(
         "--jobs", options->jobs,
         "Threads. Default: one per processor; under mpirun and in an element of a job array one.")
      ->option_text("n");
  app->add_flag("--yes", options->yes, "Start a campaign of more than 1e7 runs.");
  app->add_flag(
      "--slurm", options->slurm,
      "submit: write DATABASE.sbatch, a job array of shards, and DATABASE.merge.sbatch, which "
      "merges them, and give both to sbatch.");
  app->add_option("--shards", options->shards, "submit: elements of the job array.")
      ->option_text("n");
  app->add_option("--sbatch", options->sbatch,
                  "submit: an option of sbatch without dashes (may be repeated).")
      ->option_text("name=value");
  app->add_flag("--dry-run", options->dry_run, "submit: only write the scripts.");
  app->add_option(
         "--table", options->table,
         "What is exported: runs, one row per run with the columns of its subject, or subjects, "
         "one row per system and method. Default: runs.")
      ->option_text("runs|subjects");
  app->add_flag("--times", options->times,
                "Export the processor times as well, which differ from machine to machine.");
  add_common_options(*app, options->common, report::Content::numbers);
  app->run = [options](const std::string& line) { return run(*options, line); };
}

}  // namespace clackers::cli
