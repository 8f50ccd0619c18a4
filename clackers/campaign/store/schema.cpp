#include "clackers/campaign/store/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/campaign/store.hpp"
#include "clackers/campaign/store/digest.hpp"
#include "clackers/record/record.hpp"

namespace clackers::campaign {
namespace {

std::string type_of(const record::Column& column) {
  if (column.kind == record::ColumnKind::real) return " REAL";
  if (column.kind == record::ColumnKind::whole) return " INTEGER";
  // Of a parameter with words and numbers: as given.
  return column.name.starts_with("set_") ? "" : " TEXT";
}

std::string definitions(const std::vector<record::Column>& columns) {
  std::string text;
  for (const auto& column : columns)
    text +=
        fmt::format("{}{}{}", text.empty() ? "" : ", ", quoted_name(column.name), type_of(column));
  return text;
}

std::string sql_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

[[noreturn]] void other_tables(const Sqlite& database, const std::string& what) {
  throw InputError(
      fmt::format(
          "{}: this is no database that this version of clackers wrote for a campaign, or a "
          "damaged one: {}. Run the campaign again into another file.",
          database.path(), what),
      "not-a-campaign");
}

const record::Column seconds_column{"seconds", "s", "processor time", record::ColumnKind::real};

}  // namespace

std::string schema_of(const Specification& specification, const std::string& shard) {
  const auto tables = tables_of(specification);
  auto subjects = definitions(tables.subjects);
  subjects.insert(subjects.find(" INTEGER") + 8, " PRIMARY KEY");
  const auto row = [](std::string_view key, std::string_view value) {
    return fmt::format("INSERT INTO campaign VALUES ({}, {});\n", sql_text(key), sql_text(value));
  };
  return fmt::format(
             "CREATE TABLE campaign (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;\n"
             "CREATE TABLE subjects ({});\n"
             "CREATE TABLE runs ({}, PRIMARY KEY (task, run)) WITHOUT ROWID;\n"
             "CREATE TABLE timings (task INTEGER, run INTEGER, seconds REAL, "
             "PRIMARY KEY (task, run)) WITHOUT ROWID;\n"
             "CREATE TABLE digests (task INTEGER PRIMARY KEY, runs INTEGER, of_subjects INTEGER, "
             "of_runs INTEGER, of_timings INTEGER);\n"
             "PRAGMA application_id = {};\nPRAGMA user_version = {};\n",
             subjects, definitions(tables.runs), application_id, schema_version) +
         row("specification", specification.text()) + row("file", specification.name()) +
         row("version", record::provenance("").version) +
         row("tasks", fmt::format("{}", specification.tasks())) + row("shard", shard);
}

bool is_blank(const Sqlite& database) {
  return database.whole("PRAGMA application_id") == 0 &&
         database.whole("SELECT count(*) FROM sqlite_master") == 0;
}

void require_campaign(const Sqlite& database) {
  if (database.whole("PRAGMA application_id") != application_id)
    throw InputError(
        fmt::format("{}: this is an SQLite database, but none of a campaign. Give another "
                    "name.",
                    database.path()),
        "not-a-campaign");
  const auto version = database.whole("PRAGMA user_version");
  if (version != schema_version)
    throw InputError(
        fmt::format("{}: the database has version {} of the schema; allowed: {}. It was written by "
                    "another version of clackers.",
                    database.path(), version, schema_version),
        "other-version");
  auto objects = database.prepare("SELECT type, name, rootpage FROM sqlite_master ORDER BY name");
  std::vector<std::string> found;
  while (objects.step()) {
    const bool is_virtual = objects.whole(2) == 0;  // it has no page of its own
    found.push_back((is_virtual ? "virtual " : "") + objects.text(0) + ' ' + objects.text(1));
  }
  const std::vector<std::string> expected{"table campaign", "table digests", "table runs",
                                          "table subjects", "table timings"};
  if (found != expected) other_tables(database, fmt::format("it has {}", fmt::join(found, ", ")));
}

void require_columns(const Sqlite& database, const Tables& tables) {
  for (const auto& [table, columns] :
       {std::pair{"subjects", &tables.subjects}, {"runs", &tables.runs}}) {
    auto found =
        database.prepare(fmt::format("SELECT name, hidden FROM pragma_table_xinfo('{}')", table));
    for (const auto& column : *columns)
      if (!found.step() || found.text(0) != column.name || found.whole(1) != 0)
        other_tables(database, fmt::format("{} has no column {}", table, column.name));
    if (found.step())
      other_tables(database, fmt::format("{} has the column {}", table, found.text(0)));
  }
}

void require_same(const Sqlite& database, const Specification& specification,
                  const Tables& tables) {
  require_campaign(database);
  require_sealed(database);
  if (value_of(database, "specification") != specification.text())
    throw InputError(
        fmt::format("{}: the database holds another campaign, whose specification differs. Give "
                    "another --database, or the specification that it was made with: clackers "
                    "campaign query {} \"SELECT value FROM campaign WHERE key = 'specification'\"",
                    database.path(), database.path()),
        "other-campaign");
  const auto version = value_of(database, "version"), ours = record::provenance("").version;
  if (version != ours)
    throw InputError(
        fmt::format("{}: clackers {} wrote the rows of this database; allowed: {}, since another "
                    "version may compute other numbers. Go on with {}, or give another --database.",
                    database.path(), version, ours, version),
        "other-version");
  require_columns(database, tables);
}

std::string value_of(const Sqlite& database, const std::string& key) {
  auto statement = database.prepare("SELECT value FROM campaign WHERE key = ?");
  statement.bind({key});
  return statement.step() ? statement.text(0) : std::string();
}

std::string insert_into(const std::string& table, std::size_t columns) {
  return fmt::format("INSERT OR IGNORE INTO {} VALUES ({})", table,
                     fmt::join(std::vector<std::string>(columns, "?"), ", "));
}

Selection subjects_selection(const Tables& tables, bool with_times) {
  Selection out;
  std::string names;
  for (const auto& column : tables.subjects) {
    out.columns.push_back(column);
    names += fmt::format("{}s.{}", names.empty() ? "" : ", ", quoted_name(column.name));
  }
  if (with_times) {
    out.columns.push_back(seconds_column);
    names += ", (SELECT sum(seconds) FROM timings t WHERE t.task = s.task)";
  }
  out.sql = fmt::format("SELECT {} FROM subjects s ORDER BY s.task", names);
  return out;
}

Selection runs_selection(const Tables& tables, bool with_times) {
  Selection out;
  std::string names;
  const auto add = [&](const record::Column& column, char table) {
    out.columns.push_back(column);
    names += fmt::format("{}{}.{}", names.empty() ? "" : ", ", table, quoted_name(column.name));
  };
  const auto is_of_run = [&](const record::Column& column) {
    return std::ranges::find(tables.runs, column.name, &record::Column::name) != tables.runs.end();
  };
  add(tables.subjects[0], 's');
  add(tables.runs[1], 'r');
  for (std::size_t i = 1; i < tables.subjects.size(); ++i)
    if (!is_of_run(tables.subjects[i])) add(tables.subjects[i], 's');
  for (std::size_t i = 2; i < tables.runs.size(); ++i) add(tables.runs[i], 'r');
  std::string join;
  if (with_times) {
    add(seconds_column, 't');
    join = " LEFT JOIN timings t ON t.task = r.task AND t.run = r.run";
  }
  out.sql = fmt::format(
      "SELECT {} FROM subjects s LEFT JOIN runs r ON r.task = s.task{} ORDER BY s.task, r.run",
      names, join);
  return out;
}

}  // namespace clackers::campaign
