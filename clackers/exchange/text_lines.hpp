#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clackers::exchange {

/// A line longer than this is no row of numbers; it keeps a wrong file (/dev/zero) from filling the
/// memory.
inline constexpr std::size_t longest_line = std::size_t{1} << 16;

/// What messages call a path: "standard input" for "-".
std::string shown_name(const std::string& path);

/// The lines of a text file, of standard input for the path "-", read a block at a time: without their ends (LF, CRLF or none at the
/// end of the file), without a byte order mark, and without what follows # or %.
class TextLines {
 public:
  /// Throws FileError (cannot-read) with the system's reason for a file that cannot be opened, a
  /// folder among them. When `interrupt` becomes true, next() throws Error with code interrupted.
  TextLines(const std::string& path, const std::atomic<bool>* interrupt);
  ~TextLines();
  TextLines(const TextLines&) = delete;
  TextLines& operator=(const TextLines&) = delete;

  /// Moves to the next line; false after the last. Throws InputError for a byte 0 (a binary file),
  /// UTF-16 and a line longer than longest_line, FileError when reading fails.
  bool next();
  /// The line without its comment, valid until the next call of next().
  std::string_view text() const { return text_; }
  /// What follows the # or % of a line, empty without one; valid as long as text().
  std::string_view comment() const { return comment_; }
  long long number() const { return number_; }
  /// "FILE line 3", of the present line.
  std::string place() const;
  /// Bytes of the file, 0 when it is no regular file.
  long long file_size() const { return size_; }
  /// The last line had text and no line feed, so that it may be cut. Known after the last line.
  bool ends_without_line_feed() const { return unended_; }
  /// Bytes of the lines so far.
  long long consumed() const { return consumed_; }

 private:
  bool fill();
  void check_block(std::size_t from) const;

  std::string path_;
  const std::atomic<bool>* interrupt_;
  int descriptor_ = -1;
  long long size_ = 0, consumed_ = 0, number_ = 0;
  std::vector<char> bytes_;
  std::size_t at_ = 0, have_ = 0;
  bool ended_ = false, unended_ = false;
  std::string_view text_, comment_;
};

}  // namespace clackers::exchange
