#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "clackers/input/numbers/npy_file.hpp"
#include "clackers/input/source.hpp"
#include "clackers/input/table.hpp"

namespace clackers::input {

/// Rows of columns of doubles: those of a caller, or the blocks of a NumPy file. Rows count from 0,
/// as NumPy counts them. A number has the digits of its shortest text, so that what was printed once
/// and read again is known as such.
class NumberTable : public Table {
 public:
  /// Of memory, which must outlive the table. Throws as open_table() does.
  NumberTable(const NumberColumns& columns, const std::vector<std::string>& names, TableKind kind,
              const std::atomic<bool>* interrupt);
  NumberTable(NpyFile file, const std::vector<std::string>& names, TableKind kind,
              const std::atomic<bool>* interrupt);

  bool next() override;
  void read_number(std::size_t column, Number& number) override;
  RowSide side(std::size_t column) const override;
  std::string place() const override;
  std::size_t expected_rows() const override;
  double share() const override;

 private:
  void name_columns(const std::vector<std::string>& given, TableKind kind);
  double value(std::size_t column) const;

  std::optional<NpyFile> file_;
  const NumberColumns* block_;
  std::size_t rows_;            ///< of all blocks
  std::size_t next_row_ = 0;    ///< the present row is the one before it
  std::size_t next_block_ = 0;  ///< first row of the block behind the present one
  std::vector<int> digits_;     ///< of each column, the most so far
  const std::atomic<bool>* interrupt_;
};

}  // namespace clackers::input
