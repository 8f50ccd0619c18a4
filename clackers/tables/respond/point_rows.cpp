#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/bodies/bar_motion.hpp"
#include "clackers/tables/respond.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

constexpr long long most_times = 1'000'000;

std::vector<std::string_view> cases_with_elements() {
  std::vector<std::string_view> names;
  for (const auto& entry : cases::entries())
    if (std::ranges::count(entry.parameters, "elements", &Parameter::name) > 0)
      names.push_back(entry.name);
  return names;
}

const exact::BarMotion& bars_of(const cases::Case& test_case) {
  if (!test_case.bars)
    throw InputError(
        fmt::format(
            "respond: points are those of a bar or a string; {} has masses. Take a case with "
            "them: {}.",
            test_case.entry->name, fmt::join(cases_with_elements(), ", ")),
        "no-closed-form");
  return *test_case.bars;
}

struct Place {
  std::size_t bar = 0;
  double x = 0.0;  // from the contact end
};

Place place_of(const exact::BarMotion& bars, double x) {
  const auto list = bars.lengths();
  const double lowest = list.size() == 2 ? -list.front() : 0.0;
  require_within("respond", "x", x, lowest, list.back());
  return x < 0.0 ? Place{0, -x} : Place{list.size() - 1, x};
}

std::vector<record::Column> columns_at(const std::vector<double>& places, bool is_string) {
  std::vector<record::Column> columns{
      {"t", "s", "time", record::ColumnKind::real},
      {"side", "", "- and + are the limits before and after a jump", record::ColumnKind::side}};
  const auto add = [&](std::string name, const char* unit, std::string meaning) {
    columns.push_back({std::move(name), unit, std::move(meaning), record::ColumnKind::real});
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    add(fmt::format("u{}", i + 1), "m", fmt::format("displacement at x = {} m", places[i]));
    add(fmt::format("v{}", i + 1), "m/s", fmt::format("velocity at x = {} m", places[i]));
    if (is_string)
      add(fmt::format("transverse_force{}", i + 1), "N",
          fmt::format("T du/dx at x = {} m", places[i]));
    else
      add(fmt::format("stress{}", i + 1), "N/m^2", fmt::format("stress at x = {} m", places[i]));
  }
  add("force", "N", "of the contact");
  add("impulse", "N s", "of the contact so far");
  add("kinetic", "J",
      is_string ? "energy of the string" : "energy of the bars, and of a mass on one");
  add("elastic", "J", is_string ? "energy of the string" : "energy of the bars");
  add("potential", "J", "energy of the weight, 0 at the start");
  return columns;
}

class PointRows : public record::NumberRows {
 public:
  PointRows(const exact::BarMotion& bars, std::string name, const TimeGrid& grid,
            const std::vector<double>& places)
      : bars_(bars),
        name_(std::move(name)),
        grid_(grid),
        columns_(columns_at(places, bars.is_string())) {
    for (const double x : places) places_.push_back(place_of(bars, x));
  }

  std::string schema() const override { return "clackers/points/1"; }
  std::string title() const override {
    return fmt::format("Points of the {} of {}{}", bars_.is_string() ? "string" : "bars", name_,
                       grid_.size() == 0 ? ": no contact until the end of its run" : "");
  }
  const std::vector<record::Column>& columns() const override { return columns_; }
  long long count() const override {
    long long rows = grid_.size();
    for (long long k = 0; k < grid_.size(); ++k) {
      if (limits(grid_.at(k), model::Side::left) != limits(grid_.at(k), model::Side::right)) ++rows;
      if (k % 256 == 0) report(0, grid_.size());  // a caller may want to stop
    }
    return rows;
  }

  bool next_block(std::vector<double>& values) override {
    values.clear();
    if (done_ == grid_.size()) return false;
    const double t = grid_.at(done_++);
    const auto left = limits(t, model::Side::left), right = limits(t, model::Side::right);
    const auto energy = bars_.energy(t);
    const auto add = [&](double side, const std::vector<double>& row) {
      values.insert(values.end(), {t, side});
      values.insert(values.end(), row.begin(), row.end());
      values.insert(values.end(), {energy.kinetic.nearest(), energy.elastic.nearest(),
                                   energy.potential.nearest()});
    };
    if (left == right) {
      add(0.0, left);
    } else {
      add(-1.0, left);
      add(1.0, right);
    }
    report(done_, grid_.size());
    return true;
  }

 private:
  // What may jump, with the displacements between.
  std::vector<double> limits(double t, model::Side side) const {
    std::vector<double> row;
    for (const auto& place : places_) {
      const auto now = bars_.at(place.bar, place.x, t, side);
      row.insert(row.end(), {now.u.nearest(), now.v.nearest(), now.stress.nearest()});
    }
    row.push_back(bars_.force(t, side).nearest());
    row.push_back(bars_.impulse(t, side).nearest());
    return row;
  }

  const exact::BarMotion& bars_;
  std::string name_;
  TimeGrid grid_;
  std::vector<record::Column> columns_;
  std::vector<Place> places_;
  long long done_ = 0;
};

}  // namespace

TimeGrid contact_grid(const cases::Case& test_case) {
  TimeGrid grid;
  grid.times = bars_of(test_case).contact_changes(most_times + 1);
  return grid;
}

std::unique_ptr<record::RowSource> points(const cases::Case& test_case, const TimeGrid& grid,
                                          const std::vector<double>& places) {
  const auto& bars = bars_of(test_case);
  if (grid.size() > most_times)
    refuse("respond", "times", double(grid.size()), "at most 1e6 with --at", {}, "too-many-rows");
  require_inside(test_case, grid);
  return std::make_unique<PointRows>(bars, test_case.entry->name, grid, places);
}

}  // namespace clackers::tables
