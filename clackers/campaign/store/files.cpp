#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "clackers/campaign/store.hpp"
#include "clackers/campaign/store/sqlite.hpp"

namespace clackers::campaign {
namespace {

namespace fs = std::filesystem;

bool is_whole(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

// "shard-3-of-16" or "rank-5".
bool is_shard_name(std::string_view name) {
  if (name.starts_with("rank-")) return is_whole(name.substr(5));
  const auto of = name.find("-of-");
  return name.starts_with("shard-") && of != name.npos && is_whole(name.substr(6, of - 6)) &&
         is_whole(name.substr(of + 4));
}

// The shards and ranks of a database, or what has their names and `end`; sorted.
std::vector<std::string> files_beside(const std::string& path, std::string_view end) {
  const auto start = fs::path(path).filename().string() + '.';
  auto folder = fs::path(path).parent_path();
  std::vector<std::string> found;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, missing)) {
    const auto name = entry.path().filename().string();
    if (!name.starts_with(start) || !name.ends_with(end)) continue;
    const auto shard = std::string_view(name).substr(start.size());
    if (shard.size() > end.size() && is_shard_name(shard.substr(0, shard.size() - end.size())))
      found.push_back((folder / name).string());
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

std::vector<std::string> shard_files(const std::string& path) { return files_beside(path, ""); }

bool is_shard_file(const std::string& path) {
  const auto name = fs::path(path).filename().string();
  const auto at = std::max(name.rfind(".shard-") + 1, name.rfind(".rank-") + 1);
  return at > 0 && is_shard_name(std::string_view(name).substr(at));
}

long long adopt_ranks(Store& store) {
  const auto start = store.path() + ".rank-";
  long long added = 0;
  for (const auto& file : shard_files(store.path())) {
    if (!file.starts_with(start)) continue;
    added += store.merge(file);
    remove_database(file);
  }
  // A rank that was ended before it made its database leaves its lock.
  constexpr std::string_view LOCK = ".lock";
  for (const auto& lock : files_beside(store.path(), LOCK))
    if (lock.starts_with(start)) WriterLock(lock.substr(0, lock.size() - LOCK.size()));
  return added;
}

std::string shard_path(const std::string& path, const Shard& shard) {
  return shard.is_all() ? path : fmt::format("{}.shard-{}-of-{}", path, shard.index, shard.count);
}

std::string rank_path(const std::string& path, long long rank) {
  return fmt::format("{}.rank-{}", path, rank);
}

void remove_database(const std::string& path) {
  std::error_code ignored;
  // The database last: without it the others are nothing.
  for (const auto* end : {"-wal", "-shm", ".lock", ""}) fs::remove(path + end, ignored);
}

}  // namespace clackers::campaign
