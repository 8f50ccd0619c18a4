#include "clackers/study/check/history_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clackers/assess/convergence/judge.hpp"
#include "clackers/assess/errors/comparison.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exchange/events.hpp"
#include "clackers/exchange/history.hpp"
#include "clackers/exchange/text/text_lines.hpp"
#include "clackers/study/cause_metrics.hpp"
#include "clackers/study/check/history_score.hpp"
#include "clackers/study/check/initial_state.hpp"
#include "clackers/study/check/refused_start.hpp"
#include "clackers/study/notes.hpp"
#include "clackers/study/reduced_curve.hpp"

namespace clackers::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Shares of a file's work: reading it, and reading with its comparison.
constexpr double read_share = 0.4, compared_share = 0.5;

class HistoryReader {
 public:
  HistoryReader(const HistoryTask& task, const cases::Case& problem, const CaseSummary& summary,
                exchange::History history, const Progress& progress,
                const std::atomic<bool>* interrupt)
      : task_(task),
        problem_(problem),
        summary_(summary),
        h_(std::move(history)),
        all_u_(std::ranges::find(h_.has_u, false) == h_.has_u.end()),
        progress_(progress),
        interrupt_(interrupt) {
    file_.file = task.file;
    for (auto& read : h_.notes)
      file_.notes.push_back({std::move(read.code), std::move(read.numbers), std::move(read.text)});
    file_.has_velocities = !h_.motion.v.empty();
    file_.has_u = h_.has_u;
    file_.spacing = h_.spacing;
    for (const auto& c : h_.columns)
      file_.columns.push_back({c.name, c.digits, c.single, c.half_unit});
  }

  ComparedHistory run() {
    if (!h_.has_time) start_times();
    find_printed_floor();
    take_opening();
    cut_at_end();
    require_start();
    run_.score.step = task_.step > 0.0 ? task_.step : file_.spacing;
    if (task_.step > 0.0) file_.step_source = StepSource::option;
    if (!h_.not_finite.empty()) return failed();
    if (!task_.events.empty()) take_events();
    if (!all_u_) complete_u();
    measure();
    add_notes(file_, run_.score, summary_);
    run_.file = std::move(file_);
    return {std::move(run_), std::move(observation_)};
  }

