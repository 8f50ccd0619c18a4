#include <fmt/format.h>

#include "clackers/tables/case_summary.hpp"
#include "clackers/tables/respond.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

constexpr std::size_t block = 2048;  // states sampled together, which is much faster than singly

std::vector<record::Column> response_columns(int dof) {
  std::vector<record::Column> columns;
  for (int i = 1; i <= dof; ++i) {
    columns.push_back({fmt::format("u{}", i), "m", fmt::format("displacement of mass {}", i)});
    columns.push_back({fmt::format("v{}", i), "m/s", fmt::format("velocity of mass {}", i)});
    columns.push_back({fmt::format("a{}", i), "m/s^2", fmt::format("acceleration of mass {}", i)});
  }
  return columns;
}

// Samples a motion and lays u, v and a of each mass next to each other.
struct States {
  const model::Motion& motion;
  std::vector<double> u, v, a;

  void operator()(std::span<const double> times, model::Side side, double* row,
                  std::size_t stride) {
    const auto dof = std::size_t(motion.dof());
    for (auto* values : {&u, &v, &a}) values->resize(times.size() * dof);
    motion.sample(times, side, {u, v, a});
    for (std::size_t k = 0; k < times.size(); ++k, row += stride)
      for (std::size_t i = 0; i < dof; ++i) {
        row[3 * i] = u[k * dof + i];
        row[3 * i + 1] = v[k * dof + i];
        row[3 * i + 2] = a[k * dof + i];
      }
  }
};

}  // namespace

std::unique_ptr<record::RowSource> respond(const cases::Case& test_case, const TimeGrid& grid) {
  require_inside(test_case, grid);
  const auto& motion = *test_case.motion;
  return std::make_unique<TimedRows>(
      motion, grid, "clackers/response/1", "Exact response of " + test_case.entry->name,
      response_columns(motion.dof()), block, States{motion, {}, {}, {}});
}

record::CaseRecord response_record(const cases::Case& test_case) {
  record::CaseRecord record;
  record.problem = summary_of(test_case);
  record.plan = {0.0, 0, 0};
  record.response = response_curve(test_case, response_points);
  return record;
}

record::Curve response_curve(const cases::Case& test_case, int n) {
  const auto grid = grid_of(n, test_case.motion->end());
  const auto dof = static_cast<std::size_t>(test_case.motion->dof());
  record::Curve curve;
  for (long long k = 0; k < grid.size(); ++k) curve.t.push_back(grid.at(k));
  std::vector<double> u(curve.t.size() * dof), v(u.size());
  test_case.motion->sample(curve.t, model::Side::left, {u, v, {}});
  curve.y.assign(dof, std::vector<double>(curve.t.size()));
  for (std::size_t k = 0; k < curve.t.size(); ++k)
    for (std::size_t i = 0; i < dof; ++i) curve.y[i][k] = u[k * dof + i];
  return curve;
}

}  // namespace clackers::tables
