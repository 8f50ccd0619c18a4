#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace clackers::record {

/// Empty, a real number, a whole number or text.
using Cell = std::variant<std::monostate, double, long long, std::string>;

/// The number in a cell, whole ones as double; NaN without one.
double number_in(const Cell& cell);
/// The number; an empty cell for NaN.
Cell cell_of(double number);

/// What the cells of a column hold. In rows of doubles a side is -1 ("-", before an impact), 1
/// ("+", after it) or 0 (empty).
enum class ColumnKind { any, real, whole, side };

struct Column {
  std::string name;  ///< as in csv and json: "t", "u1", "v1-"
  std::string unit;  ///< "s", empty when dimensionless or text
  std::string meaning;
  ColumnKind kind = ColumnKind::any;

  /// In words, for the axes and legends of figures: the meaning, which then has the symbol.
  const std::string& label() const { return meaning.empty() ? name : meaning; }
};

class NumberRows;

/// Rows for a person or a program, asked for one by one so that a billion need no memory.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual std::string schema() const = 0;  ///< "clackers/response/1"
  virtual std::string title() const = 0;   ///< above the table, empty for none
  virtual const std::vector<Column>& columns() const = 0;
  /// Fills `row` (one cell a column), or returns false after the last row.
  virtual bool next(std::vector<Cell>& row) = 0;
  /// The same rows as blocks of doubles, or nullptr where a cell may be text.
  virtual NumberRows* numbers() { return nullptr; }

  /// Called with the share of the rows in [0, 1] that has been made, many times a second; an
  /// exception thrown by it ends the reading.
  std::function<void(double share)> progress;

 protected:
  void report(long long done, long long total) const {
    if (progress) progress(double(done) / double(total));
  }
};

/// Rows whose columns are all `real`, `whole` or `side`. Read either with next() or with
/// next_block().
class NumberRows : public RowSource {
 public:
  /// Number of rows in all.
  virtual long long count() const = 0;
  /// Replaces `values` by the next rows, row-major; returns false, leaving none, after the last.
  virtual bool next_block(std::vector<double>& values) = 0;

  bool next(std::vector<Cell>& row) final;
  NumberRows* numbers() final { return this; }

 private:
  std::vector<double> block_;
  std::size_t read_ = 0;  // of block_
};

/// How curves are drawn.
struct Axes {
  bool log_x = false, log_y = false;
  double highest = std::numeric_limits<double>::infinity();  ///< what is above is cut off
  std::vector<std::string> x_names{};  ///< of x = 1, 2, ..., for the axis of a page
  std::string y{};                     ///< what several curves have in common, for their axis
  std::vector<double> marks{};         ///< lines at these x
  std::string mark_text{};             ///< what they are
  std::string note{};                  ///< what a reader must know of the curves
};

/// Rows held in memory.
struct Sheet {
  std::string schema, title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  /// The rows are points of curves over the first column: people see a figure instead of a table.
  std::optional<Axes> curves{};
};

/// Removes the columns, by their index, that are to go.
void drop_columns(Sheet& sheet, const std::function<bool(std::size_t)>& goes);

/// Reads a sheet row by row; the sheet must outlive it.
class SheetRows : public RowSource {
 public:
  explicit SheetRows(const Sheet& sheet) : sheet_(sheet) {}
  std::string schema() const override { return sheet_.schema; }
  std::string title() const override { return sheet_.title; }
  const std::vector<Column>& columns() const override { return sheet_.columns; }
  bool next(std::vector<Cell>& row) override {
    if (next_ == sheet_.rows.size()) return false;
    row = sheet_.rows[next_++];
    return true;
  }

 private:
  const Sheet& sheet_;
  std::size_t next_ = 0;
};

}  // namespace clackers::record
