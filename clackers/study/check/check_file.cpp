#include "clackers/study/check/check_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exchange/events.hpp"
#include "clackers/exchange/history.hpp"
#include "clackers/study/cause_metrics.hpp"
#include "clackers/study/check/check_curves.hpp"
#include "clackers/study/check/check_notes.hpp"
#include "clackers/study/check/check_score.hpp"
#include "clackers/study/check/check_start.hpp"
#include "clackers/study/check/check_steps.hpp"

namespace clackers::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A history on its way to becoming a CheckedFile.
class Check {
 public:
  Check(const CheckTask& task, const cases::Case& which, const CaseSummary& summary,
        exchange::History history)
      : task_(task),
        which_(which),
        summary_(summary),
        h_(std::move(history)),
        all_u_(std::ranges::find(h_.has_u, false) == h_.has_u.end()) {
    out_.file = task.file;
    out_.notes = h_.notes;
    out_.has_velocities = !h_.motion.v.empty();
    out_.has_u = h_.has_u;
    out_.spacing = h_.spacing;
    for (const auto& c : h_.columns)
      out_.columns.push_back({c.name, c.digits, c.single, c.half_unit});
  }

  CheckedFile run(const std::atomic<bool>* interrupt) {
    if (!h_.has_time) start_times();
    floors();
    cut_at_end();
    require_start();
    choose_step();
    if (!task_.events.empty()) take_events(interrupt);
    measure();
    add_notes(out_, summary_);
    return std::move(out_);
  }

 private:
  FirstRow first_row() const {
    const auto dof = std::size_t(h_.motion.dof);
    FirstRow row{h_.motion.t.front(), {}, {}};
    for (std::size_t j = 0; j < dof; ++j) {
      row.u.push_back(h_.has_u[j] ? h_.motion.u[j] : unknown);
      if (out_.has_velocities) row.v.push_back(h_.motion.v[j]);
    }
    return row;
  }

  // A recorder that writes after each step leaves the initial state out.
  void start_times() {
    const bool initial = start_error(first_row(), which_) <= start_tolerance;
    if (!initial)
      for (std::size_t i = 0; i < h_.motion.t.size(); ++i)
        h_.motion.t[i] = task_.step * double(i + 1);
    out_.notes.push_back(
        fmt::format("No times in the file: rows are {:g} s apart, the first {}.", task_.step,
                    initial ? "at 0, since it is the initial state" : "one step after the start"));
  }

  // What printing may make of a displacement error, relative to the envelope: the rounding of u,
  // and that of t times the largest velocity.
  void floors() {
    const auto envelope = which_.motion->envelope(0.0);
    for (int j = 0; j < h_.motion.dof; ++j) {
      const auto at = std::ranges::find_if(h_.columns, [&](const exchange::ColumnPrint& c) {
        return c.name == fmt::format("u{}", j + 1) || c.name == "u";
      });
      const double rounding = at == h_.columns.end() ? 0.0 : at->half_unit;
      const double shift = h_.time_half_unit * envelope.v[j];
      const double floor = (rounding + shift) / envelope.u[j];
      if (!h_.has_u[std::size_t(j)] || !(floor > out_.printed_floor)) continue;
      out_.printed_floor = floor;
      out_.printed_by = rounding >= shift ? at->name : h_.columns.front().name;
    }
  }

  // Rows after the end of the case are left out; a time that only printing carries past it stays.
  void cut_at_end() {
    auto& m = h_.motion;
    const double end = which_.motion->end();
    const double slack = h_.time_half_unit + 4.0 * std::numeric_limits<double>::epsilon() * end;
    const auto kept = std::size_t(std::ranges::upper_bound(m.t, end + slack) - m.t.begin());
    out_.rows_beyond = static_cast<long long>(m.t.size() - kept);
    const auto dof = std::size_t(m.dof);
    m.t.resize(kept);
    for (auto* values : {&m.u, &m.v, &m.a})
      if (!values->empty()) values->resize(kept * dof);
    for (double& t : m.t) t = std::min(t, end);
    if (kept < 2 || !(m.t.back() > m.t.front()))
      refuse(task_.file, "rows up to the end of the case", double(kept),
             fmt::format("two at least within 0 to {:g} s", end),
             "Set t_end or a_t of the case for a longer run.", "too-short");
    if (m.t.front() < 0.0)
      refuse(task_.file, "first time", m.t.front(), "0 s or later",
             "The cases start at t = 0; shift the times.", "time-outside");
    out_.rows = static_cast<long long>(kept);
    out_.first = m.t.front();
    out_.last = m.t.back();
  }

  void require_start() {
    const auto row = first_row();
    out_.start_error = start_error(row, which_);
    if (row.t == 0.0 && out_.start_error > start_tolerance + 2.0 * out_.printed_floor)
      throw InputError(task_.file + ": " + other_start(row, which_), "not-this-case");
  }

