#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/tables/case_summary.hpp"
#include "clackers/tables/respond.hpp"
#include "clackers/tables/respond/timed_rows.hpp"

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

std::unique_ptr<record::RowSource> forces(const cases::Case& test_case, const TimeGrid& grid) {
  const auto& problem = test_case.problem;
  const auto* springs = model::one_sided_springs(problem);
  const auto contacts = std::ssize(problem.contacts), frictions = std::ssize(problem.frictions),
             compliant = springs != nullptr ? std::ssize(springs->contacts()) : 0;
  if (contacts + compliant + frictions == 0)
    throw InputError(
        fmt::format(
            "respond: forces are those of contacts, one-sided springs and dry friction; {} "
            "has none of them{}.",
            test_case.entry->name,
            problem.has_unstated_impacts() ? " but impacts, whose impulses --impacts has" : ""),
        "no-closed-form");
  require_inside(test_case, grid);
  std::vector<record::Column> columns;
  for (int i = 1; i <= contacts + compliant; ++i)
    columns.push_back(
        {fmt::format("force{}", i), "N",
         i <= contacts ? fmt::format("of contact {} while it stays closed, along its direction", i)
                       : fmt::format("of one-sided spring {} in compression, along its direction",
                                     i - contacts)});
  for (int i = 1; i <= frictions; ++i)
    columns.push_back({fmt::format("friction{}", i), "N", "of dry friction, along its direction"});
  const auto& motion = *test_case.motion;
  return std::make_unique<TimedRows>(
      motion, grid, "clackers/forces/1", "Contact forces of " + test_case.entry->name, columns, 64,
      one_by_one([&motion, springs, contacts, frictions](double t, model::Side side, double* row) {
        const auto now = motion.contact_forces(t, side);
        const auto add = [&](Eigen::Index first, Eigen::Index count) {
          for (Eigen::Index i = first; i < first + count; ++i)
            *row++ = now.size() > 0 ? now[i] : 0.0;
        };
        add(0, contacts);
        if (springs != nullptr) {
          const auto u = motion.at(t, side).u;
          for (std::size_t j = 0; j < springs->contacts().size(); ++j)
            *row++ = std::max(0.0, -springs->stiffnesses()[j] * springs->contacts()[j].gap_at(u));
        }
        add(contacts, frictions);
      }));
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
