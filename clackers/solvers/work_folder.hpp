#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "clackers/base/files/files.hpp"
#include "clackers/base/jobs/removed_on_exit.hpp"

namespace clackers::solvers {

/// Where programs run and where their results are kept: a folder for each run. May be used from
/// several threads and by several processes at once.
class WorkFolder {
 public:
  /// The folder of --work; empty: $XDG_CACHE_HOME/clackers/programs, else ~/.cache/clackers/programs,
  /// where the first run removes those that were not used for `longest_unused`. Folders of runs that
  /// were killed are removed after `longest_killed`, in either. Only what this program made is removed.
  /// Throws FileError where it cannot be made, and for a cache that is a link or that others may write
  /// to.
  explicit WorkFolder(const std::string& path);

  /// The folder of an earlier good run with this key; nothing without one.
  std::optional<std::filesystem::path> find(std::string_view title, std::string_view key) const;
  /// Whether folders of failed runs stay, for a person to look at: in a folder of --work.
  bool keeps_failures() const { return is_given_; }

  static constexpr std::chrono::hours longest_unused{14 * 24}, longest_killed{24};

 private:
  friend class RunFolder;
  std::filesystem::path place(std::string_view title, std::string_view key) const;
  void remove_unused() const;

  std::filesystem::path path_;
  bool is_given_;
  std::once_flag swept_;
};

/// The folder of one run while it runs, with a random name and locked; removed at its end, also by a
/// signal, unless it was committed.
class RunFolder {
 public:
  /// Throws FileError where it cannot be made.
  RunFolder(WorkFolder& work, std::string_view title, std::string_view key);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file, in place of anything of that name that a program has left. Throws FileError, as where
  /// a program has removed or replaced the folder.
  void write(const char* name, std::string_view bytes) const;
  /// Puts it in its place and returns that. A good run can be found by its key from then on, a
  /// failed one stays where failures are kept. Throws FileError.
  std::filesystem::path commit(bool good);

 private:
  RunFolder(WorkFolder& work, std::filesystem::path place);
  /// Whether the program has left it in its place.
  bool is_here() const;

  WorkFolder& work_;
  std::string key_;
  std::filesystem::path place_, path_;
  Descriptor folder_;
  std::optional<RemovedOnExit> removed_;
};

/// Sentences begin with a folder that has gone when they are read: its path is taken out of them.
std::string without_folder(std::string sentence, const std::filesystem::path& folder);

}  // namespace clackers::solvers
