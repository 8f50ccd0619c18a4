#include "clackers/study/check/history/prepared_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/record/notes.hpp"
#include "clackers/study/check/initial_state.hpp"

namespace clackers::study {

void require_masses(const std::string& name, const input::History& history) {
  const auto dof = history.motion.dof;
  const auto has = [&](int mass) {
    return std::ranges::count(history.names, fmt::format("u{}", mass)) > 0;
  };
  int given = dof;
  while (has(given + 1)) ++given;
  if (given > dof)
    throw InputError(
        fmt::format("{} has displacements up to u{}; allowed: {}. It is a history of another case "
                    "or another mesh. Skip what is no displacement of the case with --columns (_).",
                    name, given,
                    dof == 1 ? std::string("u1, the mass of this case")
                             : fmt::format("u1 to u{}, the masses of this case", dof)),
        "not-this-case");
}

namespace {

class Preparation {
 public:
  Preparation(const HistoryTask& task, input::History history, const cases::Case& problem)
      : task_(task), problem_(problem), h_(std::move(history)) {
    file_.file = input::given_name(task.file);
    file_.notes = std::move(h_.notes);
    file_.has_velocities = !h_.motion.v.empty();
    file_.has_u = h_.has_u;
    file_.spacing = h_.spacing;
    file_.columns = h_.columns;
  }

  PreparedHistory run() {
    require_masses(file_.file, h_);
    if (!h_.has_time) start_times();
    find_printed_floor();
    const auto opening = take_opening();
    cut_at_end();
    require_start(opening);
    const bool has_all_u = std::ranges::find(h_.has_u, false) == h_.has_u.end();
    return {std::move(h_), std::move(file_), has_all_u};
  }

 private:
  FirstRow first_row() const {
    const auto dof = std::size_t(h_.motion.dof);
    FirstRow row{h_.motion.t.front(), {}, {}};
    for (std::size_t j = 0; j < dof; ++j) {
      row.u.push_back(h_.has_u[j] ? h_.motion.u[j] : unknown);
      if (file_.has_velocities) row.v.push_back(h_.motion.v[j]);
    }
    return row;
  }

  // A recorder that writes after each step leaves the initial state out.
  void start_times() {
    const bool initial = start_difference(first_row(), problem_).relative <= start_tolerance;
    if (!initial)
      for (std::size_t i = 0; i < h_.motion.t.size(); ++i)
        h_.motion.t[i] = task_.step * double(i + 1);
    file_.notes.push_back(record::note("no-times", {task_.step, initial ? 0.0 : task_.step}));
  }

  // What printing may make of a displacement error, relative to the envelope: the rounding of u,
  // and that of t times the largest velocity.
  void find_printed_floor() {
    const auto envelope = problem_.motion->peak();
    for (int j = 0; j < h_.motion.dof; ++j) {
      const auto at = std::ranges::find_if(h_.columns, [&](const PrintedColumn& c) {
        return c.name == fmt::format("u{}", j + 1) || c.name == "u";
      });
      const double rounding = at == h_.columns.end() ? 0.0 : at->half_unit;
      const double shift = h_.time_half_unit * envelope.v[j];
      const double floor = (rounding + shift) / envelope.u[j];
      if (!h_.has_u[std::size_t(j)] || !(floor > file_.printed_floor)) continue;
      file_.printed_floor = floor;
      file_.printed_by = rounding >= shift ? at->name : h_.columns.front().name;
    }
  }

  diagnose::FirstRows take_opening() const {
    const auto& m = h_.motion;
    const auto rows = std::min(m.t.size(), diagnose::most_opening_rows);
    const auto numbers = std::ptrdiff_t(rows * std::size_t(m.dof));
    diagnose::FirstRows opening;
    opening.rows.dof = m.dof;
    opening.rows.t.assign(m.t.begin(), m.t.begin() + std::ptrdiff_t(rows));
    opening.rows.u.assign(m.u.begin(), m.u.begin() + numbers);
    if (!m.v.empty()) opening.rows.v.assign(m.v.begin(), m.v.begin() + numbers);
    opening.step = task_.step > 0.0 && !task_.step_is_tolerance ? task_.step : file_.spacing;
    opening.has_u = h_.has_u;
    opening.printed_floor = file_.printed_floor;
    opening.columns = h_.names;
    return opening;
  }

  // Rows after the end of the case are left out; a time that only printing carries past it stays.
  void cut_at_end() {
    auto& m = h_.motion;
    const double end = problem_.motion->end();
    const double slack = h_.time_half_unit + 4.0 * std::numeric_limits<double>::epsilon() * end;
    const auto kept = std::size_t(std::ranges::upper_bound(m.t, end + slack) - m.t.begin());
    require_seconds(name(), m.t.back(), double(kept) / double(m.t.size()), 1.0, problem_);
    file_.rows_beyond = static_cast<long long>(m.t.size() - kept);
    const auto dof = std::size_t(m.dof);
    m.t.resize(kept);
    for (auto* values : {&m.u, &m.v, &m.a})
      if (!values->empty()) values->resize(kept * dof);
    for (double& t : m.t) t = std::min(t, end);
    if (kept < 2 || !(m.t.back() > m.t.front()))
      refuse(name(), "rows up to the end of the case", double(kept),
             fmt::format("two at least within 0 to {:g} s", end),
             "Set t_end or a_t of the case for a longer run.", "too-short");
    if (m.t.front() < 0.0)
      refuse(name(), "first time", m.t.front(), "0 s or later",
             "The cases start at t = 0; shift the times.", "time-outside");
    file_.rows = static_cast<long long>(kept);
    file_.first = m.t.front();
    file_.last = m.t.back();
  }

  void require_start(const diagnose::FirstRows& opening) {
    const auto row = first_row();
    const auto most = start_difference(row, problem_);
    file_.start_error = most.relative;
    if (row.t == 0.0 && most.relative > start_tolerance + 2.0 * file_.printed_floor)
      refuse_start(name(), opening, problem_, most);
    if (row.t > 0.0 && most.relative > judge::far_start) refuse_reading(name(), opening, problem_);
  }

  std::string name() const { return input::name_of(task_.file); }

  const HistoryTask& task_;
  const cases::Case& problem_;
  input::History h_;
  record::HistoryFile file_;
};

}  // namespace

void require_seconds(const std::string& name, double last, double kept, double least_part,
                     const cases::Case& problem) {
  constexpr double most_kept = 0.1, slack = 0.02;
  if (kept > most_kept) return;
  const double end = problem.motion->end();
  for (const auto& [factor, unit] : {std::pair{1e3, "milliseconds"}, {1e6, "microseconds"}})
    if (const double part = last / (factor * end); part > least_part - slack && part < 1.0 + slack)
      throw InputError(
          fmt::format("{}: {} They go up to {:.6g}, and {} ends at {:.6g} s.", name,
                      diagnose::sentence_of({.code = "time-unit", .value = factor, .text = unit}),
                      last, problem.entry->name, end),
          "time-unit");
}

PreparedHistory prepare(const HistoryTask& task, input::History data, const cases::Case& problem) {
  return Preparation(task, std::move(data), problem).run();
}

}  // namespace clackers::study
