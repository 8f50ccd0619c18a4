#pragma once

#include <string>
#include <variant>
#include <vector>

namespace clackers::study {

/// Empty, a real number, a whole number or text.
using Cell = std::variant<std::monostate, double, long long, std::string>;

struct Column {
  std::string name;  ///< as in csv and json: "t", "u1", "v1-"
  std::string unit;  ///< "s", empty when dimensionless or text
  std::string meaning;
};

/// Rows for a person or a program, asked for one by one so that a billion need no memory.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual std::string schema() const = 0;  ///< "clackers/response/1"
  virtual std::string title() const = 0;   ///< above the table, empty for none
  virtual const std::vector<Column>& columns() const = 0;
  /// Fills `row` (one cell a column), or returns false after the last row.
  virtual bool next(std::vector<Cell>& row) = 0;
};

/// Rows held in memory.
struct Sheet {
  std::string schema, title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

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

}  // namespace clackers::study
