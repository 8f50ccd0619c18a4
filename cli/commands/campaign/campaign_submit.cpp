#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/text.hpp"
#include "clackers/campaign/task_source.hpp"
#include "clackers/solvers/process.hpp"
#include "cli/cluster/run_on_ranks.hpp"
#include "cli/commands/campaign/campaign_actions.hpp"
#include "cli/files/output_file.hpp"
#include "cli/interrupt.hpp"
#include "cli/messages.hpp"
#include "cli/values.hpp"

namespace clackers::cli {
namespace {

constexpr double patience = 60.0;  // [s] for sbatch

std::string absolute(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

void require_option(const std::string& option) {
  const bool is_name = !option.empty() && std::isalpha(static_cast<unsigned char>(option.front()));
  if (is_name) return;
  throw InputError(fmt::format("--sbatch takes an option of sbatch without dashes, such as "
                               "time=01:00:00 or partition=short, not \"{}\".",
                               printable(option)),
                   "bad-syntax");
}

BatchJob job_of(const CampaignOptions& options) {
  if (!options.slurm)
    throw InputError(
        "submit writes a job array for Slurm: give --slurm. Under another scheduler let each "
        "element of an array call: clackers campaign run SPEC.toml --shard i/n",
        "bad-syntax");
  if (options.shards.empty())
    throw InputError("submit needs --shards n, the number of elements of the job array.",
                     "bad-syntax");
  std::ranges::for_each(options.sbatch, require_option);
  BatchJob job;
  job.program = std::filesystem::read_symlink("/proc/self/exe").string();
  job.folder = std::filesystem::current_path().string();
  job.specification = absolute(options.files.front());
  job.database = absolute(database_of(options));
  job.shards = read_whole("--shards", options.shards, 1, campaign::most_shards);
  if (!options.jobs.empty())
    job.jobs = read_whole("--jobs", options.jobs, 1, campaign::most_shards);
  job.is_large = options.yes;
  job.options = options.sbatch;
  return job;
}

// Only a script of an earlier call is replaced.
void write_script(const std::string& path, const std::string& text) {
  constexpr std::string_view first_lines = "#!/bin/sh\n#SBATCH --job-name=";
  if (std::filesystem::exists(path) && !read_file(path).starts_with(first_lines))
    throw FileError(
        fmt::format("{}: there is another file of this name, which is no script of submit. "
                    "Remove it, or give another --database.",
                    path),
        "cannot-write");
  OutputFile file(path, OnInterrupt::stop);
  file.stream() << text;
  file.commit();
}

[[noreturn]] void fail(const std::string& line, const std::string& reason) {
  throw FileError(fmt::format("{} failed: {}. The scripts are written; --dry-run only writes them.",
                              printable(line), printable(reason)),
                  "scheduler-failed");
}

// The sentence of a process that failed.
std::string reason_of(const solvers::ProcessResult& result) {
  auto printed = result.printed;
  std::ranges::replace(printed, '\n', ' ');
  while (!printed.empty() && (printed.back() == ' ' || printed.back() == '.')) printed.pop_back();
  if (result.end == solvers::ProcessResult::End::timed_out)
    return fmt::format("no answer within {} s {}", patience, printed);
  return printed.empty() ? fmt::format("exit status {}", result.status) : printed;
}

// The number in "17" or "17;cluster", the last such line of sbatch --parsable.
std::string number_in(const std::string& printed) {
  std::string number, line;
  for (const char c : printed + "\n") {
    if (c != '\n') {
      line += c;
      continue;
    }
    const auto digits = line.substr(0, line.find(';'));
    if (!digits.empty() &&
        std::ranges::all_of(digits, [](unsigned char d) { return std::isdigit(d); }))
      number = digits;
    line.clear();
  }
  return number;
}

// Calls sbatch; the number of the job.
std::string submit(const std::vector<std::string>& words, const std::string& folder) {
  const auto line = shell_line(words);
  const auto result = solvers::run_process({line, folder, patience, {}}, &interrupt_flag());
  if (result.end == solvers::ProcessResult::End::interrupted) throw Interrupted();
  if (result.end != solvers::ProcessResult::End::exited || result.status != 0)
    fail(line, reason_of(result));
  const auto number = number_in(result.printed);
  if (number.empty()) fail(line, "no number of a job in \"" + result.printed + "\"");
  return number;
}

}  // namespace

int submit_campaign(const CampaignOptions& options, const std::string&) {
  const auto job = job_of(options);
  // What the elements would refuse is refused now.
  checked_specification(options);
  const auto array = job.database + ".sbatch", merge = job.database + ".merge.sbatch";
  write_script(array, array_script(job));
  write_script(merge, merge_script(job));
  const auto say = [&](const std::string& sentence) {
    if (!options.common.quiet) note(sentence);
  };
  say(fmt::format("Wrote {} and {}", array, merge));
  if (options.dry_run) return 0;
  const auto first = submit({"sbatch", "--parsable", array}, job.folder);
  say(fmt::format("Submitted job {}: {} shards", first, job.shards));
  const auto second = submit(
      {"sbatch", "--parsable", "--dependency=afterok:" + first, "--kill-on-invalid-dep=yes", merge},
      job.folder);
  say(fmt::format("Submitted job {}: merges them into {} after that", second, job.database));
  return 0;
}

}  // namespace clackers::cli
