#include "clackers/campaign/store/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <optional>
#include <utility>
#include <variant>

#include "clackers/base/error.hpp"

namespace clackers::campaign {
namespace {

constexpr int busy_milliseconds = 50, busy_tries = 100;
// Between two looks at the interrupt; some tenths of a millisecond.
constexpr int instructions = 10000;
// Of a text or a statement; rows have less than a kilobyte.
constexpr int longest_value = 20'000'000;

bool is_interrupted(const Opened& opened) {
  return opened.interrupt != nullptr && *opened.interrupt;
}

int on_progress(void* opened) { return is_interrupted(*static_cast<Opened*>(opened)); }

int on_busy(void* opened, int tries) {
  if (tries >= busy_tries || is_interrupted(*static_cast<Opened*>(opened))) return 0;
  return sqlite3_sleep(busy_milliseconds);
}

// What a statement may do that only reads. Some pragmas act when they are prepared.
int allows(void*, int action, const char* name, const char*, const char*, const char*) {
  const bool reads = action == SQLITE_SELECT || action == SQLITE_READ ||
                     action == SQLITE_FUNCTION || action == SQLITE_RECURSIVE ||
                     (action == SQLITE_PRAGMA && std::string_view(name).starts_with("table_"));
  return reads ? SQLITE_OK : SQLITE_DENY;
}

[[noreturn]] void fail(sqlite3* database, const Opened& opened) {
  const auto& path = opened.path;
  const int code = database == nullptr ? SQLITE_NOMEM : sqlite3_errcode(database) & 0xff;
  const std::string reason = database == nullptr ? "out of memory" : sqlite3_errmsg(database);
  const auto sentence = [&](std::string_view what) {
    return fmt::format("{}: {} SQLite says: {}.", path, what, reason);
  };
  if (is_interrupted(opened) && (code == SQLITE_INTERRUPT || code == SQLITE_BUSY))
    throw Error("interrupted", "interrupted");
  switch (code) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
      if (sqlite3_db_readonly(database, "main") != 1)
        throw FileError(sentence("the database cannot be written; is the disk full? What was "
                                 "stored until now is kept; run the campaign again to go on."),
                        "cannot-write");
      [[fallthrough]];
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      throw FileError(sentence("the database cannot be read. One whose writer was killed is put in "
                               "order first, which needs a folder that can be written: copy it "
                               "there, with the files FILE-wal and FILE-shm beside it."),
                      "cannot-read");
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      throw InputError(
          sentence("this is no database of a campaign, or a damaged or half written one."),
          "not-a-campaign");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw InputError(
          sentence("another process is using the database. Try again when it is done."),
          "database-busy");
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    case SQLITE_AUTH:
      throw InputError(sentence("allowed: a statement that reads, such as SELECT."), "bad-syntax");
    default:
      throw InputError(sentence("the statement was refused."), "bad-syntax");
  }
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Statement::bind(int parameter, const record::Cell& cell) {
  auto* const s = statement_.get();
  int code = SQLITE_OK;
  if (const auto* real = std::get_if<double>(&cell))
    code = sqlite3_bind_double(s, parameter, *real);
  else if (const auto* number = std::get_if<long long>(&cell))
    code = sqlite3_bind_int64(s, parameter, *number);
  else if (const auto* text = std::get_if<std::string>(&cell))
    code = sqlite3_bind_text(s, parameter, text->data(), int(text->size()), SQLITE_TRANSIENT);
  else
    code = sqlite3_bind_null(s, parameter);
  if (code != SQLITE_OK) fail(database_, *opened_);
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(database_, *opened_);
  return false;
}

void Statement::bind(std::initializer_list<record::Cell> first,
                     std::span<const record::Cell> rest) {
  sqlite3_reset(statement_.get());
  int parameter = 0;
  for (const auto& cell : first) bind(++parameter, cell);
  for (const auto& cell : rest) bind(++parameter, cell);
}

void Statement::run(std::initializer_list<record::Cell> first, std::span<const record::Cell> rest) {
  bind(first, rest);
  while (step()) continue;
  sqlite3_reset(statement_.get());
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }

std::string Statement::column_name(int column) const {
  const auto* name = sqlite3_column_name(statement_.get(), column);
  if (name == nullptr) throw std::bad_alloc();
  return name;
}

record::Cell Statement::cell(int column) const {
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_INTEGER:
      return whole(column);
    case SQLITE_FLOAT:
      return sqlite3_column_double(statement_.get(), column);
    case SQLITE_NULL:
      return {};
    default:
      return text(column);
  }
}

long long Statement::whole(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr ? std::string() : std::string(bytes, std::size_t(size));
}

void Sqlite::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Sqlite::Sqlite(const std::string& path, OpenMode mode)
    : opened_(std::make_unique<Opened>(Opened{path})) {
  const int flags =
      mode == OpenMode::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* opened = nullptr;
  // A path that begins with ":" is a file, too.
  const auto name = path.starts_with('/') ? path : "./" + path;
  const int code = sqlite3_open_v2(name.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail(opened, *opened_);
  sqlite3_extended_result_codes(opened, 0);
  sqlite3_busy_handler(opened, on_busy, opened_.get());
  sqlite3_progress_handler(opened, instructions, on_progress, opened_.get());
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, longest_value);
  for (const auto& [option, value] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                      {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                      {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
    sqlite3_db_config(opened, option, value, nullptr);
}

Statement Sqlite::prepare(std::string_view sql) const {
  std::optional<Statement> found;
  int count = 0;
  for (auto rest = sql; !rest.empty();) {
    sqlite3_stmt* statement = nullptr;
    const char* end = nullptr;
    if (sqlite3_prepare_v2(database_.get(), rest.data(), int(rest.size()), &statement, &end) !=
        SQLITE_OK)
      fail(database_.get(), *opened_);
    if (end == rest.data()) break;  // a zero byte ends the text
    rest.remove_prefix(std::size_t(end - rest.data()));
    Statement prepared(database_.get(), statement, *opened_);
    if (statement == nullptr) continue;  // a comment, or nothing
    ++count;
    found.emplace(std::move(prepared));
  }
  if (count != 1)
    throw InputError(fmt::format("{}: \"{}\"; allowed: one statement in SQL.", path(), sql),
                     "bad-syntax");
  return std::move(*found);
}

void Sqlite::execute(const std::string& sql) const {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(database_.get(), *opened_);
}

long long Sqlite::whole(std::string_view sql) const {
  auto statement = prepare(sql);
  return statement.step() ? statement.whole(0) : 0;
}

long long Sqlite::changes() const { return sqlite3_changes64(database_.get()); }

Statement Sqlite::prepare_reading(std::string_view sql) const {
  const std::unique_ptr<sqlite3, void (*)(sqlite3*)> guarded(
      database_.get(),
      [](sqlite3* database) { sqlite3_set_authorizer(database, nullptr, nullptr); });
  sqlite3_set_authorizer(database_.get(), allows, nullptr);
  auto statement = prepare(sql);
  if (statement.columns() == 0)  // a pragma of a name that is none
    throw InputError(
        fmt::format("{}: \"{}\" has no columns; allowed: a statement that reads, such as SELECT.",
                    path(), sql),
        "bad-syntax");
  return statement;
}

std::string quoted_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace clackers::campaign
