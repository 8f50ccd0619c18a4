#include <fmt/format.h>

#include "clackers/study/respond.hpp"

namespace clackers::study {
namespace {

std::vector<Column> collision_columns(int dof) {
  std::vector<Column> columns{{"k", "", "number of the collision"},
                              {"t", "s", "its time, the nearest double"},
                              {"u1", "m", "displacement of mass 1"}};
  for (int i = 1; i <= dof; ++i) {
    columns.push_back(
        {fmt::format("v{}-", i), "m/s", fmt::format("velocity of mass {} just before", i)});
    columns.push_back(
        {fmt::format("v{}+", i), "m/s", fmt::format("velocity of mass {} just after", i)});
  }
  columns.push_back({"impulse", "N s", "of the contact"});
  columns.push_back({"energy_before", "J", "of the whole structure"});
  columns.push_back({"energy_after", "J", "of the whole structure"});
  return columns;
}

class CollisionRows : public RowSource {
 public:
  explicit CollisionRows(const cases::Case& which)
      : motion_(*which.motion),
        name_(which.entry->name),
        total_(motion_.impact_count(motion_.end())),
        columns_(collision_columns(motion_.dof())) {}

  std::string schema() const override { return "clackers/collisions/1"; }
  std::string title() const override {
    if (total_ > 0) return "Collisions of " + name_;
    return fmt::format("Collisions of {}: none until the end of its run, {} s", name_,
                       motion_.end());
  }
  const std::vector<Column>& columns() const override { return columns_; }

  bool next(std::vector<Cell>& row) override {
    if (done_ == total_) return false;
    const auto now = motion_.impact(++done_);
    row.assign({Cell{now.index}, Cell{now.t}, Cell{now.before.u[0]}});
    for (Eigen::Index i = 0; i < motion_.dof(); ++i) {
      row.emplace_back(now.before.v[i]);
      row.emplace_back(now.after.v[i]);
    }
    for (const double value : {now.impulse, now.energy_before, now.energy_after})
      row.emplace_back(value);
    return true;
  }

 private:
  const model::Motion& motion_;
  std::string name_;
  long long total_, done_ = 0;
  std::vector<Column> columns_;
};

}  // namespace

std::unique_ptr<RowSource> collisions(const cases::Case& which) {
  return std::make_unique<CollisionRows>(which);
}

}  // namespace clackers::study