  void choose_step() {
    out_.score.step = out_.spacing;
    if (task_.step > 0.0) {
      out_.score.step = task_.step;
      out_.step_source = StepSource::option;
      return;
    }
    const auto named = step_in_name(task_.file);
    if (!named) return;
    // A number in a name that is longer than the time between rows is no step of this history.
    if (*named <= 1.01 * out_.spacing) {
      out_.score.step = *named;
      out_.step_source = StepSource::name;
    } else {
      out_.notes.push_back(
          fmt::format("The {:g} in the name is longer than the {:.3g} s between rows, so it is not "
                      "taken for the step.",
                      *named, out_.spacing));
    }
  }

  void take_events(const std::atomic<bool>* interrupt) {
    auto& m = h_.motion;
    auto impacts = exchange::read_events(task_.events, m.dof, interrupt);
    const auto outside = [&](const model::Impact& i) {
      return i.t < m.t.front() || i.t > m.t.back();
    };
    if (const auto left_out = std::erase_if(impacts, outside); left_out > 0)
      out_.notes.push_back(
          fmt::format("{} collisions of {} lie outside the history's {:g} to {:g} "
                      "s and are not judged.",
                      left_out, task_.events, m.t.front(), m.t.back()));
    for (auto& impact : impacts) complete_u(impact);
    m.impacts = std::move(impacts);
  }

  // Two masses that touch have one place: u1 - u2 = gap.
  void complete_u(model::Impact& impact) const {
    const auto& contacts = which_.problem.contacts;
    if (impact.u.size() != 2 || contacts.size() != 1) return;
    const auto& row = contacts.front();
    const bool first_known = std::isfinite(impact.u[0]);
    if (first_known && std::isfinite(impact.u[1])) return;
    const auto known = first_known ? 0 : 1, other = 1 - known;
    const double left = row.gap - row.direction[known] * impact.u[std::size_t(known)];
    impact.u[std::size_t(other)] = left / row.direction[other];
  }

  void measure() {
    const auto& m = h_.motion;
    const double step = out_.score.step;
    out_.score = score_history(m, h_.has_u, step, *which_.motion, which_.problem);
    out_.score.rounding_floor = std::max(out_.score.rounding_floor, out_.printed_floor);
    const double bend = std::numbers::pi * out_.spacing / summary_.fast_period;
    out_.unseen_bend = 1.0 - std::cos(std::min(bend, std::numbers::pi));
    if (!all_u_) {
      out_.notes.push_back(
          "Without the displacements of all masses neither collisions nor metrics are judged.");
      return;
    }
    const assess::Comparison comparison(m, *which_.motion, which_.problem);
    take_collisions(comparison);
    out_.metrics = all_metrics(comparison, facts_of(summary_, 0.0));
    out_.history = displacement_curve(comparison);
    out_.error_history = error_curve(comparison);
  }

  // A contact of fewer rows than four is an impact whose limits are rows apart.
  double contact_time(const assess::Comparison& comparison) const {
    std::vector<double> lengths;
    for (std::size_t k = 0; k < comparison.impacts().size(); ++k)
      lengths.push_back(comparison.impact_ends()[k] - comparison.impacts()[k].t);
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle >= 4.0 * out_.spacing ? *middle : 0.0;
  }

  void take_collisions(const assess::Comparison& comparison) {
    out_.score.impacts = comparison.impact_score();
    const bool reported = comparison.impact_source() == assess::ImpactSource::reported;
    out_.collisions = reported ? CollisionSource::events : CollisionSource::history;
    // Between two collisions the faster mass turns round once at least; eight rows show it.
    const auto count = std::max(1LL, summary_.impact_count);
    const double apart = summary_.end / double(count);
    if (!reported) out_.contact_time = contact_time(comparison);
    out_.rows_resolve_collisions = reported || 8.0 * out_.spacing <= apart;
    // A mass passes the place of contact with about its largest velocity, amplitude times pi / T.
    auto& floor = out_.score.impacts->rounding_floor;
    floor = std::max(floor, h_.time_half_unit + out_.printed_floor * apart / std::numbers::pi);
  }

  const CheckTask& task_;
  const cases::Case& which_;
  const CaseSummary& summary_;
  exchange::History h_;
  bool all_u_;
  CheckedFile out_;
};

}  // namespace

CheckedFile check_file(const CheckTask& task, const std::vector<std::string>& columns,
                       const cases::Case& which, const CaseSummary& summary,
                       const std::atomic<bool>* interrupt) {
  exchange::HistoryOptions options{
      .dof = which.motion->dof(), .columns = columns, .step = task.step, .interrupt = interrupt};
  return Check(task, which, summary, exchange::read_history(task.file, options)).run(interrupt);
}

}  // namespace clackers::study
