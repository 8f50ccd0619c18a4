#pragma once

#include <cstdint>
#include <string>

#include "clackers/campaign/store/sqlite.hpp"

// What notices that a database is not as it was written: a digest of each task's rows, in the table
// `digests`, and one of the table `campaign`, in its row `digest`.
namespace clackers::campaign {

/// 64 bits over cells in their order, as SQLite gives them back: NaN is empty, -0 is 0. Another number
/// in one cell always changes them, since each step is a bijection; other changes go unnoticed once in
/// 2^64.
class Digest {
 public:
  /// Of the rows of a task that has `runs` runs.
  Digest(long long task, long long runs);
  void add(const record::Cell& cell);
  long long value() const { return static_cast<long long>(bits_); }

 private:
  void mix(std::uint64_t word);

  std::uint64_t bits_ = 0;
};

/// Throws InputError (not-a-campaign) unless each task's rows of a table ("subjects", "runs" or
/// "timings") are those of its digest. Reads the whole table.
void require_whole(const Sqlite& database, const std::string& table);

/// Keeps the digest of the table `campaign` in it.
void seal(const Sqlite& database);
/// Throws InputError (not-a-campaign) unless the table `campaign` is as seal() left it.
void require_sealed(const Sqlite& database);

}  // namespace clackers::campaign
