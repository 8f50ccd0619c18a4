#include "clackers/tables/times/timed_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::tables {

ImpactFinder::ImpactFinder(const model::Motion& motion)
    : motion_(motion),
      total_(motion.impact_count(motion.end())),
      before_(-std::numeric_limits<double>::infinity()),
      after_(time_of(1)) {}

double ImpactFinder::time_of(long long index) const {
  if (index < 1) return -std::numeric_limits<double>::infinity();
  if (index > total_) return std::numeric_limits<double>::infinity();
  return motion_.impact(index).t;
}

bool ImpactFinder::is_impact(double t) {
  if (before_ < t && t < after_) return false;
  // The nearest double may lie on either side of the true instant, so that the count at t may or
  // may not hold an impact rounded to t: both neighbours are looked at.
  const auto count = motion_.impact_count(t);
  before_ = time_of(count);
  after_ = time_of(count + 1);
  return t == before_ || t == after_;
}

const exact::ClosedForm& closed_form(const cases::Case& test_case, std::string_view wanted) {
  const auto* motion = exact::as_closed_form(*test_case.motion);
  if (motion == nullptr)
    throw InputError(fmt::format("respond: {} is known for motions in closed form; {} is none.",
                                 wanted, test_case.entry->name),
                     "no-closed-form");
  return *motion;
}

void require_inside(const cases::Case& test_case, const TimeGrid& grid) {
  const double end = test_case.motion->end();
  const auto require = [&](double t) {
    if (!(t >= 0.0 && t <= end))
      refuse("respond", "t", t,
             fmt::format("0 <= t <= {} s, the run of {}", end, test_case.entry->name),
             "A longer run is another value of t_end or a_t.", "time-outside");
  };
  for (const double t : grid.times) require(t);
  if (grid.size() > 0) require(grid.at(grid.size() - 1));
}

TimedRows::TimedRows(const model::Motion& motion, const TimeGrid& grid, std::string schema,
                     std::string title, const std::vector<record::Column>& columns,
                     std::size_t block, Fill fill)
    : motion_(motion),
      grid_(grid),
      finder_(motion),
      schema_(std::move(schema)),
      title_(std::move(title)),
      columns_{{"t", "s", "time", record::ColumnKind::real},
               {"side", "", "- and + are the limits before and after an impact",
                record::ColumnKind::side}},
      block_(block),
      fill_(std::move(fill)) {
  for (auto column : columns) {
    column.kind = record::ColumnKind::real;
    columns_.push_back(std::move(column));
  }
}

long long TimedRows::count() const {
  ImpactFinder finder(motion_);
  long long rows = grid_.size();
  for (long long k = 0; k < grid_.size(); ++k) {
    if (finder.is_impact(grid_.at(k))) ++rows;
    if (k % 65536 == 0) report(0, grid_.size());  // a caller may want to stop
  }
  return rows;
}

bool TimedRows::next_block(std::vector<double>& values) {
  const auto left = static_cast<std::size_t>(grid_.size() - done_);
  times_.resize(std::min(block_, left));
  impacts_.clear();
  for (std::size_t k = 0; k < times_.size(); ++k) {
    times_[k] = grid_.at(done_++);
    if (finder_.is_impact(times_[k])) impacts_.push_back(k);
  }
  const auto width = columns_.size();
  values.resize((times_.size() + impacts_.size()) * width);
  if (values.empty()) return false;
  report(done_, grid_.size());
  fill_(times_, model::Side::left, values.data() + 2, width);
  for (std::size_t k = 0; k < times_.size(); ++k) {
    values[k * width] = times_[k];
    values[k * width + 1] = 0.0;
  }
  // Rows move apart, the last first, to make place for the right limits.
  auto end = values.end();
  auto rows = times_.size();
  for (auto number = impacts_.size(); number-- > 0;) {
    const auto place = impacts_[number];
    const auto from = values.begin() + std::ptrdiff_t((place + 1) * width);
    end = std::move_backward(from, values.begin() + std::ptrdiff_t(rows * width), end);
    rows = place + 1;
    end -= std::ptrdiff_t(width);
    const double t = times_[place];
    fill_({&t, 1}, model::Side::right, &*end + 2, width);
    end[0] = t;
    end[1] = 1.0;
    *(from - std::ptrdiff_t(width) + 1) = -1.0;
  }
  return true;
}

}  // namespace clackers::tables
