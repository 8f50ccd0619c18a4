#pragma once

#include <span>

#include "clackers/input/results/result_reader.hpp"
#include "clackers/input/table.hpp"

namespace clackers::input {

/// All kinds of result files.
std::span<const ResultReader> result_readers();

/// The reader that is forced, or that recognises the first bytes of a file; nullptr for a plain table. Throws
/// InputError with did-you-mean for a name that there is not ("table" reads a plain one), and for Parquet,
/// which no reader takes.
const ResultReader* result_reader_of(InputFile& file, const ResultChoice& choice);

/// The rows of a result file as a table.
class ResultTable : public Table {
 public:
  ResultTable(InputFile file, const ResultReader& reader, const ResultChoice& choice,
              const std::vector<std::string>& names);

  bool next() override { return ++row_ * names().size() <= rows_.numbers.size(); }
  void read_number(std::size_t column, Number& number) override;
  RowSide side(std::size_t) const override { return RowSide::none; }
  std::string place() const override;
  std::size_t expected_rows() const override { return rows_.numbers.size() / names().size(); }
  double share() const override { return 1.0; }

 private:
  ResultRows rows_;
  std::size_t row_ = 0;
};

}  // namespace clackers::input
