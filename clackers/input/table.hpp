#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/number.hpp"
#include "clackers/input/history.hpp"

namespace clackers::input {

/// What a table is expected to be.
enum class TableKind {
  history,  ///< has rows
  events    ///< may have no rows; a lone column without a name is "t"
};

/// Which limit of a jump a row is, as its column "side" says.
enum class RowSide { none, before, after };

/// Rows of numbers under named columns, one after the other: the one interface of all sources.
class Table {
 public:
  virtual ~Table() = default;
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  /// What messages call the source.
  const std::string& name() const { return name_; }
  /// Of all columns, as plain_name() makes them.
  const std::vector<std::string>& names() const { return names_; }

  /// Moves to the next row; false after the last. Throws InputError for a row that does not fit the
  /// columns, Error (interrupted) when asked to stop.
  virtual bool next() = 0;
  /// The number in a column of the present row. Throws InputError with source, row and column for
  /// what is no number (not-a-number) or not finite (not-finite).
  virtual void read_number(std::size_t column, Number& number) = 0;
  /// What the column "side" holds in the present row: "-" or -1 before a jump, "+" or 1 after it.
  virtual RowSide side(std::size_t column) const = 0;
  /// Where the present row stands: "FILE line 3", "FILE row 2 (from 0)".
  virtual std::string place() const = 0;

  /// How many rows there will be in all; 0 while that is not known.
  virtual std::size_t expected_rows() const = 0;
  /// What part of the table has been read, in [0, 1]; 0 where that is not known.
  virtual double share() const = 0;
  /// What a reader should know of the table, once its last row was read.
  virtual std::vector<Note> notes() const { return {}; }
  virtual StatedCost cost() const { return {}; }

 protected:
  explicit Table(std::string name) : name_(std::move(name)) {}
  void set_names(std::vector<std::string> names) { names_ = std::move(names); }
  [[noreturn]] void refuse_not_finite(std::size_t column, std::string_view shown) const;

 private:
  std::string name_;
  std::vector<std::string> names_;
};

/// The table of a source, before its first row. A file is NumPy's where it begins with its magic
/// bytes, a history one of another program where a result reader recognises it, else text. `names` replace or stand for those of the source; empty for none.
///
/// Throws InputError for columns without names (no-column), another number of names than of columns
/// (ragged-row), a history without rows (too-short), and what TextLines and NpyFile refuse;
/// FileError for a file that cannot be read.
std::unique_ptr<Table> open_table(const Source& source, const std::vector<std::string>& names,
                                  TableKind kind, const std::atomic<bool>* interrupt,
                                  const ResultChoice& choice = {});

/// The name of a column in lower case, without quotes and without a unit in brackets behind it:
/// "U1 [m]" is u1.
std::string plain_name(std::string_view text);

}  // namespace clackers::input
