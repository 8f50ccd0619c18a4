#include "clackers/campaign/store.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/campaign/store/digest.hpp"
#include "clackers/campaign/store/schema.hpp"
#include "clackers/campaign/store/sqlite.hpp"

namespace clackers::campaign {
namespace {

// Rolls back unless committed.
class Transaction {
 public:
  explicit Transaction(const Sqlite& database) : database_(database) {
    database_.execute("BEGIN IMMEDIATE");
  }
  ~Transaction() {
    if (!committed_) try {
        database_.execute("ROLLBACK");
      } catch (...) {
        // SQLite has rolled back by itself, or does when it closes.
      }
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit() {
    database_.execute("COMMIT");
    committed_ = true;
  }

 private:
  const Sqlite& database_;
  bool committed_ = false;
};

void require_file(const std::string& path) {
  if (std::filesystem::is_regular_file(path)) return;
  throw FileError(
      fmt::format(
          "{}: {}. A database is made by: clackers campaign run SPEC.toml", path,
          std::filesystem::exists(path) ? "this is no ordinary file" : "there is no such file"),
      "cannot-read");
}

}  // namespace

// The members are closed in the reverse order: the lock last.
struct Store::Connection {
  // The statements that add rows.
  struct Inserts {
    Statement subject, run, timing, digests;
  };

  // After the last writer the database is one file, unless somebody reads it.
  ~Connection() {
    if (!inserts) return;
    inserts.reset();
    try {
      database.execute("PRAGMA busy_timeout = 0; PRAGMA journal_mode = DELETE;");
    } catch (...) {
      // The next writer does it, where there is no memory either.
    }
  }

  // The rows of a table that are as they were written.
  Selection checked(TableName table, bool with_times) const {
    require_whole(database, "subjects");
    if (table == TableName::runs) require_whole(database, "runs");
    if (with_times) require_whole(database, "timings");
    return table == TableName::runs ? runs_selection(tables, with_times)
                                    : subjects_selection(tables, with_times);
  }

