#include "cli/commands/campaign/atlas_folder.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "cli/files/output_file.hpp"

namespace clackers::cli {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  return read_file(path, "Give one that clackers atlas --submit wrote.");
}

void write_whole(const std::string& path, const std::string& text) {
  OutputFile file(path, OnInterrupt::finish);
  file.stream() << text;
  file.commit();
}

std::string temporary_folder() {
  auto path = (fs::temp_directory_path() / "clackers-atlas-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr)
    throw FileError(fmt::format("{}: the folder cannot be made: {}", path, std::strerror(errno)),
                    "cannot-write");
  return path;
}

}  // namespace

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw FileError(fmt::format("{}: the folder cannot be made: {}", path, error.message()),
                    "cannot-write");
}

TemporaryFolder::TemporaryFolder() : removed_(temporary_folder()) {}

TemporaryFolder::~TemporaryFolder() { remove_path(path().c_str()); }

void AtlasFolder::begin(const campaign::Specification& specification) const {
  make_folder(path_);
  const auto own = this->specification();
  if (!fs::exists(own) && !fs::is_empty(path_))
    throw InputError(
        fmt::format("{}: this folder holds other files, and no atlas.toml. Give a new or "
                    "an empty one with --out FOLDER.",
                    path_),
        "foreign-folder");
  if (fs::exists(own)) {
    if (text_of(own) == specification.text()) return;
    throw InputError(
        fmt::format("{}: the atlas of this folder has another specification. Give another "
                    "folder with --out FOLDER, or go on with that one: clackers atlas "
                    "--specification {} --out {}",
                    path_, own, path_),
        "other-campaign");
  }
  write_whole(own, specification.text());
}

std::vector<std::string> AtlasFolder::others() const {
  std::vector<std::string> files;
  if (fs::is_directory(results()))
    for (const auto& entry : fs::directory_iterator(results())) {
      if (entry.path().extension() == ".json")
        throw InputError(fmt::format("{}: results of an earlier version; delete the file, and ask "
                                     "its author for a new one: clackers atlas --submit METHOD "
                                     "--out FILE.db",
                                     entry.path().string()),
                         "other-version");
      if (entry.path().extension() == ".db") files.push_back(entry.path().string());
    }
  std::ranges::sort(files);
  return files;
}

std::string AtlasFolder::place_of(const std::string& file) const {
  return results() + "/" + fs::path(file).stem().string() + ".db";
}

void AtlasFolder::take_in(const std::vector<std::string>& files) const {
  if (!files.empty()) make_folder(results());
  for (const auto& file : files) write_whole(place_of(file), read_file(file, {}, longest_file));
}

void AtlasFolder::write_page(const std::string& html) const { write_whole(page(), html); }

}  // namespace clackers::cli
