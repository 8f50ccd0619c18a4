#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/study/respond/impact_finder.hpp"
#include "clackers/study/respond.hpp"
#include "clackers/study/respond/timed_rows.hpp"

namespace clackers::study {
namespace {

std::vector<Column> response_columns(int dof) {
  std::vector<Column> columns{{"t", "s", "time"},
                              {"side", "", "- and + are the limits before and after a collision"}};
  for (int i = 1; i <= dof; ++i) {
    columns.push_back({fmt::format("u{}", i), "m", fmt::format("displacement of mass {}", i)});
    columns.push_back({fmt::format("v{}", i), "m/s", fmt::format("velocity of mass {}", i)});
    columns.push_back({fmt::format("a{}", i), "m/s^2", fmt::format("acceleration of mass {}", i)});
  }
  return columns;
}

// States at consecutive times of the grid, evaluated together because that is much faster.
class ResponseRows : public RowSource {
 public:
  ResponseRows(const cases::Case& which, const TimeGrid& grid)
      : motion_(*which.motion),
        name_(which.entry->name),
        grid_(grid),
        finder_(motion_),
        dof_(static_cast<std::size_t>(motion_.dof())),
        columns_(response_columns(motion_.dof())) {}

  std::string schema() const override { return "clackers/response/1"; }
  std::string title() const override { return "Exact response of " + name_; }
  const std::vector<Column>& columns() const override { return columns_; }

  bool next(std::vector<Cell>& row) override {
    if (right_limit_is_due_) {
      right_limit_is_due_ = false;
      const double t = times_[here_ - 1];
      right_ = motion_.at(t, model::Side::right);
      write(row, t, "+", right_.u.data(), right_.v.data(), right_.a.data());
      return true;
    }
    if (here_ == times_.size() && !fill()) return false;
    const auto i = here_++;
    const bool jump = finder_.is_impact(times_[i]);
    right_limit_is_due_ = jump;
    write(row, times_[i], jump ? "-" : "", &u_[i * dof_], &v_[i * dof_], &a_[i * dof_]);
    return true;
  }

 private:
  static constexpr long long block = 512;

  // The next times and their left limits; false when there are none.
  bool fill() {
    const auto size = static_cast<std::size_t>(std::min(block, grid_.size() - done_));
    times_.resize(size);
    for (auto& t : times_) t = grid_.at(done_++);
    for (auto* values : {&u_, &v_, &a_}) values->resize(size * dof_);
    if (size > 0) motion_.sample(times_, model::Side::left, {u_, v_, a_});
    here_ = 0;
    return size > 0;
  }

  void write(std::vector<Cell>& row, double t, const char* side, const double* u, const double* v,
             const double* a) const {
    row.clear();
    row.emplace_back(t);
    row.push_back(*side == '\0' ? Cell{} : Cell{std::string(side)});
    for (std::size_t i = 0; i < dof_; ++i)
      for (const double value : {u[i], v[i], a[i]}) row.emplace_back(value);
  }

  const model::Motion& motion_;
  std::string name_;
  TimeGrid grid_;
  ImpactFinder finder_;
  std::size_t dof_;
  std::vector<Column> columns_;
  std::vector<double> times_, u_, v_, a_;
  std::size_t here_ = 0;
  long long done_ = 0;
  bool right_limit_is_due_ = false;
  model::Kinematics right_;
};

}  // namespace

std::unique_ptr<RowSource> respond(const cases::Case& which, const TimeGrid& grid) {
  require_inside(which, grid);
  return std::make_unique<ResponseRows>(which, grid);
}

Curve response_curve(const cases::Case& which, int n) {
  const auto grid = grid_of(n, which.motion->end());
  const auto dof = static_cast<std::size_t>(which.motion->dof());
  Curve curve;
  for (long long k = 0; k < grid.size(); ++k) curve.t.push_back(grid.at(k));
  std::vector<double> u(curve.t.size() * dof), v(u.size());
  which.motion->sample(curve.t, model::Side::left, {u, v, {}});
  curve.y.assign(dof, std::vector<double>(curve.t.size()));
  for (std::size_t k = 0; k < curve.t.size(); ++k)
    for (std::size_t i = 0; i < dof; ++i) curve.y[i][k] = u[k * dof + i];
  return curve;
}

}  // namespace clackers::study
