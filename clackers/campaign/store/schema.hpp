#pragma once

#include <string>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/store/sqlite.hpp"
#include "clackers/campaign/tasks.hpp"

namespace clackers::campaign {

/// The statements that make the tables and the rows of `campaign`.
std::string schema_of(const Specification& specification, const std::string& shard);

/// Whether a file was made but holds nothing yet, as one whose first writer was killed.
bool is_blank(const Sqlite& database);
/// Throws InputError unless this is a database of a campaign (not-a-campaign) in our version of the
/// schema (other-version), with the tables of schema_of() and nothing else: no view, trigger, index or
/// virtual table.
void require_campaign(const Sqlite& database);
/// Throws InputError (not-a-campaign) unless the tables have the columns of schema_of(), none computed.
void require_columns(const Sqlite& database, const Tables& tables);
/// Throws as the two above and require_sealed() do, and unless the database is of this specification
/// (other-campaign), written by this version of clackers (other-version).
void require_same(const Sqlite& database, const Specification& specification, const Tables& tables);
/// A value of the table `campaign`; empty where there is none.
std::string value_of(const Sqlite& database, const std::string& key);

/// INSERT OR IGNORE with a parameter for each column.
std::string insert_into(const std::string& table, std::size_t columns);

/// A query for the rows of `runs` or `subjects` as they are exported, and its columns.
struct Selection {
  std::string sql;
  std::vector<record::Column> columns;
};
Selection subjects_selection(const Tables& tables, bool with_times);
Selection runs_selection(const Tables& tables, bool with_times);

}  // namespace clackers::campaign