  std::unique_ptr<WriterLock> lock;
  Sqlite database;
  Specification specification;
  std::string shard;
  Tables tables;
  std::optional<Inserts> inserts{};
};

Store::Store(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Store Store::create_or_open(const std::string& path, const Specification& specification,
                            const std::string& shard) {
  auto lock = std::make_unique<WriterLock>(path);
  auto made = std::make_unique<Connection>();
  auto& connection = *made;
  connection.lock = std::move(lock);
  connection.database = Sqlite(path, OpenMode::write);
  connection.specification = specification;
  connection.shard = shard;
  connection.tables = tables_of(specification);
  const auto& database = connection.database;
  const bool is_new = is_blank(database);
  if (!is_new) {
    require_same(database, specification, connection.tables);
    connection.shard = value_of(database, "shard");
  }
  if (is_shard_file(path)) database.execute("PRAGMA locking_mode = EXCLUSIVE");
  database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;");
  if (is_new) {
    Transaction transaction(database);
    database.execute(schema_of(specification, shard));
    seal(database);
    transaction.commit();
  }
  connection.inserts.emplace(Connection::Inserts{
      database.prepare(insert_into("subjects", connection.tables.subjects.size())),
      database.prepare(insert_into("runs", connection.tables.runs.size())),
      database.prepare(insert_into("timings", 3)), database.prepare(insert_into("digests", 5))});
  return Store(std::move(made));
}

Store Store::open(const std::string& path, const std::atomic<bool>* interrupt) {
  require_file(path);
  auto made = std::make_unique<Connection>();
  auto& connection = *made;
  connection.database = Sqlite(path, OpenMode::read);
  const auto& database = connection.database;
  database.end_on(interrupt);
  require_campaign(database);
  require_sealed(database);
  try {
    connection.specification =
        Specification::from_toml(value_of(database, "specification"), value_of(database, "file"));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()), error.code());
  }
  connection.shard = value_of(database, "shard");
  connection.tables = tables_of(connection.specification);
  require_columns(database, connection.tables);
  return Store(std::move(made));
}

const std::string& Store::path() const { return connection_->database.path(); }
const Specification& Store::specification() const { return connection_->specification; }
const std::string& Store::shard() const { return connection_->shard; }

TaskSet Store::finished() const {
  TaskSet tasks;
  auto statement = connection_->database.prepare("SELECT task FROM subjects ORDER BY task");
  while (statement.step()) tasks.append(statement.whole(0));
  return tasks;
}

void Store::write(std::span<const TaskRows> tasks) {
  auto& connection = *connection_;
  auto& [subject, run, timing, digests] = connection.inserts.value();
  Transaction transaction(connection.database);
  const auto with = [](std::uint64_t bits, std::span<const record::Cell> cells) {
    for (const auto& cell : cells) bits = digest(bits, cell);
    return bits;
  };
  for (const auto& rows : tasks) {
    const auto count = static_cast<long long>(rows.runs.size());
    const auto none = digest(digest(0, rows.task), count);
    auto of_runs = none, of_timings = none;
    subject.run({rows.task}, rows.subject);
    if (connection.database.changes() == 0) continue;
    for (std::size_t i = 0; i < rows.runs.size(); ++i) {
      const auto number = static_cast<long long>(i + 1);
      run.run({rows.task, number}, rows.runs[i]);
      timing.run({rows.task, number, rows.seconds[i]});
      of_runs = with(digest(of_runs, number), rows.runs[i]);
      of_timings = digest(digest(of_timings, number), rows.seconds[i]);
    }
    const auto kept = [](std::uint64_t bits) { return static_cast<long long>(bits); };
    digests.run(
        {rows.task, count, kept(with(none, rows.subject)), kept(of_runs), kept(of_timings)});
  }
  transaction.commit();
}

long long Store::merge(const std::string& path, const std::atomic<bool>* interrupt) {
  require_file(path);
  const WriterLock lock(path);
  {
    const Sqlite other(path, OpenMode::write);
    other.end_on(interrupt);
    if (is_blank(other)) return 0;
    require_same(other, specification(), connection_->tables);
    for (const auto* table : {"subjects", "runs", "timings"}) require_whole(other, table);
  }
  const auto& database = connection_->database;
  database.end_on(interrupt);
  database.prepare("ATTACH ? AS other").run({path.starts_with('/') ? path : "./" + path});
  long long added = 0;
  try {
    Transaction transaction(database);
    for (const auto* table : {"runs", "timings", "digests"})
      database.execute(
          fmt::format("INSERT INTO main.{0} SELECT * FROM other.{0} WHERE task NOT IN "
                      "(SELECT task FROM main.subjects)",
                      table));
    database.execute("INSERT OR IGNORE INTO main.subjects SELECT * FROM other.subjects");
    added = database.changes();
    transaction.commit();
  } catch (...) {
    database.end_on(nullptr);
    database.execute("DETACH other");
    throw;
  }
  database.end_on(nullptr);
  database.execute("DETACH other");
  return added;
}

Origin Store::origin() const {
  const auto value = [&](const char* key) { return value_of(connection_->database, key); };
  return {value("author"),
          {value("command"), value("version"), value("compiler"), value("machine"),
           value("processor"), value("date")}};
}

void Store::sign(const Origin& origin) {
  const auto& [command, version, compiler, machine, processor, date] = origin.from;
  auto statement = connection_->database.prepare("INSERT OR REPLACE INTO campaign VALUES (?, ?)");
  Transaction transaction(connection_->database);
  for (const auto& [key, value] : {std::pair{"author", origin.author},
                                   {"command", command},
                                   {"compiler", compiler},
                                   {"machine", machine},
                                   {"processor", processor},
                                   {"date", date}})
    statement.run({key, value});
  seal(connection_->database);
  transaction.commit();
}

Counts Store::counts() const {
  const auto& database = connection_->database;
  Counts counts;
  counts.runs = database.whole("SELECT sum(runs) FROM digests");
  auto statement = database.prepare("SELECT verdict, count(*) FROM subjects GROUP BY verdict");
  while (statement.step()) {
    counts.verdicts[statement.text(0)] = statement.whole(1);
    counts.tasks += statement.whole(1);
  }
  return counts;
}

std::unique_ptr<record::RowSource> Store::rows(TableName table, bool with_times) const {
  const auto selection = connection_->checked(table, with_times);
  const std::string name = table == TableName::runs ? "runs" : "subjects";
  return sql_rows("clackers/campaign-" + name + "/1", selection.columns,
                  connection_->database.prepare(selection.sql));
}

std::unique_ptr<record::RowSource> Store::numbers(TableName table, bool with_times) const {
  const auto& database = connection_->database;
  const auto selection = connection_->checked(table, with_times);
  // A task that was refused has a row as well.
  const auto count =
      database.whole(table == TableName::runs ? "SELECT sum(max(runs, 1)) FROM digests"
                                              : "SELECT count(*) FROM digests");
  return sql_numbers("clackers/campaign/1", selection.columns, database.prepare(selection.sql),
                     count);
}

std::unique_ptr<record::RowSource> Store::query(const std::string& sql) const {
  const auto& database = connection_->database;
  auto statement = database.prepare_reading(sql);
  // There are no views, so that a statement names the tables that it reads.
  for (const auto* table : {"subjects", "runs", "timings"})
    if (::strcasestr(sql.c_str(), table) != nullptr) require_whole(database, table);
  std::vector<record::Column> columns;
  for (int i = 0; i < statement.columns(); ++i)
    columns.push_back({statement.column_name(i), "", ""});
  return sql_rows("clackers/campaign-query/1", std::move(columns), std::move(statement));
}

}  // namespace clackers::campaign
