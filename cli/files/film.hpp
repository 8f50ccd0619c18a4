#pragma once

#include <memory>
#include <string>

#include "clackers/record/record.hpp"
#include "cli/files/output_file.hpp"
#include "cli/options.hpp"

namespace clackers::cli {

/// The film of --film: the motion of a case with its runs beside it, drawn by node, rsvg-convert and
/// ffmpeg. Construct it before the work: where it cannot be written is found out at once.
class Film {
 public:
  /// An empty path: there is no film. Throws InputError for an ending other than .webm and .gif,
  /// FileError when it cannot be written.
  Film(const std::string& path, const CommonOptions& common, OnInterrupt on_interrupt);

  bool wanted() const { return file_ != nullptr; }
  /// Makes the film and says so on standard error. A film that fails must not stop other results: the
  /// reason is reported, and the answer is false.
  bool write(const record::CaseRecord& problem);

 private:
  void make(const record::CaseRecord& problem);

  bool quiet_;
  std::unique_ptr<OutputFile> file_;
};

/// Adds --film.
void add_film_option(Command& command, std::string& path);

}  // namespace clackers::cli
