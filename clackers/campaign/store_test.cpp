#include "clackers/campaign/store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/campaign/store/digest.hpp"
#include "clackers/campaign/testing/database_fixture.hpp"

namespace clackers::campaign {
namespace {

class StoreTest : public test::DatabaseTest {
 protected:
  // A task with made-up rows.
  static TaskRows rows_of(long long task, std::size_t runs = 2) {
    const auto tables = tables_of(test::small());
    TaskRows rows;
    rows.task = task;
    for (std::size_t i = 1; i < tables.subjects.size(); ++i)
      rows.subject.push_back(cell(tables.subjects[i], double(task) + double(i) / 16.0));
    for (std::size_t run = 0; run < runs; ++run) {
      auto& cells = rows.runs.emplace_back();
      for (std::size_t i = 2; i < tables.runs.size(); ++i)
        cells.push_back(cell(tables.runs[i], double(run)));
      rows.seconds.push_back(0.25);
    }
    return rows;
  }
  // A value that a column takes.
  static record::Cell cell(const record::Column& column, double value) {
    if (column.kind == record::ColumnKind::whole) return static_cast<long long>(value);
    if (column.kind == record::ColumnKind::real) return value;
    return "text of " + std::to_string(value);
  }
  // A database of the tasks 0, 1 and 2 that another program has changed.
  Store changed(const std::string& statement) const {
    if (!std::filesystem::exists(path("three.db"))) fill(path("three.db"), {0, 1, 2});
    std::filesystem::copy_file(path("three.db"), path("a.db"),
                               std::filesystem::copy_options::overwrite_existing);
    const Sqlite database(path("a.db"), OpenMode::write);
    database.execute("PRAGMA synchronous = OFF");
    database.execute(statement);
    return Store::open(path("a.db"));
  }
  static void fill(const std::string& file, std::initializer_list<long long> tasks) {
    auto store = Store::create_or_open(file, test::small());
    for (const auto task : tasks) store.write(std::vector{rows_of(task)});
  }
};

TEST_F(StoreTest, KeepsTasksOnceAndKnowsThemAgain) {
  fill(path("a.db"), {2, 0, 1, 2, 7});
  const auto store = Store::open(path("a.db"));
  EXPECT_EQ(store.finished().size(), 4);
  EXPECT_TRUE(store.finished().contains(7));
  EXPECT_EQ(read(*store.rows(TableName::subjects)).size(), 4u);
  EXPECT_EQ(read(*store.rows(TableName::runs)).size(), 8u);
  EXPECT_EQ(store.specification().text(), test::small().text());
}

TEST_F(StoreTest, RowsComeInOrderAndTimesOnRequest) {
  fill(path("a.db"), {3, 1});
  const auto store = Store::open(path("a.db"));
  const auto plain = store.rows(TableName::runs), timed = store.rows(TableName::runs, true);
  EXPECT_EQ(timed->columns().size(), plain->columns().size() + 1);
  EXPECT_EQ(timed->columns().back().name, "seconds");
  const auto rows = read(*timed);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i][0], record::Cell(i < 2 ? 1LL : 3LL));
    EXPECT_EQ(rows[i][1], record::Cell(i % 2 == 0 ? 1LL : 2LL));
    EXPECT_EQ(rows[i].back(), record::Cell(0.25));
  }
  EXPECT_EQ(read(*store.rows(TableName::subjects, true))[0].back(), record::Cell(0.5));
}

TEST_F(StoreTest, NumbersLeaveTextOut) {
  fill(path("a.db"), {0});
  const auto store = Store::open(path("a.db"));
  const auto source = store.numbers(TableName::runs);
  auto* const numbers = source->numbers();
  ASSERT_NE(numbers, nullptr);
  EXPECT_EQ(numbers->count(), 2);
  for (const auto& column : source->columns()) EXPECT_NE(column.name, "method");
  std::vector<double> values;
  ASSERT_TRUE(numbers->next_block(values));
  EXPECT_EQ(values.size(), 2 * source->columns().size());
  EXPECT_FALSE(numbers->next_block(values));
}

TEST_F(StoreTest, DatabaseIsOneFileAfterItsWriter) {
  fill(path("a.db"), {0});
  Store::open(path("a.db")).finished();
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path(""))) ++files;
  EXPECT_EQ(files, 1);
}

