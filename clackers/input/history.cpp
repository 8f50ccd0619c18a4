#include "clackers/input/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/input/history_columns.hpp"
#include "clackers/input/table.hpp"
#include "clackers/input/text/printed_digits.hpp"
#include "clackers/numerics/time_steps.hpp"

namespace clackers::input {
namespace {

// One column of a source and the vector its numbers go to.
struct Target {
  std::size_t column;
  std::size_t mass;
  std::vector<double>* into;
  PrintedDigits digits{};
};

std::string_view shown(RowSide side) {
  return side == RowSide::none ? "nothing" : side == RowSide::before ? "-" : "+";
}

class Reader {
 public:
  Reader(Table& table, const HistoryOptions& options)
      : options_(options),
        table_(table),
        columns_(history_columns(table.name(), table.names(), options, history_.notes)) {
    history_.names = table_.names();
    history_.motion.dof = options.dof;
    history_.has_time = columns_.t.has_value();
    auto& motion = history_.motion;
    for (std::size_t j = 0; j < std::size_t(options.dof); ++j) {
      history_.has_u.push_back(columns_.u[j].has_value());
      if (columns_.u[j]) targets_.push_back({*columns_.u[j], j, &motion.u});
      if (columns_.has_v()) targets_.push_back({*columns_.v[j], j, &motion.v});
      if (columns_.has_a()) targets_.push_back({*columns_.a[j], j, &motion.a});
    }
  }

  History run() {
    while (table_.next()) {
      if (rows_ % rows_a_report == 0) report();
      if (!take()) break;
    }
    for (auto& note : table_.notes()) history_.notes.push_back(std::move(note));
    history_.cost = table_.cost();
    finish();
    return std::move(history_);
  }

 private:
  // False for a row that is not finite and ends the history.
  bool take() {
    if (!reserved_) reserve();
    const auto rows = rows_;
    try {
      take_time();
      take_row();
      return true;
    } catch (const InputError& error) {
      auto& motion = history_.motion;
      const bool enough = rows > 1 && motion.t[rows - 1] > motion.t.front();
      if (!options_.until_not_finite || !enough || error.code() != Code("not-finite")) throw;
      history_.not_finite = error.what();
      rows_ = rows;
      motion.t.resize(rows);
      return false;
    }
  }

  static constexpr std::size_t rows_a_report = 65536;

  void report() const {
    const double share = table_.share();
    if (options_.progress && share > 0.0) options_.progress(std::min(1.0, share));
  }

  void take_time() {
    auto& times = history_.motion.t;
    double t = options_.step * double(rows_);
    if (columns_.t) {
      Number number;
      table_.read_number(*columns_.t, number);
      time_digits_.take(number);
      t = number.value;
    }
    if (!times.empty()) {
      const double last = times.back();
      if (t < last)
        refuse(table_.place(), "t", t, fmt::format("at least {} s, the time above it", last + 0.0),
               "Sort the rows by time; of a run that was restarted keep one part.", "not-sorted");
      const bool twice = times.size() > 1 && times[times.size() - 2] == last;
      if (t == last && twice)
        refuse(table_.place(), "t", t, "at most two rows of one time, the limits of a jump",
               "Print times with more digits if they are not the same.", "not-sorted");
      if (t == last) require_sides();
    }
    if (columns_.side) last_side_ = table_.side(*columns_.side);
    times.push_back(t);
  }

  // Rows of one time with sides the wrong way round.
  void require_sides() const {
    if (!columns_.side) return;
    const auto side = table_.side(*columns_.side);
    if (last_side_ == RowSide::after || side == RowSide::before)
      refuse(table_.place(), "side", shown(side), "- (before the jump) above + (after it)", {},
             "not-sorted");
  }

  void take_row() {
    const auto dof = std::size_t(options_.dof);
    if (++rows_ > room_) {
      constexpr std::size_t rows_at_once = 4096;
      const auto reserved = history_.motion.u.capacity() / dof, wanted = rows_ + rows_at_once;
      resize(reserved >= rows_ ? std::min(reserved, wanted) : wanted);
    }
    for (auto& target : targets_) {
      Number number;
      table_.read_number(target.column, number);
      target.digits.take(number);
      (*target.into)[(rows_ - 1) * dof + target.mass] = number.value;
    }
  }

  void resize(std::size_t rows) {
    auto& motion = history_.motion;
    const auto size = rows * std::size_t(options_.dof);
    motion.u.resize(size);
    if (columns_.has_v()) motion.v.resize(size);
    if (columns_.has_a()) motion.a.resize(size);
    room_ = rows;
  }

  // Growing by doubling would hold a large history's numbers up to three times.
  void reserve() {
    const auto rows = table_.expected_rows();
    if (rows == 0) return;
    auto& motion = history_.motion;
    const auto dof = std::size_t(options_.dof);
    motion.t.reserve(rows);
    motion.u.reserve(rows * dof);
    if (columns_.has_v()) motion.v.reserve(rows * dof);
    if (columns_.has_a()) motion.a.reserve(rows * dof);
    reserved_ = true;
  }

  void finish() {
    resize(rows_);
    const auto& times = history_.motion.t;
    if (times.empty() || times.back() == times.front())
      refuse(table_.name(), "times", double(!times.empty()), "two different times at least", {},
             "too-short");
    if (columns_.t) print("t", time_digits_);
    for (const auto& target : targets_) print(table_.names()[target.column], target.digits);
    const auto [median, least, most] = numerics::time_steps(times);
    history_.spacing = median;
    const double unit = time_digits_.half_unit();
    // Each difference errs by half a unit in the last place of both times.
    const double rounding = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(times.back());
    if (most - least > std::max(1e-3 * unit, rounding)) history_.time_half_unit = unit;
  }

  void print(const std::string& name, const PrintedDigits& digits) {
    history_.columns.push_back(
        {name, digits.digits(), digits.single_precision(), digits.half_unit()});
  }

  HistoryOptions options_;
  History history_;
  Table& table_;
  HistoryColumns columns_;
  std::vector<Target> targets_;
  PrintedDigits time_digits_;
  RowSide last_side_ = RowSide::none;
  std::size_t rows_ = 0, room_ = 0;
  bool reserved_ = false;
};

}  // namespace

History read_history(const Source& source, const HistoryOptions& options) {
  if (options.step != 0.0) require_step("history", options.step);
  auto choice = options.results;
  if (choice.most_nodes == 0) choice.most_nodes = options.dof;
  const auto table =
      open_table(source, options.columns, TableKind::history, options.interrupt, choice);
  return Reader(*table, options).run();
}

}  // namespace clackers::input
