#pragma once

#include <string>
#include <vector>

#include "clackers/campaign/atlas.hpp"
#include "cli/interrupt.hpp"

namespace clackers::cli {

/// A folder for the time of a command, removed at its end.
class TemporaryFolder {
 public:
  /// Throws FileError.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return removed_.path(); }

 private:
  RemovedOnExit removed_;
};

/// The folder that `clackers atlas` writes and goes on with: index.html, atlas.db, atlas.toml, and
/// results/ with files of others.
class AtlasFolder {
 public:
  explicit AtlasFolder(std::string path) : path_(std::move(path)) {}

  /// Makes the folder and writes the specification. Throws InputError for a folder that holds other
  /// things (foreign-folder) and for an atlas of another specification (other-campaign); FileError.
  void begin(const campaign::Specification& specification) const;
  /// Copies files of results into the folder, after reading all of them. Throws FileError for one that
  /// cannot be read, and as campaign::results_from().
  void take_in(const std::vector<std::string>& files) const;
  /// All files that were taken in, by name.
  std::vector<campaign::AtlasResults> results() const;
  void write_page(const std::string& html) const;

  std::string database() const { return path_ + "/atlas.db"; }
  std::string page() const { return path_ + "/index.html"; }

 private:
  std::string specification() const { return path_ + "/atlas.toml"; }
  std::string others() const { return path_ + "/results"; }

  std::string path_;
};

}  // namespace clackers::cli