TEST_F(StoreTest, ShardsAreWrittenWithoutSharedMemory) {
  for (const auto& part : {shard_path(path("a.db"), {1, 2}), rank_path(path("a.db"), 7)}) {
    auto store = Store::create_or_open(part, test::small());
    store.write(std::vector{rows_of(1)});
    EXPECT_TRUE(std::filesystem::exists(part + "-wal"));
    EXPECT_FALSE(std::filesystem::exists(part + "-shm"));
  }
  fill(path("a.db"), {0});
  auto store = Store::create_or_open(path("a.db"), test::small());
  for (const auto& part : shard_files(path("a.db"))) store.merge(part);
  EXPECT_EQ(store.finished().size(), 2);
  for (const auto* name : {"runs.db", "a.rank-x", "rank-3", "a.shard-1-of-", "a.db.rank-3.db"})
    EXPECT_FALSE(is_shard_file(path(name))) << name;
}

TEST_F(StoreTest, SecondWriterIsRefusedWhileTheFirstLives) {
  {
    const auto first = Store::create_or_open(path("a.db"), test::small());
    EXPECT_REFUSED(Store::create_or_open(path("a.db"), test::small()), "database-busy", "a.db",
                   "another process");
    EXPECT_NO_THROW(Store::open(path("a.db")));  // readers are welcome
    auto other = Store::create_or_open(path("b.db"), test::small());
    EXPECT_REFUSED(other.merge(path("a.db")), "database-busy");
  }
  EXPECT_NO_THROW(Store::create_or_open(path("a.db"), test::small()));
}

TEST_F(StoreTest, RefusesWhatIsNoDatabaseOfThisCampaign) {
  const auto open = [&](const std::string& name) {
    return Store::create_or_open(path(name), test::small());
  };
  std::ofstream(path("text.db")) << "methods = [\"rk4\"] and some more text, as long as a header\n";
  EXPECT_REFUSED(open("text.db"), "not-a-campaign", "text.db");
  EXPECT_REFUSED(Store::open(path("text.db")), "not-a-campaign");

  Sqlite(path("other.db"), OpenMode::write).execute("CREATE TABLE t (x)");
  EXPECT_REFUSED(open("other.db"), "not-a-campaign", "none of a campaign");

  fill(path("new.db"), {0});
  Sqlite(path("new.db"), OpenMode::write).execute("PRAGMA user_version = 99");
  EXPECT_REFUSED(open("new.db"), "other-version", "version 99", "allowed: 2");
  EXPECT_REFUSED(Store::open(path("new.db")), "other-version");

  fill(path("old.db"), {0});
  const Sqlite old(path("old.db"), OpenMode::write);
  old.execute("UPDATE campaign SET value = '0.0.1' WHERE key = 'version'");
  seal(old);
  EXPECT_REFUSED(open("old.db"), "other-version", "clackers 0.0.1");
  EXPECT_NO_THROW(Store::open(path("old.db")));

  fill(path("a.db"), {0});
  const auto another = Specification::from_toml(test::small().text() + "# more\n", "spec.toml");
  EXPECT_REFUSED(Store::create_or_open(path("a.db"), another), "other-campaign", "a.db");
  auto store = Store::create_or_open(path("b.db"), another);
  EXPECT_REFUSED(store.merge(path("a.db")), "other-campaign");
  EXPECT_REFUSED(store.merge(path("none.db")), "cannot-read", "none.db");

  EXPECT_REFUSED(Store::open(path("none.db")), "cannot-read", "campaign run");
  EXPECT_REFUSED(Store::create_or_open(path("no/folder.db"), test::small()), "cannot-write");
}

TEST_F(StoreTest, HalfWrittenDatabaseIsRefused) {
  fill(path("a.db"), {0, 1, 2});
  std::filesystem::resize_file(path("a.db"), std::filesystem::file_size(path("a.db")) / 2);
  EXPECT_REFUSED(Store::create_or_open(path("a.db"), test::small()), "not-a-campaign", "damaged");
}

TEST_F(StoreTest, FileWithoutTablesIsANewDatabase) {
  std::ofstream(path("empty.db")).close();
  Sqlite(path("wal.db"), OpenMode::write).whole("PRAGMA journal_mode = WAL");
  for (const auto* name : {"empty.db", "wal.db"}) {
    fill(path(name), {5});
    EXPECT_EQ(Store::open(path(name)).finished().size(), 1);
  }
  std::ofstream(path("shard.db")).close();
  EXPECT_EQ(Store::create_or_open(path("empty.db"), test::small()).merge(path("shard.db")), 0);
}

