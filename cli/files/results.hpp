#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "clackers/report/write.hpp"
#include "cli/files/output_file.hpp"
#include "cli/options.hpp"

namespace clackers::cli {

/// Where the result of a command goes and how it looks: standard output, or the file of --out.
class Results {
 public:
  /// Throws InputError for a format that the content does not have, and FileError when the file of
  /// --out cannot be written, so construct it before long work.
  Results(const CommonOptions& options, OnInterrupt on_interrupt,
          report::Content content = report::Content::rows);

  std::ostream& stream();
  report::Format format() const { return format_; }
  const report::Style& style() const { return style_; }
  bool is_file() const { return file_ != nullptr; }
  /// Rows appear on a terminal, where a progress line would stand between them.
  bool is_terminal() const;
  /// After the last byte: puts the file in place and says so on standard error, or throws
  /// FileError.
  void finish();

 private:
  report::Format format_;
  bool quiet_;
  std::unique_ptr<OutputFile> file_;
  std::unique_ptr<OutputStream> standard_;
  report::Style style_;
};

/// Writes rows, with a progress line where they do not go to a terminal. Throws Interrupted.
void write_rows(record::RowSource& rows, Results& results, const std::string& command, bool quiet);

/// The look of standard output: colours on a terminal unless --no-color, NO_COLOR or TERM=dumb;
/// the terminal's width, or 80 columns.
report::Style standard_style(bool no_color);

}  // namespace clackers::cli
