#pragma once

#include <cstdint>
#include <string>

#include "clackers/campaign/store/sqlite.hpp"

// What notices that a database is not as it was written: a digest of each task's rows, in the table
// `digests`, and one of the table `campaign`, in its row `digest`.
namespace clackers::campaign {

/// The digest of some cells, 64 bits, with another behind them. Cells count as SQLite gives them back:
/// NaN is empty, -0 is 0. Another number in one cell always changes it, since each step is a bijection;
/// other changes go unnoticed once in 2^64.
std::uint64_t digest(std::uint64_t before, const record::Cell& cell);

/// Throws InputError (not-a-campaign) unless each task's rows of a table ("subjects", "runs" or
/// "timings") are those of its digest. Reads the whole table.
void require_whole(const Sqlite& database, const std::string& table);

/// Keeps the digest of the table `campaign` in it.
void seal(const Sqlite& database);
/// Throws InputError (not-a-campaign) unless the table `campaign` is as seal() left it.
void require_sealed(const Sqlite& database);

}  // namespace clackers::campaign