TEST_F(StoreTest, QueriesOnlyRead) {
  fill(path("a.db"), {0, 1});
  const auto store = Store::open(path("a.db"));
  EXPECT_EQ(read(*store.query("SELECT count(*) FROM runs;"))[0][0], record::Cell(4LL));
  EXPECT_EQ(store.query("SELECT task AS number FROM runs")->columns()[0].name, "number");
  EXPECT_REFUSED(store.query("DELETE FROM runs"), "bad-syntax", "SELECT");
  EXPECT_REFUSED(store.query("SELEC 1"), "bad-syntax", "syntax error");
  EXPECT_REFUSED(store.query("SELECT 1; SELECT 2"), "bad-syntax", "one statement");
  for (const auto* nothing : {"", " ", ";", "-- SELECT 1", "/* SELECT 1 */;", "--\n;;"})
    EXPECT_REFUSED(store.query(nothing), "bad-syntax", "one statement");
  for (const auto* commented : {"SELECT 1; -- two", "-- one\nSELECT 1", ";/* */ SELECT 1 -- two"})
    EXPECT_EQ(read(*store.query(commented))[0][0], record::Cell(1LL)) << commented;
  for (const auto* silent :
       {"BEGIN", "SAVEPOINT a", "PRAGMA query_only=0", "PRAGMA writable_schema=1",
        "PRAGMA temp_store_directory='x'", "PRAGMA user_version=7"})
    EXPECT_REFUSED(store.query(silent), "bad-syntax", "that reads") << silent;
  EXPECT_REFUSED(store.query("ATTACH '" + path("x.db") + "' AS x"), "bad-syntax", "that reads");
  EXPECT_FALSE(read(*store.query("PRAGMA table_info('runs')")).empty());
  EXPECT_FALSE(std::filesystem::exists(path("x.db")));
}

constexpr auto endless =
    "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x+1 FROM c) SELECT count(*) FROM c";

TEST_F(StoreTest, InterruptEndsEndlessStatements) {
  fill(path("a.db"), {0});
  std::atomic<bool> interrupt{false};
  const auto store = Store::open(path("a.db"), &interrupt);
  const auto rows = store.query(endless);
  interrupt = true;
  EXPECT_REFUSED(read(*rows), "interrupted");
  fill(path("b.db"), {0, 1});
  auto other = Store::create_or_open(path("b.db"), test::small());
  fill(path("c.db"), {2});
  EXPECT_EQ(other.merge(path("c.db"), &interrupt), 1);  // too few rows to look
}

TEST_F(StoreTest, WaitingForAnotherProcessIsInterrupted) {
  fill(path("a.db"), {0});
  const Sqlite writer(path("a.db"), OpenMode::write);
  writer.execute("BEGIN EXCLUSIVE");
  const std::atomic<bool> interrupt{true};
  EXPECT_REFUSED(Store::open(path("a.db"), &interrupt), "interrupted");
}

TEST_F(StoreTest, NothingOfAStrangerIsRun) {
  const auto end = std::string(" AS ") + endless;
  auto store = Store::create_or_open(path("b.db"), test::small());
  for (const auto& added :
       {"CREATE VIEW v" + end, "DROP TABLE subjects; CREATE VIEW subjects" + end,
        "DROP TABLE campaign; CREATE VIEW campaign" + end,
        std::string("CREATE TRIGGER t AFTER INSERT ON runs BEGIN DELETE FROM runs; END"),
        std::string("CREATE VIRTUAL TABLE t USING fts5(x)"), std::string("CREATE TABLE t (x)"),
        std::string("CREATE INDEX i ON runs (task + 1)"), std::string("DROP TABLE timings"),
        std::string("ALTER TABLE runs ADD COLUMN more"),
        std::string("ALTER TABLE runs RENAME COLUMN u_error TO uu"),
        std::string("ALTER TABLE subjects ADD COLUMN more AS (1 + 1)")}) {
    EXPECT_REFUSED(changed(added), "not-a-campaign", "a.db") << added;
    EXPECT_REFUSED(Store::create_or_open(path("a.db"), test::small()), "not-a-campaign") << added;
    EXPECT_REFUSED(store.merge(path("a.db")), "not-a-campaign") << added;
  }
}

