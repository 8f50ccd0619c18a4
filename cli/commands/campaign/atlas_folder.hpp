#pragma once

#include <string>
#include <vector>

#include "clackers/campaign/atlas.hpp"
#include "cli/interrupt.hpp"

namespace clackers::cli {

/// Makes a folder with those above it. Throws FileError (cannot-write).
void make_folder(const std::string& path);

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
/// results/ with databases of others.
class AtlasFolder {
 public:
  explicit AtlasFolder(std::string path) : path_(std::move(path)) {}

  /// Makes the folder and writes the specification. Throws InputError for a folder that holds other
  /// things (foreign-folder) and for an atlas of another specification (other-campaign); FileError.
  void begin(const campaign::Specification& specification) const;
  /// The databases of others that were taken in, by name. Throws InputError (other-version).
  std::vector<std::string> others() const;
  /// Where a database of others is kept.
  std::string place_of(const std::string& file) const;
  /// Copies databases of others into the folder. Throws FileError.
  void take_in(const std::vector<std::string>& files) const;
  void write_page(const std::string& html) const;

  std::string database() const { return path_ + "/atlas.db"; }
  std::string page() const { return path_ + "/index.html"; }

 private:
  std::string specification() const { return path_ + "/atlas.toml"; }
  std::string results() const { return path_ + "/results"; }

  std::string path_;
};

}  // namespace clackers::cli
