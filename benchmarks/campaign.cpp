#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "benchmarks/measure.hpp"
#include "clackers/campaign/run.hpp"

// What a campaign costs beside its runs, and what a second thread gains: clackers_benchmark_campaign.
namespace clackers::benchmarks {
namespace {

// Runs of a millisecond: a step with its errors takes some 50 ns.
constexpr std::string_view specification_text = R"(methods = ["newmark", "rk4", "moreau-jean"]
[ladder]
levels = 3
coarsest = 3.6e-3
samples_per_level = 8
[[cases]]
case = "three-parameter"
set = { xi1 = { from = 0.01, to = 0.1, points = 40 } }
)";

struct Cost {
  double wall = 0.0, processor = 0.0;  // [s]
  double runs_seconds = 0.0;           // of them the runs alone
  long long runs = 0;
};

double sum_of_timings(const std::string& database) {
  const auto store = campaign::Store::open(database);
  std::vector<record::Cell> row;
  store.query("SELECT sum(seconds) FROM timings")->next(row);
  return std::get<double>(row.front());
}

Cost cost_of(const campaign::Specification& specification, const std::string& database, int jobs) {
  using Clock = std::chrono::steady_clock;
  Cost cost;
  const auto start = Clock::now();
  const double begin = processor_time();
  {
    auto store = campaign::Store::create_or_open(database, specification);
    campaign::LocalTasks source(specification.tasks(), store.finished(),
                                campaign::block_size(specification, jobs));
    cost.runs = campaign::run_campaign(specification, store, source, {.jobs = jobs}).runs;
  }
  cost.processor = (processor_time() - begin) * 1e-9;
  cost.wall = std::chrono::duration<double>(Clock::now() - start).count();
  cost.runs_seconds = sum_of_timings(database);
  std::filesystem::remove(database);
  return cost;
}

void print(int jobs, const Cost& cost) {
  const double beside = cost.processor - cost.runs_seconds;
  fmt::print("{:7} {:8} {:8.2f} {:9.2f} {:9.3f} {:10.3f} {:7.2f} %\n", jobs, cost.runs, cost.wall,
             cost.processor, 1e3 * cost.runs_seconds / double(cost.runs), 1e3 * beside,
             100.0 * beside / cost.runs_seconds);
}

void race() {
  const auto specification = campaign::Specification::from_toml(specification_text, "campaign");
  const auto database = (std::filesystem::temp_directory_path() / "clackers-bench.db").string();
  std::filesystem::remove(database);
  constexpr int turns = 3;
  std::vector<double> walls[2], beside;
  fmt::print("threads     runs     wall processor   ms a run  beside [ms]  beside\n");
  for (int turn = 0; turn < turns; ++turn)
    for (const int jobs : {1, 2}) {
      const auto cost = cost_of(specification, database, jobs);
      print(jobs, cost);
      walls[jobs - 1].push_back(cost.wall);
      beside.push_back(100.0 * (cost.processor / cost.runs_seconds - 1.0));
    }
  const double share = median(beside), gain = median(walls[0]) / (2.0 * median(walls[1]));
  fmt::print("planning, scheduling and storing  {:.2f} %  <= 2 %   {}\n", share,
             share <= 2.0 ? "reached" : "missed");
  fmt::print("two threads against one           {:.3f}   >= 0.95  {}\n", gain,
             gain >= 0.95 ? "reached" : "missed");
}

}  // namespace
}  // namespace clackers::benchmarks

int main() {
  clackers::benchmarks::race();
  return 0;
}
