#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"
#include "clackers/campaign/store.hpp"
#include "clackers/report/write.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/results.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {
namespace {

// All tasks, or those of its shard.
long long tasks_of(const campaign::Store& store) {
  const auto& specification = store.specification();
  if (store.shard().empty()) return specification.tasks();
  const auto shard = campaign::shard_from(store.shard());
  return campaign::tasks_of_shard(specification.tasks(),
                                  campaign::block_size(specification, shard.count), shard);
}

std::string next_command(const campaign::Store& store, bool is_whole) {
  const auto& database = store.path();
  const auto whole = database.substr(0, database.rfind(".shard-"));
  std::vector<std::string> run{"clackers",   "campaign", "run", store.specification().name(),
                               "--database", whole};
  if (!store.shard().empty()) {
    if (is_whole)
      return shell_line(std::vector<std::string>{"clackers", "campaign", "merge", whole});
    run.insert(run.end(), {"--shard", store.shard()});
    return shell_line(run);
  }
  if (is_whole)
    return shell_line(std::vector<std::string>{"clackers", "campaign", "export", database,
                                               "--format", "csv", "--out", "runs.csv"});
  if (!campaign::shard_files(database).empty())
    return shell_line(std::vector<std::string>{"clackers", "campaign", "merge", database});
  return shell_line(run);
}

record::Sheet status_sheet(const campaign::Store& store) {
  record::Sheet sheet{
      "clackers/campaign-status/1", "", {{"quantity", "", ""}, {"value", "", ""}}, {}};
  const auto tasks = tasks_of(store);
  const auto counts = store.counts();
  sheet.rows.push_back({"tasks", tasks});
  sheet.rows.push_back({"finished", counts.tasks});
  sheet.rows.push_back({"runs", counts.runs});
  for (const auto* verdict : {"agrees", "disagrees", "not claimed", "undecided", "refused"}) {
    const auto found = counts.verdicts.find(verdict);
    sheet.rows.push_back({verdict, found == counts.verdicts.end() ? 0LL : found->second});
  }
  if (!store.shard().empty()) sheet.rows.push_back({"shard", store.shard()});
  const auto shards = campaign::shard_files(store.path()).size();
  if (shards > 0) sheet.rows.push_back({"shard files", static_cast<long long>(shards)});
  sheet.rows.push_back({"next", next_command(store, counts.tasks == tasks)});
  return sheet;
}

// Parts of a campaign that are neither among the files nor finished in the database, which is not
// made for them.
void require_all_shards(const std::string& database, const campaign::Specification& specification,
                        const std::vector<std::string>& files) {
  if (std::filesystem::exists(database) &&
      open_database(database).finished().size() == specification.tasks())
    return;
  std::vector<bool> found;
  for (const auto& file : files) {
    const auto name = open_database(file).shard();
    if (name.empty()) continue;
    const auto shard = campaign::shard_from(name);
    found.resize(std::max(found.size(), static_cast<std::size_t>(shard.count)));
    found[static_cast<std::size_t>(shard.index - 1)] = true;
  }
  constexpr std::ptrdiff_t most_named = 8;
  const auto missing = std::ranges::count(found, false);
  if (missing == 0) return;
  std::vector<std::string> named;
  for (auto at = found.begin(); std::ssize(named) < std::min(missing, most_named); ++at)
    if (!*at) named.push_back(fmt::format("{}/{}", at - found.begin() + 1, found.size()));
  throw InputError(
      fmt::format(
          "{}: {} of {} shards missing: {}{}. Name their files, or run them: clackers campaign "
          "run {} --shard {}",
          database, missing, found.size(), fmt::join(named, ", "),
          missing > most_named ? ", ..." : "", specification.name(), named.front()),
      "shard-missing");
}

campaign::TableName table_from(const std::string& text) {
  if (text.empty() || text == "runs") return campaign::TableName::runs;
  if (text == "subjects") return campaign::TableName::subjects;
  refuse_name("table", text, std::vector<std::string>{"runs", "subjects"}, "runs, subjects");
}

}  // namespace

campaign::Store open_database(const std::string& path) {
  return campaign::Store::open(path, &interrupt_flag());
}

void print_status(const CampaignOptions& options, const campaign::Store& store) {
  Results results(options.common, OnInterrupt::finish);
  const auto sheet = status_sheet(store);
  record::SheetRows rows(sheet);
  report::write(rows, results.format(), results.stream(), results.style());
  results.finish();
}

int show_status(const CampaignOptions& options, const std::string&) {
  print_status(options, open_database(options.files.front()));
  return 0;
}

int merge_shards(const CampaignOptions& options, const std::string&) {
  const auto& database = options.files.front();
  std::vector<std::string> shards(options.files.begin() + 1, options.files.end());
  if (shards.empty()) shards = campaign::shard_files(database);
  if (shards.empty())
    throw FileError(fmt::format("{}: there are no shards beside it. Name their files: clackers "
                                "campaign merge {} FILE ...",
                                database, database),
                    "cannot-read");
  {
    const auto specification = open_database(shards.front()).specification();
    require_all_shards(database, specification, shards);
    auto store = campaign::Store::create_or_open(database, specification);
    for (const auto& shard : shards) {
      const auto added = store.merge(shard, &interrupt_flag());
      if (!options.common.quiet) note(fmt::format("{}: {} tasks added", shard, added));
    }
  }
  print_status(options, open_database(database));
  return 0;
}

int export_rows(const CampaignOptions& options, const std::string&) {
  const auto table = table_from(options.table);
  const auto store = open_database(options.files.front());
  Results results(options.common, OnInterrupt::stop, report::Content::numbers);
  if (results.format() == report::Format::npy && results.is_terminal())
    throw InputError(
        "campaign export --format npy is bytes that a terminal cannot show. Add --out FILE.",
        "bad-syntax");
  const auto rows = results.format() == report::Format::npy ? store.numbers(table, options.times)
                                                            : store.rows(table, options.times);
  write_rows(*rows, results, "export", options.common.quiet);
  results.finish();
  return 0;
}

int query_database(const CampaignOptions& options, const std::string&) {
  if (options.files.size() != 2)
    throw InputError(
        "campaign query needs a database and a statement in quotes: clackers campaign query "
        "runs.db \"SELECT method, verdict, count(*) FROM subjects GROUP BY 1, 2\"",
        "bad-syntax");
  const auto store = open_database(options.files.front());
  Results results(options.common, OnInterrupt::stop);
  const auto rows = store.query(options.files[1]);
  write_rows(*rows, results, "query", options.common.quiet);
  results.finish();
  return 0;
}

}  // namespace clackers::cli
