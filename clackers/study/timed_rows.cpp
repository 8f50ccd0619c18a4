#include "clackers/study/timed_rows.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"

namespace clackers::study {

const exact::ClosedForm& closed_form(const cases::Case& which, std::string_view wanted) {
  const auto* motion = exact::as_closed_form(*which.motion);
  if (motion == nullptr)
    throw InputError(fmt::format("respond: {} is known for motions in closed form; {} is none.",
                                 wanted, which.entry->name),
                     "no-closed-form");
  return *motion;
}

void require_inside(const cases::Case& which, const TimeGrid& grid) {
  const double end = which.motion->end();
  const auto require = [&](double t) {
    if (!(t >= 0.0 && t <= end))
      refuse("respond", "t", t,
             fmt::format("0 <= t <= {} s, the run of {}", end, which.entry->name),
             "A longer run is another value of t_end or a_t.", "time-outside");
  };
  for (const double t : grid.times) require(t);
  if (grid.size() > 0) require(grid.at(grid.size() - 1));
}

TimedRows::TimedRows(const model::Motion& motion, const TimeGrid& grid, std::string schema,
                     std::string title, const std::vector<Column>& columns, Values values)
    : grid_(grid),
      finder_(motion),
      schema_(std::move(schema)),
      title_(std::move(title)),
      columns_{{"t", "s", "time"},
               {"side", "", "- and + are the limits before and after a collision"}},
      values_(std::move(values)) {
  columns_.insert(columns_.end(), columns.begin(), columns.end());
}

bool TimedRows::next(std::vector<Cell>& row) {
  if (right_limit_is_due_) {
    right_limit_is_due_ = false;
    write(row, "+", model::Side::right);
    return true;
  }
  if (done_ == grid_.size()) return false;
  t_ = grid_.at(done_++);
  right_limit_is_due_ = finder_.is_impact(t_);
  write(row, right_limit_is_due_ ? "-" : "", model::Side::left);
  return true;
}

void TimedRows::write(std::vector<Cell>& row, const char* sign, model::Side side) const {
  row.clear();
  row.emplace_back(t_);
  row.push_back(*sign == '\0' ? Cell{} : Cell{std::string(sign)});
  values_(t_, side, row);
}

}  // namespace clackers::study
