#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/input/table.hpp"
#include "clackers/input/text/text_lines.hpp"

namespace clackers::input {

/// What stands between the fields of a row: a comma, a semicolon or a tab, one between two fields,
/// or any run of blanks and tabs.
class Separation {
 public:
  /// What separates the fields of a row of numbers.
  static Separation of(std::string_view row);

  /// The fields without blanks around them, into `fields`. An empty field behind the last separator
  /// is left out.
  void split(std::string_view line, std::vector<std::string_view>& fields) const;

  bool is_comma() const { return mark_ == ','; }

 private:
  explicit Separation(char mark) : mark_(mark) {}

  char mark_;  ///< ' ' stands for a run of blanks and tabs
};

/// `text` without blanks, tabs and quotes around it.
std::string_view trimmed(std::string_view text);

/// Rows of fields of a text file. The names of its columns come from the caller, or from a header (a
/// first line without any number), or from the last comment above the rows when it has a name for
/// every column.
class TextTable : public Table {
 public:
  /// Reads up to the first row; `file` stands at its first byte. Throws as open_table() does.
  TextTable(InputFile file, const std::vector<std::string>& names, TableKind kind);

  /// Throws InputError for a row with another number of fields (ragged-row).
  bool next() override;
  /// Throws InputError for decimal commas, too.
  void read_number(std::size_t column, Number& number) override;
  RowSide side(std::size_t column) const override;
  std::string place() const override { return lines_.place(); }
  /// A guess by the length of the first thousand rows.
  std::size_t expected_rows() const override;
  double share() const override;
  /// Names that stood in a comment, and a last line without its end.
  std::vector<Note> notes() const override;
  StatedCost cost() const override;

 private:
  bool next_content();
  void name_columns(const std::vector<std::string>& given,
                    const std::optional<std::string>& header);
  bool comment_names_columns(std::vector<std::string>& names);
  void require_fields() const;

  TableKind kind_;
  TextLines lines_;
  std::string comment_;       ///< the last above the rows
  std::string last_comment_;  ///< below the first row
  Separation separation_;
  bool from_comment_ = false, row_is_waiting_ = false;
  std::size_t rows_ = 0;
  std::vector<std::string_view> fields_;
};

}  // namespace clackers::input
