#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clackers/input/table.hpp"

namespace clackers::input {

/// The paths of "a.out+b.out" where there is no file of that name; else the path alone.
std::vector<std::string> joined_paths(const std::string& path);

/// For each of `count` files the names of its columns: "t,u1,u2+t,v1,v2" between commas. Throws InputError
/// (ragged-row) for another number of lists than of files; no names are none of any file.
std::vector<std::vector<std::string>> joined_names(const std::string& path,
                                                   const std::vector<std::string>& names,
                                                   std::size_t count);

/// Columns of several tables, as recorders write them, in the rows whose time stands in all of them.
class JoinedTable : public Table {
 public:
  /// Throws InputError (no-column) for a table without t.
  JoinedTable(std::string name, std::vector<std::unique_ptr<Table>> tables);

  bool next() override;
  void read_number(std::size_t column, Number& number) override;
  RowSide side(std::size_t column) const override;
  std::string place() const override { return tables_.front()->place(); }
  std::size_t expected_rows() const override { return tables_.front()->expected_rows(); }
  double share() const override { return tables_.front()->share(); }
  std::vector<Note> notes() const override { return tables_.front()->notes(); }

 private:
  double time_of(std::size_t table);

  std::vector<std::unique_ptr<Table>> tables_;
  std::vector<std::size_t> times_;                            // of each table its column t
  std::vector<std::pair<std::size_t, std::size_t>> columns_;  // table and column in it
};

}  // namespace clackers::input
