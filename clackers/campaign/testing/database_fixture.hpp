#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "clackers/campaign/store.hpp"

namespace clackers::campaign::test {

/// Twelve short tasks on two cases.
inline Specification small() {
  return Specification::from_toml(
      "methods = [\"newmark\", \"rk4\", \"newmark+penalty\"]\nmetrics = [\"u-end\"]\n"
      "[ladder]\nlevels = 2\nsamples_per_level = 2\n"
      "[[cases]]\ncase = \"stop\"\nset = { eta = [0.5, 1], t_end = 3 }\n"
      "[[cases]]\ncase = \"three-parameter\"\nset = { xi1 = { from = 0.0, to = 0.1, points = 2 } }\n",
      "spec.toml");
}

/// A folder of its own for each test.
class DatabaseTest : public ::testing::Test {
 protected:
  using Rows = std::vector<std::vector<record::Cell>>;

  DatabaseTest() {
    std::string name = (std::filesystem::temp_directory_path() / "clackers-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~DatabaseTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }

  static Rows read(record::RowSource& source) {
    Rows rows;
    for (std::vector<record::Cell> row; source.next(row);) rows.push_back(row);
    return rows;
  }
  /// Of the table subjects and of the table runs.
  std::vector<Rows> rows(const std::string& name) const {
    const auto store = Store::open(path(name));
    return {read(*store.rows(TableName::subjects)), read(*store.rows(TableName::runs))};
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace clackers::campaign::test
