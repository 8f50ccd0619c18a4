#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clackers/campaign/store/sqlite.hpp"

namespace clackers::campaign {

/// The rows of a statement; the database must outlive it.
std::unique_ptr<record::RowSource> sql_rows(const std::string& schema, const std::string& title,
                                            std::vector<record::Column> columns,
                                            Statement statement);

/// The columns of numbers alone, `columns` being those of the statement; what is empty is NaN.
/// `count` is the number of rows.
std::unique_ptr<record::RowSource> sql_numbers(const std::string& schema, const std::string& title,
                                               const std::vector<record::Column>& columns,
                                               Statement statement, long long count);

}  // namespace clackers::campaign
