#include <fmt/format.h>

#include <algorithm>

#include "clackers/tables/respond.hpp"

namespace clackers::tables {
namespace {

// Two masses that touch in their only contact have one place.
bool has_one_place(const cases::Case& test_case) {
  const auto& problem = test_case.problem;
  return test_case.motion->dof() <= 2 && problem.contacts.size() <= 1 &&
         !problem.has_unstated_impacts();
}

std::vector<record::Column> impact_columns(const cases::Case& test_case) {
  std::vector<record::Column> columns{{"k", "", "number of the impact"},
                                      {"t", "s", "its time, the nearest double"}};
  const bool names_contact = test_case.problem.contacts.size() > 1;
  if (names_contact) columns.push_back({"contact", "", "number of the contact, from 0"});
  for (int i = 1; i <= test_case.motion->dof(); ++i) {
    if (i == 1 || !has_one_place(test_case))
      columns.push_back({fmt::format("u{}", i), "m", fmt::format("displacement of mass {}", i)});
    columns.push_back(
        {fmt::format("v{}-", i), "m/s", fmt::format("velocity of mass {} just before", i)});
    columns.push_back(
        {fmt::format("v{}+", i), "m/s", fmt::format("velocity of mass {} just after", i)});
  }
  columns.push_back({"impulse", "N s", "of the contact"});
  columns.push_back({"energy_before", "J", "kinetic and elastic, of all masses and springs"});
  columns.push_back({"energy_after", "J", "kinetic and elastic, of all masses and springs"});
  for (auto& column : columns) column.kind = record::ColumnKind::real;
  columns.front().kind = record::ColumnKind::whole;
  if (names_contact) columns[2].kind = record::ColumnKind::whole;
  return columns;
}

class ImpactRows : public record::NumberRows {
 public:
  explicit ImpactRows(const cases::Case& test_case)
      : motion_(*test_case.motion),
        name_((test_case.bars ? "the mesh of " : "") + test_case.entry->name),
        total_(motion_.impact_count(motion_.end())),
        columns_(impact_columns(test_case)),
        names_contact_(test_case.problem.contacts.size() > 1),
        has_one_place_(has_one_place(test_case)),
        has_bars_(test_case.bars != nullptr) {}

  std::string schema() const override { return "clackers/impacts/1"; }
  std::string title() const override {
    const auto note = names_contact_ ? impact_contacts_note : "";
    const auto more = has_bars_ ? "; contacts of the continuum: --at 0 --impacts" : "";
    if (accumulates(motion_))
      return fmt::format("Impacts of {}: infinitely many; those that are resolved{}", name_, note);
    if (total_ > 0) return fmt::format("Impacts of {}{}{}", name_, note, more);
    return fmt::format("Impacts of {}: none until the end of its run at {} s{}", name_,
                       motion_.end(), more);
  }
  const std::vector<record::Column>& columns() const override { return columns_; }

  long long count() const override { return total_; }

  bool next_block(std::vector<double>& values) override {
    constexpr long long block = 64;
    values.clear();
    for (const auto end = std::min(done_ + block, total_); done_ < end; ++done_) {
      const auto now = motion_.impact(done_ + 1);
      values.insert(values.end(), {double(now.index), now.t});
      if (names_contact_) values.push_back(double(now.contact));
      for (Eigen::Index i = 0; i < motion_.dof(); ++i) {
        if (i == 0 || !has_one_place_) values.push_back(now.before.u[i]);
        values.insert(values.end(), {now.before.v[i], now.after.v[i]});
      }
      values.insert(values.end(), {now.impulse, now.energy_before, now.energy_after});
    }
    if (!values.empty()) report(done_, total_);
    return !values.empty();
  }

 private:
  const model::Motion& motion_;
  std::string name_;
  long long total_, done_ = 0;
  std::vector<record::Column> columns_;
  bool names_contact_, has_one_place_, has_bars_;
};

}  // namespace

bool accumulates(const model::Motion& motion) {
  return std::ranges::any_of(motion.closed_contacts(), &model::ClosedContact::accumulates);
}

std::unique_ptr<record::RowSource> impacts(const cases::Case& test_case) {
  return std::make_unique<ImpactRows>(test_case);
}

}  // namespace clackers::tables
