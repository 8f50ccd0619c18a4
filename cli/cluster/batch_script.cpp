#include "cli/cluster/run_on_ranks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::cli {
namespace {

// A value that sbatch reads back from a line of the script. It knows quotes and backslashes, and
// replaces % in names of files.
std::string quoted_value(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

// An option as given, its value in quotes where sbatch would divide it.
std::string quoted_option(const std::string& option) {
  const auto equals = option.find('=');
  const auto value = std::string_view(option).substr(std::min(equals, option.size() - 1) + 1);
  if (value.find_first_of(" \t\"'\\#") == value.npos) return option;
  return option.substr(0, equals + 1) + quoted_value(value);
}

std::string log_name(const BatchJob& job, std::string_view pattern) {
  std::string name;
  for (const char c : job.database) name.append(c == '%' ? 2 : 1, c);
  return quoted_value(name + std::string(pattern));
}

void require_one_line(const std::string& text) {
  if (std::ranges::none_of(text, [](char c) { return c == '\n' || c == '\r'; })) return;
  throw InputError(
      fmt::format("\"{}\" has several lines; a batch script takes names and options of "
                  "one line. Rename it.",
                  printable(text)),
      "bad-syntax");
}

std::string head(const BatchJob& job, std::string_view what,
                 const std::vector<std::string>& lines) {
  const auto name = std::filesystem::path(job.database).stem().string();
  std::string text = "#!/bin/sh\n";
  text += fmt::format("#SBATCH --job-name={}\n", quoted_value(fmt::format("{} {}", what, name)));
  text += "#SBATCH --ntasks=1\n";
  for (const auto& line : lines) text += fmt::format("#SBATCH --{}\n", line);
  for (const auto& option : job.options)
    text += fmt::format("#SBATCH --{}\n", quoted_option(option));
  return text;
}

// The commands of a script: `words` from the folder where relative names begin.
std::string body(const BatchJob& job, const std::vector<std::string>& words,
                 std::string_view tail = {}) {
  const std::vector<std::string> cd{"cd", job.folder};
  return fmt::format("{} || exit\nexec {}{}\n", shell_line(cd), shell_line(words), tail);
}

void require_one_line(const BatchJob& job) {
  for (const auto* text : {&job.program, &job.folder, &job.specification, &job.database})
    require_one_line(*text);
  for (const auto& option : job.options) require_one_line(option);
}

}  // namespace

std::string array_script(const BatchJob& job) {
  require_one_line(job);
  const auto lines = std::vector<std::string>{
      fmt::format("array=1-{}", job.shards), fmt::format("cpus-per-task={}", job.jobs), "requeue",
      "open-mode=append", "output=" + log_name(job, ".shard-%a.log")};
  std::vector<std::string> words{job.program,  "campaign",   "run",    job.specification,
                                 "--database", job.database, "--jobs", std::to_string(job.jobs),
                                 "--quiet"};
  if (job.is_large) words.push_back("--yes");
  return head(job, "run", lines) +
         "# Each element runs one shard of the campaign. Started again, it continues where it "
         "stopped.\n" +
         body(job, words, fmt::format(" --shard \"$SLURM_ARRAY_TASK_ID/{}\"", job.shards));
}

std::string merge_script(const BatchJob& job) {
  require_one_line(job);
  return head(job, "merge", {"output=" + log_name(job, ".merge.log")}) +
         "# Merges the shards into the database, when all elements of the array have ended.\n" +
         body(job, {job.program, "campaign", "merge", job.database, "--quiet"});
}

}  // namespace clackers::cli
