#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace clackers::solvers {

/// Where programs run and where their results are kept: a folder for each run. May be used from
/// several threads and by several processes at once.
class WorkFolder {
 public:
  /// The folder of --work; empty: $XDG_CACHE_HOME/clackers/programs, else ~/.cache/clackers/programs,
  /// where runs that were not used for `longest_unused` are removed. Throws FileError where it cannot
  /// be made.
  explicit WorkFolder(const std::string& path);

  /// The folder of an earlier good run with this key; nothing without one.
  std::optional<std::filesystem::path> find(std::string_view title, std::string_view key) const;
  /// Whether folders of failed runs stay, for a person to look at: in a folder of --work.
  bool keeps_failures() const { return is_given_; }

  static constexpr std::chrono::hours longest_unused{14 * 24};

 private:
  friend class RunFolder;
  std::filesystem::path place(std::string_view title, std::string_view key) const;
  void remove_unused() const;

  std::filesystem::path path_;
  bool is_given_;
  static inline std::atomic<int> next_ = 0;  // of the whole process, in whatever folder
};

/// The folder of one run while it runs; removed at its end unless it was committed.
class RunFolder {
 public:
  /// Throws FileError where it cannot be made.
  RunFolder(WorkFolder& work, std::string_view title, std::string_view key);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Puts it in its place and returns that. A good run can be found by its key from then on, a
  /// failed one stays where failures are kept. Throws FileError.
  std::filesystem::path commit(bool good);

 private:
  WorkFolder& work_;
  std::string key_;
  std::filesystem::path place_, path_;
};

/// Sentences begin with a folder that has gone when they are read: its path is taken out of them.
std::string without_folder(std::string sentence, const std::filesystem::path& folder);

}  // namespace clackers::solvers
