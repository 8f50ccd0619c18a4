#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clackers::cli {

/// A folder that appears whole or not at all: what is written goes to a temporary folder beside it,
/// which takes its place in commit(). Without commit() the temporary folder is removed.
class OutputFolder {
 public:
  /// `own` are the names in an existing folder that may be replaced, since an earlier run wrote
  /// them. Throws InputError (foreign-folder) for a folder that holds anything else, and FileError
  /// when the folder cannot be made, before anything is computed.
  OutputFolder(std::string path, const std::vector<std::string>& own);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write; empty at first.
  const std::filesystem::path& folder() const { return temporary_; }
  const std::string& path() const { return path_; }
  /// Puts the folder in its place; one that was there is removed. Throws FileError.
  void commit();

 private:
  std::string path_;                 ///< as given
  std::filesystem::path target_;     ///< with links followed
  std::filesystem::path temporary_;  ///< empty after commit()
};

}  // namespace clackers::cli
