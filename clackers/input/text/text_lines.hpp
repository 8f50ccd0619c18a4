#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/files/input_file.hpp"

namespace clackers::input {

/// A line longer than this (some 700 000 columns) is no row of numbers; it keeps a wrong file from
/// filling the memory.
inline constexpr std::size_t longest_line = std::size_t{1} << 24;

/// The lines of a text file, read a block at a time: without their ends (LF, CRLF, CR alone where
/// the file has no LF, or none at the end of the file), without a byte order mark, and without what
/// follows # or %.
class TextLines {
 public:
  /// `path` is "-" for standard input. Throws FileError (cannot-read) as InputFile does. When
  /// `interrupt` becomes true, next() throws Error with code interrupted.
  TextLines(const std::string& path, const std::atomic<bool>* interrupt)
      : TextLines(InputFile(path, interrupt)) {}
  /// Of a file that stands at its first byte.
  explicit TextLines(InputFile file);

  /// Moves to the next line; false after the last. Throws InputError (not-text) for a byte 0 (a
  /// binary file), UTF-16 and UTF-32, compressed files and a line longer than longest_line;
  /// FileError when reading fails.
  bool next();
  /// The line without its comment, valid until the next call of next().
  std::string_view text() const { return text_; }
  /// What follows the # or % of a line, empty without one; valid as long as text().
  std::string_view comment() const { return comment_; }
  /// Of the present line, from 1; after the last line still that.
  long long number() const { return number_; }
  /// "FILE line 3", of the present line.
  std::string place() const;
  /// The path, or "standard input".
  const std::string& name() const { return file_.name(); }
  /// Bytes of the file, 0 when it is no regular file.
  long long file_size() const { return file_.size(); }
  /// The present line is the last and has no line end: the file may have been cut there.
  bool ends_without_line_feed() const { return without_line_end_; }
  /// Bytes of the lines so far.
  long long consumed() const { return consumed_; }

 private:
  void begin();
  bool fill();
  std::string_view rest() const { return {bytes_.data() + at_, have_ - at_}; }

  InputFile file_;
  std::vector<char> bytes_;
  std::size_t at_ = 0, have_ = 0;
  long long consumed_ = 0, number_ = 0;
  char line_end_ = '\n';
  bool ended_ = false, without_line_end_ = false;
  bool has_marks_ = false;  ///< of comments, in what is left of the block
  std::string_view text_, comment_;
};

}  // namespace clackers::input
