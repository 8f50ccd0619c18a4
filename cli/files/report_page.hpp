#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "cli/files/output_file.hpp"
#include "cli/options.hpp"

namespace clackers::cli {

/// The page of --report, or of a command that writes nothing else. Construct it before the work: where
/// it cannot be written is found out at once.
class ReportPage {
 public:
  /// An empty path: there is no page. Throws InputError for an ending of another format, FileError
  /// when it cannot be written; `option` gave the path.
  ReportPage(const std::string& path, const CommonOptions& common, OnInterrupt on_interrupt,
             std::string_view option = "--report");

  bool wanted() const { return file_ != nullptr; }
  /// Puts the page in place and says so on standard error. A page that fails must not stop other
  /// results: the reason is reported, and the answer is false.
  bool write(const std::string& html);

 private:
  bool quiet_;
  std::unique_ptr<OutputFile> file_;
};

}  // namespace clackers::cli
