#pragma once

#include <atomic>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/sheet.hpp"

struct sqlite3;
struct sqlite3_stmt;
// The only file that calls SQLite.
namespace clackers::campaign {

enum class OpenMode { read, write };

/// What messages name, and what ends a statement.
struct Opened {
  std::string path;
  const std::atomic<bool>* interrupt = nullptr;
};

/// A prepared statement. The database must outlive it.
class Statement {
 public:
  Statement(sqlite3* database, sqlite3_stmt* statement, const Opened& opened)
      : database_(database), statement_(statement), opened_(&opened) {}

  /// Begins anew with these parameters.
  void bind(std::initializer_list<record::Cell> first, std::span<const record::Cell> rest = {});
  /// True while there is a row.
  bool step();
  /// The same, to its end.
  void run(std::initializer_list<record::Cell> first, std::span<const record::Cell> rest = {});

  int columns() const;
  std::string column_name(int column) const;
  record::Cell cell(int column) const;
  long long whole(int column) const;
  std::string text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void bind(int parameter, const record::Cell& cell);

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  const Opened* opened_;
};

/// An open SQLite file, with nothing in effect that its schema may bring along. Whatever fails throws: a
/// full disk or one that cannot be written FileError (cannot-write), one that cannot be read FileError
/// (cannot-read), a file that is no database or a damaged one InputError (not-a-campaign), a locked one
/// InputError (database-busy), a statement that SQLite does not understand InputError (bad-syntax).
class Sqlite {
 public:
  Sqlite() = default;  ///< of nothing
  /// `write` makes the file where there is none.
  Sqlite(const std::string& path, OpenMode mode);

  const std::string& path() const { return opened_->path; }
  /// From here on a statement ends with Error (interrupted) soon after the flag became true; nullptr:
  /// none does.
  void end_on(const std::atomic<bool>* interrupt) const { opened_->interrupt = interrupt; }
  /// Throws InputError (bad-syntax), also for more or less than one statement; comments may stand
  /// around it.
  Statement prepare(std::string_view sql) const;
  /// The same for a statement that only reads. Throws InputError (bad-syntax) for any other.
  Statement prepare_reading(std::string_view sql) const;
  /// Several statements, separated by semicolons, none with rows.
  void execute(const std::string& sql) const;
  /// The number in the first column of the first row.
  long long whole(std::string_view sql) const;
  /// Rows changed by the last statement.
  long long changes() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };

  std::unique_ptr<Opened> opened_;  // statements point to it
  std::unique_ptr<sqlite3, Close> database_;
};

/// A name as SQL writes it: "set_N", "metric:u-maximum".
std::string quoted_name(std::string_view name);

/// One writer of a database at a time: a lock on the file "PATH.lock", which the system releases when
/// the process ends, however it ends.
class WriterLock {
 public:
  /// Throws InputError (database-busy) while another one holds it, FileError (cannot-write) where the
  /// file cannot be made.
  explicit WriterLock(const std::string& path);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  std::string file_;
  int descriptor_ = -1;
};

/// The rows of a statement; the database must outlive it.
std::unique_ptr<record::RowSource> sql_rows(const std::string& schema,
                                            std::vector<record::Column> columns,
                                            Statement statement);

/// The columns of numbers alone, `columns` being those of the statement; what is empty is NaN.
/// `count` is the number of rows.
std::unique_ptr<record::RowSource> sql_numbers(const std::string& schema,
                                               const std::vector<record::Column>& columns,
                                               Statement statement, long long count);

}  // namespace clackers::campaign
