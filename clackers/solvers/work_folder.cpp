#include "clackers/solvers/work_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"

namespace clackers::solvers {
namespace {

namespace fs = std::filesystem;

// In every folder of a run: its key. Only folders with it are removed.
constexpr auto mark_name = ".clackers-run";
// The same, written last: the run is whole.
constexpr auto key_name = "key.txt";
constexpr std::string_view running = ".running-";

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

[[noreturn]] void fail(const fs::path& path, std::string_view reason) {
  throw FileError(fmt::format("{}: {}. Name another folder with --work.", path.string(), reason),
                  "cannot-write");
}

[[noreturn]] void fail(const fs::path& path, int error) {
  fail(path, std::generic_category().message(error));
}

// Makes a folder of ours where there is none, and refuses any other.
void require_private(const fs::path& path) {
  if (::mkdir(path.c_str(), S_IRWXU) != 0 && errno != EEXIST) fail(path, errno);
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) fail(path, errno);
  const char* problem = S_ISLNK(found.st_mode)                ? "is a link"
                        : !S_ISDIR(found.st_mode)             ? "is no folder"
                        : found.st_uid != ::geteuid()         ? "belongs to another user"
                        : found.st_mode & (S_IWGRP | S_IWOTH) ? "can be written to by others"
                                                              : nullptr;
  if (problem != nullptr)
    fail(path, fmt::format("the folder for runs of programs {}; set XDG_CACHE_HOME or correct it",
                           problem));
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string place_name(std::string_view title, std::string_view key) {
  return fmt::format("{}-{:016x}", as_name(title), hash(key));
}

// Whether this program made the folder of a run.
bool is_ours(const fs::path& folder) {
  const auto name = folder.filename().string();
  const auto has = [&](const char* file) {
    std::error_code error;
    return fs::is_regular_file(fs::symlink_status(folder / file, error)) &&
           (name.starts_with(running) || name.ends_with(place_name({}, text_of(folder / file))));
  };
  std::error_code error;
  return !fs::is_symlink(folder, error) && (has(mark_name) || has(key_name));
}

Descriptor opened(const fs::path& folder) {
  return Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

// False where another process has locked it, and on file systems without locks.
bool lock(const Descriptor& folder) { return ::flock(folder.number(), LOCK_EX | LOCK_NB) == 0; }

}  // namespace

WorkFolder::WorkFolder(const std::string& path)
    : path_(fs::absolute(path.empty() ? cache_folder() / "programs" : fs::path(path))),
      is_given_(!path.empty()) {
  std::error_code error;
  fs::create_directories(is_given_ ? path_ : path_.parent_path().parent_path(), error);
  if (error) fail(path_, error.message());
  if (!is_given_)
    for (const auto& folder : {path_.parent_path(), path_}) require_private(folder);
}

void WorkFolder::remove_unused() const {
  const auto now = fs::file_time_type::clock::now();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const bool runs = entry.path().filename().string().starts_with(running);
    const auto time = fs::last_write_time(entry.path(), error);
    if (error || now - time < (runs ? longest_killed : longest_unused) || (is_given_ && !runs))
      continue;
    const auto folder = opened(entry.path());
    if (folder.is_open() && lock(folder) && is_ours(entry.path()))
      remove_path(entry.path().c_str());
  }
}

fs::path WorkFolder::place(std::string_view title, std::string_view key) const {
  return path_ / place_name(title, key);
}

std::optional<fs::path> WorkFolder::find(std::string_view title, std::string_view key) const {
  auto folder = place(title, key);
  if (text_of(folder / key_name) != key) return {};
  std::error_code error;
  fs::last_write_time(folder, fs::file_time_type::clock::now(), error);
  return folder;
}

RunFolder::RunFolder(WorkFolder& work, std::string_view title, std::string_view key)
    : RunFolder(work, work.place(title, key)) {
  folder_ = opened(path_);
  if (!folder_.is_open()) fail(path_, errno);
  lock(folder_);
  write(mark_name, key_ = key);
}

RunFolder::RunFolder(WorkFolder& work, fs::path place) : work_(work), place_(std::move(place)) {
  std::call_once(work.swept_, [&] { work.remove_unused(); });
  std::random_device random;
  int error = 0;
  do {
    path_ = work.path_ / fmt::format("{}{:08x}{:08x}", running, random(), random());
    removed_.emplace(path_.string());
    error = ::mkdir(path_.c_str(), S_IRWXU | S_IRWXG | S_IRWXO) == 0 ? 0 : errno;
  } while (error == EEXIST);
  if (error != 0) fail(path_, error);
}

RunFolder::~RunFolder() {
  if (is_here())
    remove_path(path_.c_str());
  else if (::unlink(path_.c_str()) != 0)  // what the program has put there, no folder with anything
    ::rmdir(path_.c_str());
}

bool RunFolder::is_here() const {
  struct stat here {
  }, made{};
  return ::lstat(path_.c_str(), &here) == 0 &&
         (!folder_.is_open() || (::fstat(folder_.number(), &made) == 0 &&
                                 here.st_ino == made.st_ino && here.st_dev == made.st_dev));
}

void RunFolder::write(const char* name, std::string_view bytes) const {
  if (!is_here())
    throw FileError("the program has removed or replaced its folder.", "program-failed");
  remove_path((path_ / name).c_str());
  write_file(path_ / name, bytes);
}

fs::path RunFolder::commit(bool good) {
  if (!good && !work_.keeps_failures()) return place_;
  write(mark_name, key_);
  if (good) write(key_name, key_);
  // Exchanged, so that whoever reads the earlier folder finds a whole one at any time.
  if (is_ours(place_) &&
      ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, place_.c_str(), RENAME_EXCHANGE) == 0) {
    remove_path(path_.c_str());
    return place_;
  }
  std::error_code error;
  // Another process may put its own there meanwhile.
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (is_ours(place_)) remove_path(place_.c_str());
    fs::rename(path_, place_, error);
    if (!error) return place_;
  }
  fail(place_, error.message());
}

std::string without_folder(std::string sentence, const fs::path& folder) {
  const auto prefix = folder.string() + "/";
  for (std::size_t at = 0; (at = sentence.find(prefix, at)) != std::string::npos;)
    sentence.erase(at, prefix.size());
  return sentence;
}

}  // namespace clackers::solvers
