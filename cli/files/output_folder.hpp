#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/interrupt.hpp"

namespace clackers::cli {

/// A folder that appears whole or not at all: what is written goes to a temporary folder beside it,
/// which takes its place in commit() in one step. Without commit() the temporary folder is removed.
class OutputFolder {
 public:
  /// `own` are the names in an existing folder that may be replaced, since an earlier run wrote
  /// them. Throws InputError (foreign-folder) for a folder that holds anything else, and FileError
  /// when the folder cannot be made, before anything is computed.
  OutputFolder(std::string path, std::vector<std::string> own);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write; empty at first.
  std::filesystem::path folder() const { return temporary_->path(); }
  const std::string& path() const { return path_; }
  /// Puts the folder in its place. Of one that was there the `own` files are removed; what else
  /// came into it meanwhile is kept, in the new folder or, where a name is taken, in a folder that
  /// a message names. Throws FileError.
  void commit();

 private:
  void exchange();
  void remove_old(const std::filesystem::path& old);

  std::string path_;  ///< as given
  std::vector<std::string> own_;
  std::filesystem::path target_;  ///< with links followed
  std::optional<RemovedOnExit> temporary_;
};

}  // namespace clackers::cli
