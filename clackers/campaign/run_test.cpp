#include "clackers/campaign/run.hpp"

#include <gtest/gtest.h>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/campaign/testing/database_fixture.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::campaign {
namespace {

using test::DatabaseTest;

// Ends after some blocks, as a process that is interrupted there.
class FirstBlocks : public TaskSource {
 public:
  FirstBlocks(TaskSource& source, int blocks) : source_(source), left_(blocks) {}
  std::optional<TaskBlock> next() override {
    return left_-- > 0 ? source_.next() : std::optional<TaskBlock>();
  }
  long long remaining() const override { return source_.remaining(); }

 private:
  TaskSource& source_;
  std::atomic<int> left_;
};

class Campaign : public DatabaseTest {
 protected:
  RunSummary run(const std::string& name, int jobs, long long block, Shard shard = {},
                 int blocks = 1000) {
    const auto spec = test::small();
    auto store = Store::create_or_open(path(name), spec);
    LocalTasks all(spec.tasks(), store.finished(), block, shard);
    FirstBlocks source(all, blocks);
    return run_campaign(spec, store, source, {.jobs = jobs});
  }
};

TEST_F(Campaign, RowsDoNotDependOnJobsOrderOrInterruptions) {
  run("one.db", 1, 3);
  const auto expected = rows("one.db");
  ASSERT_EQ(expected.size(), 2u);
  EXPECT_EQ(expected[0].size(), std::size_t(test::small().tasks()));
  run("four.db", 4, 1);
  EXPECT_EQ(rows("four.db"), expected);
  for (int i = 0; i < 20; ++i) run("resumed.db", 2, 2, {}, 1);
  EXPECT_EQ(rows("resumed.db"), expected);
}

TEST_F(Campaign, MergedShardsAreTheWhole) {
  run("one.db", 1, 3);
  for (long long i = 1; i <= 3; ++i) run("part" + std::to_string(i), 1, 2, {i, 3});
  {
    auto store = Store::create_or_open(path("merged.db"), test::small());
    long long added = 0;
    for (const auto* part : {"part3", "part1", "part2", "part1"}) added += store.merge(path(part));
    EXPECT_EQ(added, test::small().tasks());
  }
  EXPECT_EQ(rows("merged.db"), rows("one.db"));
}

TEST_F(Campaign, FinishedTasksAreNotRunAgain) {
  EXPECT_EQ(run("a.db", 2, 2).tasks, test::small().tasks());
  const auto again = run("a.db", 2, 2);
  EXPECT_EQ(again.tasks, 0);
  EXPECT_EQ(again.runs, 0);
}

TEST_F(Campaign, InterruptStoresWhatIsFinished) {
  const auto spec = test::small();
  std::atomic<bool> interrupt{true};
  RunSummary summary;
  {
    auto store = Store::create_or_open(path("a.db"), spec);
    LocalTasks source(spec.tasks(), {}, 1);
    summary = run_campaign(spec, store, source, {.jobs = 2}, &interrupt);
  }
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(std::size_t(summary.tasks), rows("a.db")[0].size());
}

TEST_F(Campaign, TaskIsWhatVerifyMakes) {
  const auto spec = Specification::from_toml(
      "methods = [\"rk4\", \"newmark\"]\nmetrics = true\n[ladder]\nlevels = 4\nsamples_per_level = "
      "2\n"
      "[[cases]]\ncase = \"stop\"\nset = { eta = [0.5, 1] }",
      "spec.toml");
  study::VerifyRequest request;
  request.methods = {"newmark"};
  request.cases = {"stop"};
  request.settings = {{"eta", 1.0}};
  request.plan = {{}, 4, 2};
  const auto record = study::verify(request);
  const auto sheet = report::run_sheet(record.cases);

  const auto solvers = solvers_of(spec);
  const auto task = TaskRunner(spec, solvers).run(3);
  ASSERT_TRUE(task);
  const auto columns = tables_of(spec).runs;
  ASSERT_EQ(task->runs.size(), sheet.rows.size());
  int compared = 0;
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    ASSERT_EQ(task->runs[r].size() + 2, columns.size());
    for (std::size_t c = 2; c < columns.size(); ++c)
      for (std::size_t s = 0; s < sheet.columns.size(); ++s)
        if (sheet.columns[s].name == columns[c].name) {
          EXPECT_EQ(task->runs[r][c - 2], sheet.rows[r][s]) << columns[c].name;
          ++compared;
        }
  }
  EXPECT_GT(compared, 200);
}

TEST_F(Campaign, RefusedSystemsAndMethodsAreFinishedTasks) {
  // X is odd; at eta = 0.5 a linear penalty spring is refused.
  const auto spec = Specification::from_toml(
      "methods = [\"newmark+penalty\"]\n[ladder]\nlevels = 1\nsamples_per_level = "
      "1\n[[cases]]\ncase = "
      "\"synchronized-pair\"\nset = { X = [8, 9], eta = 0.5 }",
      "spec.toml");
  const auto solvers = solvers_of(spec);
  TaskRunner runner(spec, solvers);
  const auto columns = tables_of(spec).subjects;
  const auto value = [&](const TaskRows& rows, std::string_view name) {
    for (std::size_t i = 1; i < columns.size(); ++i)
      if (columns[i].name == name) return rows.subject[i - 1];
    return record::Cell();
  };
  for (const long long task : {0, 1}) {
    const auto rows = runner.run(task);
    ASSERT_TRUE(rows);
    EXPECT_TRUE(rows->runs.empty());
    EXPECT_EQ(value(*rows, "verdict"), record::Cell("refused"));
    EXPECT_EQ(value(*rows, "method"), record::Cell("newmark+penalty"));
    EXPECT_EQ(value(*rows, "case"), record::Cell("synchronized-pair"));
    EXPECT_EQ(value(*rows, "set_X"), record::Cell(task == 0 ? 8.0 : 9.0));
  }
  EXPECT_EQ(value(*runner.run(1), "refusal_code"), record::Cell("penalty-needs-elastic"));
}

TEST_F(Campaign, PlanCountsWhatIsRun) {
  const auto plan = plan_of(test::small(), true);
  EXPECT_EQ(plan.tasks, test::small().tasks());
  EXPECT_EQ(plan.runs, double(run("a.db", 1, 1).runs));
  EXPECT_GT(plan.seconds, 0.0);
}

TEST(CampaignPlan, TooManyRunsAreRefusedWithTheirEstimate) {
  const auto spec = Specification::from_toml(
      "methods = [\"newmark\"]\n[ladder]\nlevels = 2\nsamples_per_level = 1\n[[cases]]\ncase = "
      "\"three-parameter\"\nset = { xi1 = { from = 0, to = 0.1, points = 1e6 }, a_t = { from = 1, to "
      "= 2, points = 500000 } }",
      "spec.toml");
  EXPECT_REFUSED(require_few_runs(spec), "too-many-runs", "1e+12 runs", "hours", "GB", "--yes");
  EXPECT_NO_THROW(require_few_runs(test::small()));
}

}  // namespace
}  // namespace clackers::campaign