 private:
  ComparedHistory failed() {
    run_.score.failure_code = Code("not-finite").name();
    run_.score.failure = std::move(h_.not_finite);
    run_.file = std::move(file_);
    return {std::move(run_), {}};
  }

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
    file_.notes.push_back(note("no-times", {task_.step, initial ? 0.0 : task_.step}));
  }

  // What printing may make of a displacement error, relative to the envelope: the rounding of u,
  // and that of t times the largest velocity.
  void find_printed_floor() {
    const auto envelope = problem_.motion->envelope(0.0);
    for (int j = 0; j < h_.motion.dof; ++j) {
      const auto at = std::ranges::find_if(h_.columns, [&](const exchange::ColumnPrint& c) {
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

  void take_opening() {
    const auto& m = h_.motion;
    const auto rows = std::min(m.t.size(), diagnose::most_opening_rows);
    const auto numbers = std::ptrdiff_t(rows * std::size_t(m.dof));
    auto& opening = opening_.rows;
    opening.dof = m.dof;
    opening.t.assign(m.t.begin(), m.t.begin() + std::ptrdiff_t(rows));
    opening.u.assign(m.u.begin(), m.u.begin() + numbers);
    if (!m.v.empty()) opening.v.assign(m.v.begin(), m.v.begin() + numbers);
    opening_.step = task_.step > 0.0 && !task_.step_is_tolerance ? task_.step : file_.spacing;
    opening_.has_u = h_.has_u;
    opening_.printed_floor = file_.printed_floor;
    opening_.columns = h_.names;
  }

  // A run of the length of the case, its times in thousandths or millionths of a second.
  void require_seconds(std::size_t kept) const {
    const auto& t = h_.motion.t;
    constexpr double most_kept = 0.1, slack = 0.02;
    if (double(kept) > most_kept * double(t.size())) return;
    for (const auto& [factor, unit] : {std::pair{1e3, "milliseconds"}, {1e6, "microseconds"}}) {
      const double length = factor * problem_.motion->end();
      if (std::abs(t.back() / length - 1.0) < slack)
        throw InputError(fmt::format("{}: times go up to {:.6g}, and {} ends at {:.6g} s: in {}? "
                                     "Convert them to seconds.",
                                     name(), t.back(), summary_.name, summary_.end, unit),
                         "time-unit");
    }
  }

  // Rows after the end of the case are left out; a time that only printing carries past it stays.
  void cut_at_end() {
    auto& m = h_.motion;
    const double end = problem_.motion->end();
    const double slack = h_.time_half_unit + 4.0 * std::numeric_limits<double>::epsilon() * end;
    const auto kept = std::size_t(std::ranges::upper_bound(m.t, end + slack) - m.t.begin());
    require_seconds(kept);
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

  void require_start() {
    const auto row = first_row();
    const auto most = start_difference(row, problem_);
    file_.start_error = most.relative;
    if (row.t == 0.0 && most.relative > start_tolerance + 2.0 * file_.printed_floor)
      refuse_start(name(), opening_, problem_, most);
    if (row.t > 0.0 && most.relative > assess::far_start)
      refuse_reading(name(), opening_, problem_);
  }

  void take_events() {
    auto& m = h_.motion;
    auto impacts = exchange::read_events(task_.events, m.dof, interrupt_);
    const auto outside = [&](const model::Impact& i) {
      return i.t < m.t.front() || i.t > m.t.back();
    };
    if (const auto left_out = std::erase_if(impacts, outside); left_out > 0)
      file_.notes.push_back(
          note("events-outside", {double(left_out), m.t.front(), m.t.back()}, task_.events));
    for (auto& impact : impacts) complete_u(impact);
    m.impacts = std::move(impacts);
  }

  // Two masses that touch have one place: u1 - u2 = gap.
  void complete_u(model::Impact& impact) const {
    const auto& contacts = problem_.problem.contacts;
    if (impact.u.size() != 2 || contacts.size() != 1) return;
    const auto& row = contacts.front();
    const bool first_known = std::isfinite(impact.u[0]);
    if (first_known && std::isfinite(impact.u[1])) return;
    const auto known = first_known ? 0 : 1, other = 1 - known;
    const double left = row.gap - row.direction[known] * impact.u[std::size_t(known)];
    impact.u[std::size_t(other)] = left / row.direction[other];
  }

  // The reference stands in for displacements that are not known, so that they add no error.
  void complete_u() {
    auto& m = h_.motion;
    const auto dof = std::size_t(m.dof);
    constexpr std::size_t block = 4096;
    std::vector<double> u, v;
    for (std::size_t from = 0; from < m.t.size(); from += block) {
      const auto times = std::span(m.t).subspan(from, std::min(block, m.t.size() - from));
      u.resize(times.size() * dof);
      v.resize(times.size() * dof);
      problem_.motion->sample(times, model::Side::right, {u, v, {}});
      for (std::size_t i = 0; i < u.size(); ++i)
        if (!h_.has_u[i % dof]) m.u[from * dof + i] = u[i];
    }
  }

  void measure() {
    report(read_share);
    const double step = run_.score.step;
    const double bend = std::numbers::pi * file_.spacing / summary_.fast_period;
    file_.unseen_bend = 1.0 - std::cos(std::min(bend, std::numbers::pi));
    const assess::Comparison comparison(h_.motion, *problem_.motion, problem_.problem);
    run_.score = history_score(comparison, h_.has_u, step);
    run_.score.rounding_floor = std::max(run_.score.rounding_floor, file_.printed_floor);
    if (!all_u_) {
      file_.notes.push_back(note("displacements-incomplete"));
      return;
    }
    take_collisions(comparison);
    take_curves(comparison);
    observe(comparison);
    report(compared_share);
    auto metrics = all_metrics(
        comparison, facts_of(summary_, 0.0),
        [&](double share) { report(compared_share + (1.0 - compared_share) * share); }, interrupt_);
    if (!metrics) throw Error("interrupted", "interrupted");
    run_.metrics = std::move(*metrics);
  }

  void report(double share) const {
    if (interrupt_ != nullptr && *interrupt_) throw Error("interrupted", "interrupted");
    if (progress_) progress_(share);
  }

  void take_curves(const assess::Comparison& comparison) {
    const auto dof = comparison.dof();
    const auto& u = comparison.history().u;
    const auto time = [&](std::size_t row) { return comparison.history().t[row]; };
    file_.history = reduced(comparison.rows(), dof, time,
                            [&](std::size_t mass, std::size_t row) { return u[row * dof + mass]; });
    run_.error_history =
        reduced(comparison.rows(), dof, time, [&](std::size_t mass, std::size_t row) {
          const auto at = row * dof + mass;
          return std::abs(u[at] - comparison.reference_u()[at]) / comparison.u_envelope()[mass];
        });
  }

  void observe(const assess::Comparison& comparison) {
    diagnose::FileFacts facts{.step = 0.0,
                              .spacing = file_.spacing,
                              .floor = file_.printed_floor,
                              .time_half_unit = h_.time_half_unit,
                              .columns = {},
                              .order = h_.names,
                              .contact_time = file_.contact_time};
    for (const auto& column : file_.columns)
      facts.columns.push_back({column.name, column.digits, column.single, column.half_unit});
    observation_ = diagnose::observe(comparison, facts);
  }

  // A contact of fewer rows than four is an impact whose limits are rows apart.
  double contact_time(const assess::Comparison& comparison) const {
    std::vector<double> lengths;
    for (std::size_t k = 0; k < comparison.impacts().size(); ++k)
      lengths.push_back(comparison.impact_ends()[k] - comparison.impacts()[k].t);
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle >= 4.0 * file_.spacing ? *middle : 0.0;
  }

  void take_collisions(const assess::Comparison& comparison) {
    run_.score.impacts = comparison.impact_score();
    const bool reported = comparison.impact_source() == assess::ImpactSource::reported;
    file_.collisions = reported ? CollisionSource::events : CollisionSource::history;
    // Between two collisions the faster mass turns round once at least; eight rows show it.
    const auto count = std::max(1LL, summary_.impact_count);
    const double apart = summary_.end / double(count);
    if (!reported) file_.contact_time = contact_time(comparison);
    file_.rows_resolve_collisions = reported || 8.0 * file_.spacing <= apart;
    // A mass passes the place of contact with about its largest velocity, amplitude times pi / T.
    auto& floor = run_.score.impacts->rounding_floor;
    floor = std::max(floor, h_.time_half_unit + file_.printed_floor * apart / std::numbers::pi);
  }

  std::string name() const { return exchange::shown_name(task_.file); }

  const HistoryTask& task_;
  const cases::Case& problem_;
  const CaseSummary& summary_;
  exchange::History h_;
  bool all_u_;
  const Progress& progress_;
  const std::atomic<bool>* interrupt_;
  HistoryFile file_;
  diagnose::Opening opening_;
  Run run_;
  std::optional<diagnose::Observation> observation_;
};

}  // namespace

ComparedHistory history_run(const HistoryTask& task, const std::vector<std::string>& columns,
                            const cases::Case& problem, const CaseSummary& summary,
                            const Progress& progress, const std::atomic<bool>* interrupt) {
  exchange::HistoryOptions options{.dof = problem.motion->dof(),
                                   .columns = columns,
                                   .step = task.step_is_tolerance ? 0.0 : task.step,
                                   .until_not_finite = true,
                                   .interrupt = interrupt};
  if (progress) options.progress = [&](double share) { progress(read_share * share); };
  auto history = exchange::read_history(task.file, options);
  return HistoryReader(task, problem, summary, std::move(history), progress, interrupt).run();
}

}  // namespace clackers::study
