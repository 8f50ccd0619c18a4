#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/exchange/text/separation.hpp"
#include "clackers/exchange/text/text_lines.hpp"

namespace clackers::exchange {

/// What a table is expected to be.
enum class TableKind {
  history,  ///< has rows
  events    ///< may have a header alone; a lone column without a name is "t"
};

/// Rows of fields under named columns. The names come from the caller, or from a header (a first
/// line without any number), or from the last comment above the rows when it has a name for every
/// column. Names are in lower case, without a unit in brackets behind them.
class TableReader {
 public:
  /// Reads up to the first row. `path` is "-" for standard input; `names` may be empty. Throws InputError for columns without names
  /// (no-column), another number of names than of columns (ragged-row), no rows (too-short), and
  /// FileError as TextLines does.
  TableReader(const std::string& path, const std::vector<std::string>& names, TableKind kind,
              const std::atomic<bool>* interrupt);

  const std::vector<std::string>& names() const { return names_; }
  /// The names stood in a comment.
  bool names_from_comment() const { return from_comment_; }

  /// Moves to the next row; false after the last. Throws InputError for a row with another number
  /// of fields (ragged-row).
  bool next();
  std::string_view field(std::size_t column) const { return fields_[column]; }
  /// The number in a field of the present row. Throws InputError with file, line and column for
  /// text that is none (not-a-number), NaN and infinity (not-finite), and decimal commas.
  void read_number(std::size_t column, struct Number& number) const;

  std::string place() const { return lines_.place(); }
  long long line() const { return lines_.number(); }
  /// The file's path, or "standard input".
  const std::string& path() const { return lines_.name(); }
  const TextLines& lines() const { return lines_; }

 private:
  bool next_content();
  void name_columns(const std::vector<std::string>& given,
                    const std::optional<std::string>& header);
  bool comment_names_columns();
  void require_fields() const;

  TableKind kind_;
  TextLines lines_;
  std::string comment_;  ///< the last above the rows
  Separation separation_;
  std::vector<std::string> names_;
  bool from_comment_ = false, row_is_waiting_ = false;
  std::vector<std::string_view> fields_;
};

}  // namespace clackers::exchange
