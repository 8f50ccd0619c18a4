#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "clackers/campaign/specification.hpp"
#include "clackers/campaign/task_source.hpp"
#include "clackers/campaign/tasks.hpp"
#include "clackers/record/record.hpp"
#include "clackers/record/sheet.hpp"

// The database of a campaign: one SQLite file, documented in docs/manual/reference/campaign-database.md.
namespace clackers::campaign {

/// PRAGMA user_version of the file; PRAGMA application_id says that it is a campaign ("clkr").
inline constexpr int schema_version = 2;
inline constexpr int application_id = 0x636c6b72;

/// The tables that are written as sheets.
enum class TableName { subjects, runs };

/// Who computed the rows of a database, with what, where and when.
struct Origin {
  std::string author;  ///< empty: nobody was named
  record::Provenance from;
};

/// How far a campaign is.
struct Counts {
  long long tasks = 0, runs = 0;  ///< finished
  std::map<std::string, long long> verdicts;
};

/// A database open for writing (one writer at a time, any number of readers) or for reading. Not
/// thread-safe. A task is finished when its row stands in `subjects`.
///
/// What is opened may come from anybody: one with other tables and columns, views or triggers is
/// refused (not-a-campaign), and so is what differs from the digests kept with it, by what reads it.
class Store {
 public:
  /// Opens the database of this campaign for writing; makes it where there is no file. `shard` is kept
  /// in a new one: "3/16", empty for a whole campaign. Throws InputError: not-a-campaign, other-version,
  /// other-campaign, database-busy; FileError: cannot-read, cannot-write. The file of a shard or rank is
  /// not read by others meanwhile: it works without shared memory, as on a network file system.
  static Store create_or_open(const std::string& path, const Specification& specification,
                              const std::string& shard = {});
  /// Opens an existing database for reading. Throws as above; cannot-read where there is none. Once
  /// `interrupt` is true, every function of it ends with Error (interrupted).
  static Store open(const std::string& path, const std::atomic<bool>* interrupt = nullptr);

  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  const std::string& path() const;
  const Specification& specification() const;
  const std::string& shard() const;
  TaskSet finished() const;
  Origin origin() const;
  /// Keeps the origin in the database.
  void sign(const Origin& origin);

  /// Adds the rows of tasks in one transaction; a task that is finished already stays as it is. Throws
  /// FileError (cannot-write), and the database is as before.
  void write(std::span<const TaskRows> tasks);
  /// Adds the finished tasks of another database of the same campaign, which nobody may be writing;
  /// returns how many were new. A transaction for each call, of which nothing stays once `interrupt` is
  /// true.
  long long merge(const std::string& path, const std::atomic<bool>* interrupt = nullptr);

  /// Counts rows without a look at their digests.
  Counts counts() const;

  /// The rows of a table in the order of (task, run); `runs` with the columns of its subject before its
  /// own. With times, a column `seconds` behind. The store must outlive the rows.
  std::unique_ptr<record::RowSource> rows(TableName table, bool with_times = false) const;
  /// The columns of numbers alone, what is empty NaN: NumPy's format takes these.
  std::unique_ptr<record::RowSource> numbers(TableName table, bool with_times = false) const;
  /// The rows of a statement in SQL that only reads; `kinds` of columns are any. Throws
  /// InputError (bad-syntax) with what SQLite says.
  std::unique_ptr<record::RowSource> query(const std::string& sql) const;

 private:
  struct Connection;
  explicit Store(std::unique_ptr<Connection> connection);

  std::unique_ptr<Connection> connection_;
};

/// The shard files beside a database: "PATH.shard-3-of-16" and "PATH.rank-5", sorted.
std::vector<std::string> shard_files(const std::string& path);
/// Whether a path is that of such a file.
bool is_shard_file(const std::string& path);
/// Merges the files of ranks beside a database, left by ranks that were lost, and removes them; returns
/// how many tasks were new.
long long adopt_ranks(Store& store);
std::string shard_path(const std::string& path, const Shard& shard);
/// The file of a rank: "PATH.rank-5".
std::string rank_path(const std::string& path, long long rank);
/// Removes a database that is closed, with the files that SQLite keeps beside it.
void remove_database(const std::string& path);

}  // namespace clackers::campaign
