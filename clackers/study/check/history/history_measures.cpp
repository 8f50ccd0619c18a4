#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/record/all_metrics.hpp"
#include "clackers/record/notes.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/check/history/prepared_history.hpp"

namespace clackers::study {
namespace {

// The share of a file's work at which the comparison stands and the metrics begin.
constexpr double compared_share = 0.5;

class Measurement {
 public:
  Measurement(PreparedHistory& history, const cases::Case& problem,
              const record::CaseSummary& summary, const Progress& progress,
              const std::atomic<bool>* interrupt)
      : history_(history),
        file_(history.file),
        problem_(problem),
        summary_(summary),
        progress_(progress),
        interrupt_(interrupt) {}

  ComparedHistory run(double step) {
    report(read_share);
    const double bend = std::numbers::pi * file_.spacing / summary_.fast_period;
    file_.unseen_bend = 1.0 - std::cos(std::min(bend, std::numbers::pi));
    const measure::Comparison comparison(history_.data.motion, *problem_.motion, problem_.problem,
                                         facts_of(summary_, problem_.problem, 0.0));
    run_.score = comparison.score(step);
    run_.score.rounding_floor = std::max(run_.score.rounding_floor, file_.printed_floor);
    if (history_.has_all_u)
      measure_motion(comparison);
    else
      forget_what_needs_all_u();
    add_notes(file_, run_.score, summary_);
    run_.file = std::move(file_);
    return {std::move(run_), std::move(observation_)};
  }

 private:
  void forget_what_needs_all_u() {
    run_.score.energy_error = run_.score.energy_ratio = unknown;
    run_.score.impacts.reset();
    file_.notes.push_back(record::note("displacements-incomplete"));
  }

  // What needs the displacements of all masses.
  void measure_motion(const measure::Comparison& comparison) {
    take_impacts(comparison);
    take_curves(comparison);
    observe(comparison);
    report(compared_share);
    auto metrics = record::all_metrics(
        comparison, [&](double share) { report(compared_share + (1.0 - compared_share) * share); },
        interrupt_);
    if (!metrics) throw Error("interrupted", "interrupted");
    run_.metrics = std::move(*metrics);
  }

  void report(double share) const {
    if (interrupt_ != nullptr && *interrupt_) throw Error("interrupted", "interrupted");
    if (progress_) progress_(share);
  }

  void take_curves(const measure::Comparison& comparison) {
    const auto dof = comparison.dof();
    const auto& u = comparison.history().u;
    const auto time = [&](std::size_t row) { return comparison.history().t[row]; };
    file_.history =
        record::reduced(comparison.rows(), dof, time,
                        [&](std::size_t mass, std::size_t row) { return u[row * dof + mass]; });
    run_.error_history =
        record::reduced(comparison.rows(), dof, time, [&](std::size_t mass, std::size_t row) {
          const auto at = row * dof + mass;
          return std::abs(u[at] - comparison.reference_u()[at]) / comparison.u_envelope()[mass];
        });
  }

  void observe(const measure::Comparison& comparison) {
    const diagnose::FileFacts facts{.step = 0.0,
                                    .spacing = file_.spacing,
                                    .floor = file_.printed_floor,
                                    .time_half_unit = history_.data.time_half_unit,
                                    .columns = file_.columns,
                                    .order = history_.data.names,
                                    .contact_time = file_.contact_time};
    observation_ = diagnose::observe(comparison, facts);
    // A rigid contact noticed late holds several rows as well.
    if (file_.contact_time > 0.0 &&
        diagnose::locate_impacts(*observation_, problem_.problem).is_rigid())
      observation_->facts.contact_time = file_.contact_time = 0.0;
  }

  // A contact of fewer rows than four is an impact whose limits are rows apart.
  double contact_time(const measure::Comparison& comparison) const {
    std::vector<double> lengths;
    for (std::size_t k = 0; k < comparison.impacts().size(); ++k)
      lengths.push_back(comparison.impact_ends()[k] - comparison.impacts()[k].t);
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle >= 4.0 * file_.spacing ? *middle : 0.0;
  }

  void take_impacts(const measure::Comparison& comparison) {
    if (problem_.problem.has_unstated_impacts()) {
      run_.score.impacts.reset();
      file_.notes.push_back(record::note("impacts-not-stated"));
      return;
    }
    const bool reported = comparison.impact_source() == measure::ImpactSource::reported;
    file_.impact_source = reported ? record::ImpactSource::events : record::ImpactSource::history;
    // Between two impacts the faster mass turns round once at least; eight rows show it.
    const auto count = std::max(1LL, summary_.impact_count);
    const double apart = summary_.end / double(count);
    if (!reported) file_.contact_time = contact_time(comparison);
    file_.rows_resolve_impacts = reported || 8.0 * file_.spacing <= apart;
    // A mass passes the place of contact with about its largest velocity, amplitude times pi / T.
    auto& floor = run_.score.impacts->rounding_floor;
    floor = std::max(floor,
                     history_.data.time_half_unit + file_.printed_floor * apart / std::numbers::pi);
  }

  PreparedHistory& history_;
  record::HistoryFile& file_;
  const cases::Case& problem_;
  const record::CaseSummary& summary_;
  const Progress& progress_;
  const std::atomic<bool>* interrupt_;
  record::Run run_;
  std::optional<diagnose::Observation> observation_;
};

}  // namespace

ComparedHistory measure(PreparedHistory history, double step, const cases::Case& problem,
                        const record::CaseSummary& summary, const Progress& progress,
                        const std::atomic<bool>* interrupt) {
  return Measurement(history, problem, summary, progress, interrupt).run(step);
}

}  // namespace clackers::study
