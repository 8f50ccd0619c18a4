#include "clackers/campaign/store/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <variant>

#include "clackers/base/error.hpp"

namespace clackers::campaign {
namespace {

constexpr int busy_milliseconds = 5000;

[[noreturn]] void fail(sqlite3* database, const std::string& path) {
  const int code = database == nullptr ? SQLITE_NOMEM : sqlite3_errcode(database) & 0xff;
  const std::string reason = database == nullptr ? "out of memory" : sqlite3_errmsg(database);
  const auto sentence = [&](std::string_view what) {
    return fmt::format("{}: {} SQLite says: {}.", path, what, reason);
  };
  switch (code) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
      throw FileError(sentence("the database cannot be written; is the disk full? What was stored "
                               "until now is kept; run the campaign again to go on."),
                      "cannot-write");
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      throw FileError(sentence("the database cannot be opened."), "cannot-read");
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
    code = sqlite3_bind_text(s, parameter, text->data(), int(text->size()), SQLITE_STATIC);
  else
    code = sqlite3_bind_null(s, parameter);
  if (code != SQLITE_OK) fail(database_, *path_);
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(database_, *path_);
  return false;
}

void Statement::run() {
  while (step()) continue;
  sqlite3_reset(statement_.get());
}

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }

std::string Statement::column_name(int column) const {
  return sqlite3_column_name(statement_.get(), column);
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

bool Statement::only_reads() const { return sqlite3_stmt_readonly(statement_.get()) != 0; }

void Sqlite::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Sqlite::Sqlite(const std::string& path, OpenMode mode)
    : path_(std::make_unique<std::string>(path)) {
  const int flags =
      mode == OpenMode::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* opened = nullptr;
  // A path that begins with ":" is a file, too.
  const auto name = path.starts_with('/') ? path : "./" + path;
  const int code = sqlite3_open_v2(name.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail(opened, path);
  sqlite3_extended_result_codes(opened, 0);
  sqlite3_busy_timeout(opened, busy_milliseconds);
}

Statement Sqlite::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  const char* rest = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.data(), int(sql.size()), &statement, &rest) !=
      SQLITE_OK)
    fail(database_.get(), path());
  Statement prepared(database_.get(), statement, *path_);
  const std::string_view behind(rest, sql.size() - std::size_t(rest - sql.data()));
  if (statement == nullptr || behind.find_first_not_of(" \t\r\n;") != behind.npos)
    throw InputError(fmt::format("{}: \"{}\"; allowed: one statement in SQL.", path(), sql),
                     "bad-syntax");
  return prepared;
}

void Sqlite::execute(const std::string& sql) const {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail(database_.get(), path());
}

long long Sqlite::whole(std::string_view sql) const {
  auto statement = prepare(sql);
  return statement.step() ? statement.whole(0) : 0;
}

long long Sqlite::changes() const { return sqlite3_changes64(database_.get()); }

void Sqlite::only_read() const {
  sqlite3_limit(database_.get(), SQLITE_LIMIT_ATTACHED, 0);
  execute("PRAGMA query_only = 1");
}

std::string quoted_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace clackers::campaign
