#include "clackers/campaign/store/sqlite.hpp"

#include <cmath>
#include <utility>

namespace clackers::campaign {
namespace {

using record::Cell;

class SqlRows : public record::RowSource {
 public:
  SqlRows(std::string schema, std::vector<record::Column> columns, Statement statement)
      : schema_(std::move(schema)),
        columns_(std::move(columns)),
        statement_(std::move(statement)) {}

  std::string schema() const override { return schema_; }
  std::string title() const override { return {}; }
  const std::vector<record::Column>& columns() const override { return columns_; }
  bool next(std::vector<Cell>& row) override {
    if (!statement_.step()) return false;
    row.clear();
    for (int i = 0; i < statement_.columns(); ++i) row.push_back(statement_.cell(i));
    if (++made_ % 1000 == 0) report(0, 1);
    return true;
  }

 private:
  std::string schema_;
  std::vector<record::Column> columns_;
  Statement statement_;
  long long made_ = 0;
};

class SqlNumbers : public record::NumberRows {
 public:
  SqlNumbers(std::string schema, const std::vector<record::Column>& columns, Statement statement,
             long long count)
      : schema_(std::move(schema)), statement_(std::move(statement)), count_(count) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].kind != record::ColumnKind::any) {
        columns_.push_back(columns[i]);
        places_.push_back(int(i));
      }
  }

  std::string schema() const override { return schema_; }
  std::string title() const override { return {}; }
  const std::vector<record::Column>& columns() const override { return columns_; }
  long long count() const override { return count_; }
  bool next_block(std::vector<double>& values) override {
    constexpr int block = 1024;
    values.clear();
    for (int row = 0; row < block && made_ < count_ && statement_.step(); ++row, ++made_)
      for (const int place : places_) values.push_back(record::number_in(statement_.cell(place)));
    if (!values.empty()) report(made_, count_);
    return !values.empty();
  }

 private:
  std::string schema_;
  std::vector<record::Column> columns_;
  std::vector<int> places_;
  Statement statement_;
  long long count_, made_ = 0;
};

}  // namespace

std::unique_ptr<record::RowSource> sql_rows(const std::string& schema,
                                            std::vector<record::Column> columns,
                                            Statement statement) {
  return std::make_unique<SqlRows>(schema, std::move(columns), std::move(statement));
}

std::unique_ptr<record::RowSource> sql_numbers(const std::string& schema,
                                               const std::vector<record::Column>& columns,
                                               Statement statement, long long count) {
  return std::make_unique<SqlNumbers>(schema, columns, std::move(statement), count);
}

}  // namespace clackers::campaign