TEST_F(StoreTest, ChangedValuesAreNoticedByWhatReadsThem) {
  const auto damaged = [](const auto& call) {
    EXPECT_REFUSED(call(), "not-a-campaign", "damaged");
  };
  auto other = Store::create_or_open(path("b.db"), test::small());
  for (const auto* statement :
       {"UPDATE subjects SET verdict = NULL WHERE task = 1", "DELETE FROM subjects WHERE task = 0",
        "UPDATE subjects SET u_error = u_error * (1 + 1e-15) WHERE task = 2",
        "UPDATE subjects SET task = 7 WHERE task = 2", "UPDATE digests SET runs = 3 WHERE task = 1",
        "DELETE FROM digests WHERE task = 2", "INSERT INTO subjects (task) VALUES (3)"}) {
    const auto store = changed(statement);
    EXPECT_GE(store.counts().tasks, 2) << "counts compare nothing";
    damaged([&] { store.rows(TableName::subjects); });
    damaged([&] { store.numbers(TableName::runs); });
    damaged([&] { store.query("SELECT * FROM SUBJECTS"); });
    damaged([&] { other.merge(path("a.db")); });
  }
  for (const auto* statement :
       {"UPDATE runs SET u_error = NULL WHERE run = 2",
        "DELETE FROM runs WHERE task = 2 AND run = 1", "UPDATE runs SET run = 7 WHERE run = 2",
        "UPDATE runs SET task = 0, run = 3 WHERE task = 1 AND run = 2"}) {
    const auto store = changed(statement);
    damaged([&] { store.rows(TableName::runs); });
    damaged([&] { store.query("SELECT * FROM \"Runs\""); });
    EXPECT_EQ(store.counts().runs, 6);
    EXPECT_NO_THROW(store.rows(TableName::subjects));
  }
  const auto store = changed("UPDATE timings SET seconds = 0.5 WHERE task = 1 AND run = 1");
  damaged([&] { store.rows(TableName::runs, true); });
  EXPECT_NO_THROW(store.rows(TableName::runs));
  for (const auto* statement : {"UPDATE campaign SET value = 'x' WHERE key = 'file'",
                                "DELETE FROM campaign WHERE key = 'shard'"})
    damaged([&] { changed(statement); });
}

TEST_F(StoreTest, ValuesThatSqliteChangesAreWhole) {
  auto rows = rows_of(0);
  const auto columns = tables_of(test::small()).runs;
  for (std::size_t i = 2; i < columns.size(); ++i) {
    auto& cell = rows.runs[0][i - 2];
    if (columns[i].kind == record::ColumnKind::real) cell = i % 2 == 0 ? -0.0 : std::nan("");
    if (columns[i].kind == record::ColumnKind::whole) cell = (1LL << 53) + 1;
  }
  {
    auto store = Store::create_or_open(path("a.db"), test::small());
    store.write(std::vector{rows});
  }
  EXPECT_EQ(read(*Store::open(path("a.db")).rows(TableName::runs)).size(), 2u);
}

TEST_F(StoreTest, RanksLeftBehindAreAdopted) {
  fill(path("a.db"), {0});
  fill(rank_path(path("a.db"), 0), {1, 2});
  fill(rank_path(path("a.db"), 12), {2, 3});
  fill(shard_path(path("a.db"), {1, 2}), {4});
  EXPECT_EQ(shard_files(path("a.db")).size(), 3u);
  // Of a rank and a shard that were ended at their start, before they made their databases.
  const auto of_rank = rank_path(path("a.db"), 3) + ".lock";
  const auto of_shard = shard_path(path("a.db"), {2, 2}) + ".lock";
  for (const auto& lock : {of_rank, of_shard}) std::ofstream(lock).close();
  {
    auto store = Store::create_or_open(path("a.db"), test::small());
    EXPECT_EQ(adopt_ranks(store), 3);
  }
  EXPECT_EQ(Store::open(path("a.db")).finished().size(), 4);
  EXPECT_EQ(shard_files(path("a.db")), std::vector<std::string>{shard_path(path("a.db"), {1, 2})});
  EXPECT_FALSE(std::filesystem::exists(of_rank));
  EXPECT_TRUE(std::filesystem::exists(of_shard));
}

}  // namespace
}  // namespace clackers::campaign
