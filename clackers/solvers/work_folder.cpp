#include "clackers/solvers/work_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "clackers/base/error.hpp"
#include "clackers/base/files.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

// Written last: a folder with it is whole.
constexpr auto key_name = "key.txt";

fs::path cache_folder() {
  const auto variable = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  // The XDG Base Directory Specification: a path that is not absolute is ignored.
  if (const auto cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "clackers";
  if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "clackers";
  return fs::temp_directory_path() / fmt::format("clackers-{}", ::getuid());
}

// FNV-1a: names of folders, which hold their whole key.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 14695981039346656037ULL;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return value;
}

std::string as_name(std::string_view title) {
  std::string name;
  for (const char c : title.substr(0, 100)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string_view("._-+").find(c) != std::string_view::npos;
    name += plain ? c : '_';
  }
  return name;
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw FileError(
      fmt::format("{}: {}. Name another folder with --work.", path.string(), error.message()),
      "cannot-write");
}

}  // namespace

WorkFolder::WorkFolder(const std::string& path)
    : path_(fs::absolute(path.empty() ? cache_folder() / "programs" : fs::path(path))),
      is_given_(!path.empty()) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) fail(path_, error);
  if (is_given_) return;
  fs::permissions(path_, fs::perms::owner_all, error);
  remove_unused();
}

void WorkFolder::remove_unused() const {
  const auto limit = fs::file_time_type::clock::now() - longest_unused;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const auto time = fs::last_write_time(entry.path(), error);
    if (!error && time < limit) fs::remove_all(entry.path(), error);
  }
}

fs::path WorkFolder::place(std::string_view title, std::string_view key) const {
  return path_ / fmt::format("{}-{:016x}", as_name(title), hash(key));
}

std::optional<fs::path> WorkFolder::find(std::string_view title, std::string_view key) const {
  auto folder = place(title, key);
  std::ifstream file(folder / key_name, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || text != key) return {};
  std::error_code error;
  fs::last_write_time(folder, fs::file_time_type::clock::now(), error);
  return folder;
}

RunFolder::RunFolder(WorkFolder& work, std::string_view title, std::string_view key)
    : work_(work), key_(key), place_(work.place(title, key)) {
  path_ = work.path_ / fmt::format(".running-{}-{}", ::getpid(), work.next_++);
  std::error_code error;
  fs::remove_all(path_, error);  // of a process of that number that was killed
  const bool is_made = fs::create_directory(path_, error);
  if (!is_made) fail(path_, error ? error : std::make_error_code(std::errc::file_exists));
}

RunFolder::~RunFolder() {
  std::error_code error;
  if (!path_.empty()) fs::remove_all(path_, error);
}

fs::path RunFolder::commit(bool good) {
  if (!good && !work_.keeps_failures()) return place_;
  if (good) write_file(path_ / key_name, key_);
  std::error_code error;
  // Another process may put its own there meanwhile.
  for (int attempt = 0; attempt < 3; ++attempt) {
    fs::remove_all(place_, error);
    fs::rename(path_, place_, error);
    if (!error) {
      path_.clear();
      return place_;
    }
  }
  fail(place_, error);
}

std::string without_folder(std::string sentence, const fs::path& folder) {
  const auto prefix = folder.string() + "/";
  for (std::size_t at = 0; (at = sentence.find(prefix, at)) != std::string::npos;)
    sentence.erase(at, prefix.size());
  return sentence;
}

}  // namespace clackers::solvers
