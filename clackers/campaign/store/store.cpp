#include "clackers/campaign/store.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "clackers/base/error.hpp"
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
      } catch (const Error&) {
        // SQLite has rolled back by itself.
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
  throw FileError(fmt::format("{}: there is no such file. A database is made by: clackers campaign "
                              "run SPEC.toml",
                              path),
                  "cannot-read");
}

}  // namespace

// The members are closed in the reverse order: the lock last.
struct Store::Connection {
  // The statements that add rows.
  struct Inserts {
    Statement subject, run, timing;
  };

  // After the last writer the database is one file, unless somebody reads it.
  ~Connection() {
    if (!inserts) return;
    inserts.reset();
    try {
      database.execute("PRAGMA busy_timeout = 0; PRAGMA journal_mode = DELETE;");
    } catch (const Error&) {
      // The next writer does it.
    }
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
    require_campaign(database);
    require_same(database, specification);
    connection.shard = value_of(database, "shard");
  }
  if (is_shard_file(path)) database.execute("PRAGMA locking_mode = EXCLUSIVE");
  database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;");
  if (is_new) database.execute(schema_of(specification, shard));
  connection.inserts.emplace(Connection::Inserts{
      database.prepare(insert_into("subjects", connection.tables.subjects.size())),
      database.prepare(insert_into("runs", connection.tables.runs.size())),
      database.prepare(insert_into("timings", 3))});
  return Store(std::move(made));
}

Store Store::open(const std::string& path) {
  require_file(path);
  auto made = std::make_unique<Connection>();
  auto& connection = *made;
  connection.database = Sqlite(path, OpenMode::read);
  const auto& database = connection.database;
  require_campaign(database);
  try {
    connection.specification =
        Specification::from_toml(value_of(database, "specification"), value_of(database, "file"));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()), error.code());
  }
  connection.shard = value_of(database, "shard");
  connection.tables = tables_of(connection.specification);
  require_tables(database, connection.tables);
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
  auto& [subject, run, timing] = connection.inserts.value();
  Transaction transaction(connection.database);
  const auto bind = [](Statement& statement, int first, const std::vector<record::Cell>& cells) {
    for (const auto& cell : cells) statement.bind(first++, cell);
  };
  for (const auto& rows : tasks) {
    const record::Cell task = rows.task;
    subject.bind(1, task);
    bind(subject, 2, rows.subject);
    subject.run();
    if (connection.database.changes() == 0) continue;
    for (std::size_t i = 0; i < rows.runs.size(); ++i) {
      const record::Cell number = static_cast<long long>(i + 1);
      run.bind(1, task);
      run.bind(2, number);
      bind(run, 3, rows.runs[i]);
      run.run();
      timing.bind(1, task);
      timing.bind(2, number);
      timing.bind(3, rows.seconds[i]);
      timing.run();
    }
  }
  transaction.commit();
}

long long Store::merge(const std::string& path) {
  require_file(path);
  const WriterLock lock(path);
  {
    const Sqlite other(path, OpenMode::write);
    if (is_blank(other)) return 0;
    require_campaign(other);
    require_same(other, specification());
  }
  const auto& database = connection_->database;
  auto attach = database.prepare("ATTACH ? AS other");
  const record::Cell name = path.starts_with('/') ? path : "./" + path;
  attach.bind(1, name);
  attach.run();
  long long added = 0;
  try {
    Transaction transaction(database);
    for (const auto* table : {"runs", "timings"})
      database.execute(
          fmt::format("INSERT INTO main.{0} SELECT * FROM other.{0} WHERE task NOT IN "
                      "(SELECT task FROM main.subjects)",
                      table));
    database.execute("INSERT OR IGNORE INTO main.subjects SELECT * FROM other.subjects");
    added = database.changes();
    transaction.commit();
  } catch (...) {
    database.execute("DETACH other");
    throw;
  }
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
                                   {"date", date}}) {
    const record::Cell cells[] = {std::string(key), value};
    statement.bind(1, cells[0]);
    statement.bind(2, cells[1]);
    statement.run();
  }
  transaction.commit();
}

std::unique_ptr<record::RowSource> Store::rows(TableName table, bool with_times) const {
  const auto& [lock, database, specification, shard, tables, inserts] = *connection_;
  auto selection = table == TableName::runs ? runs_selection(tables, with_times)
                                            : subjects_selection(tables, with_times);
  const std::string name = table == TableName::runs ? "runs" : "subjects";
  return sql_rows("clackers/campaign-" + name + "/1", "", std::move(selection.columns),
                  database.prepare(selection.sql));
}

std::unique_ptr<record::RowSource> Store::numbers(TableName table, bool with_times) const {
  const auto& database = connection_->database;
  const auto& tables = connection_->tables;
  const auto selection = table == TableName::runs ? runs_selection(tables, with_times)
                                                  : subjects_selection(tables, with_times);
  const auto count = database.whole(fmt::format("SELECT count(*) FROM ({})", selection.sql));
  return sql_numbers("clackers/campaign/1", "", selection.columns, database.prepare(selection.sql),
                     count);
}

std::unique_ptr<record::RowSource> Store::query(const std::string& sql) const {
  const auto& database = connection_->database;
  database.only_read();
  auto statement = database.prepare(sql);
  if (!statement.only_reads())
    throw InputError(
        fmt::format("{}: \"{}\"; allowed: a statement that reads, such as SELECT.", path(), sql),
        "bad-syntax");
  std::vector<record::Column> columns;
  for (int i = 0; i < statement.columns(); ++i)
    columns.push_back({statement.column_name(i), "", ""});
  return sql_rows("clackers/campaign-query/1", "", std::move(columns), std::move(statement));
}

}  // namespace clackers::campaign
