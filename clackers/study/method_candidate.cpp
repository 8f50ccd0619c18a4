#include "clackers/study/method_candidate.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "clackers/diagnose/observation.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/methods/method_specification.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/record/all_metrics.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/run_sinks.hpp"
#include "clackers/study/shared_runs.hpp"

namespace clackers::study {
namespace {

// Costs of a state, relative: with errors, for timing only, with metrics.
constexpr double error_state = 1.0, timed_state = 0.5, measured_state = 10.0;

// The clock of a thread costs and errs by less than a microsecond: a hundredth of this.
constexpr double shortest_timing = 1e-4;  // [s]
constexpr int most_repetitions = 1000;

record::Curve curve_of(const measure::ErrorHistory& history, int dof) {
  record::Curve curve;
  curve.t = history.times();
  for (int i = 0; i < dof; ++i) curve.y.push_back(history.largest(i));
  return curve;
}

// The points of a run that an animation needs; the whole run would fill memory.
record::Curve motion_of(const model::Trajectory& history) {
  constexpr std::size_t most = 500;
  const auto dof = std::size_t(history.dof);
  return record::reduced(
      history.t.size(), dof, [&](std::size_t row) { return history.t[row]; },
      [&](std::size_t mass, std::size_t row) { return history.u[row * dof + mass]; }, most);
}

// Displacements over the largest envelopes.
std::vector<double> relative(std::vector<double> u, const StudyCase& problem) {
  const auto envelope = problem.scales ? problem.scales->peak.u : problem.problem.motion->peak().u;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] /= envelope[Eigen::Index(i)];
  return u;
}

// Of this thread [s].
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Processor time of one run [s]; nothing when interrupted.
std::optional<double> time_of(model::Run& run, model::Sink& sink) {
  const double start = processor_time();
  double used = 0.0;
  int runs = 0;
  while (used < shortest_timing && runs < most_repetitions) {
    if (run.advance(sink).stopped_by_sink) return {};
    used = processor_time() - start;
    ++runs;
  }
  return used / runs;
}

// Whether all contacts have restitution 0 and one opens right after an impact: its gap accelerates, by more
// than rounding.
bool opens_at_once(const StudyCase& problem) {
  const auto& contacts = problem.problem.problem.contacts;
  const auto is_elastic = [](const auto& contact) { return contact.restitution != 0.0; };
  if (contacts.empty() || std::ranges::any_of(contacts, is_elastic)) return false;
  for (long long k = 1; k <= problem.summary.impact_count; ++k) {
    const auto impact = problem.problem.motion->impact(k);
    const auto& b = contacts[std::size_t(impact.contact)].direction;
    if (b.dot(impact.after.a) > 1e-9 * b.cwiseAbs().dot(impact.after.a.cwiseAbs())) return true;
  }
  return false;
}

record::Subject subject_of(const methods::Method& method, const StudyCase& problem) {
  const auto facts = method.facts();
  const bool collides =
      problem.summary.impact_count > 0 || !problem.problem.motion->closed_contacts().empty();
  record::Subject subject;
  subject.name = methods::short_name(facts.name);
  if (const auto terms = methods::terms_of(facts.name); terms.size() == 2) {
    subject.integrator = terms[0];
    subject.treatment = terms[1];
  }
  subject.claim =
      methods::claim_on(facts, problem.problem.problem, collides, !problem.shared.empty(),
                        facts.plastic_order > 0.0 && opens_at_once(problem));
  if (facts.is_adaptive) {
    subject.refined_by = record::RefinementParameter::tolerance;
    // The estimate falls with the power of the step that the error over a run does.
    if (subject.claim.order > 0.0) subject.claim.order = 1.0;
  }
  if (const auto objection = method.objection(problem.problem.problem)) {
    subject.refusal = objection_text(method, *objection);
    subject.refusal_code = objection->code.name();
  } else if (collides || !problem.problem.problem.frictions.empty()) {
    subject.contact_time = method.contact_time(problem.problem.problem);
  }
  return subject;
}

}  // namespace

std::string objection_text(const methods::Method& method, const methods::Objection& objection) {
  std::string_view text = objection.sentence;
  const auto name = method.facts().name;
  if (!text.starts_with(name)) return objection.sentence;
  text.remove_prefix(name.size());
  return std::string(text.substr(std::min(text.find_first_not_of(": "), text.size())));
}

MethodCandidate::MethodCandidate(std::shared_ptr<const methods::Method> method,
                                 const StudyCase& problem, const std::vector<double>& tolerances,
                                 const Extras& extras)
    : problem_(problem), method_(std::move(method)), extras_(extras) {
  const auto facts = method_->facts();
  facts_.subject = subject_of(*method_, problem);
  facts_.order = facts.smooth_order;
  if (facts.is_adaptive) facts_.levels = tolerances;
  facts_.has_ends = extras.record && !facts.is_adaptive;
  reports_impacts_ = facts.reports_impacts;
  if (problem_.runs) shared_run_ = method_->shared_run(problem_.problem.problem);
  constexpr double of_linear_spring = 0.5;
  if (facts.model_order == of_linear_spring) spring_time_ = facts_.subject.contact_time;
}

double MethodCandidate::cost(const RunTask& task) const {
  const double state = task.wanted.metrics || task.wanted.observation
                           ? error_state + timed_state + measured_state
                           : error_state + timed_state;
  return state * double(task.run.steps);
}

std::optional<Measured> MethodCandidate::run(const RunTask& task, TaskShare& share,
                                             const std::atomic<bool>* interrupt) {
  if (interrupt != nullptr && *interrupt) return {};
  const bool is_shared = !shared_run_.empty();
  auto key = SharedRuns::key(shared_run_, task);
  auto result = is_shared ? problem_.runs->find(key) : std::nullopt;
  if (result && !extras_.times) return result;
  const double start = processor_time();
  const auto run = method_->prepare(problem_.problem.problem,
                                    task.run.tolerance > 0.0
                                        ? methods::Resolution::by_tolerance(task.run.tolerance)
                                        : methods::Resolution(task.run.step));
  if (!result) {
    result = task.wanted.observation ? observed(*run, task, share, interrupt)
                                     : measured(*run, task, share, interrupt);
    if (!result) return {};
    result->seconds = processor_time() - start;
    if (result->run.score.finished) result->run.score.seconds = result->seconds;
    if (is_shared) problem_.runs->keep(std::move(key), *result);
  }
  if (!extras_.times || task.wanted.observation || !result->run.score.finished) return result;
  const double timing = processor_time();
  WatchedSink timed(nullptr, share, timed_state, interrupt);
  const auto seconds = time_of(*run, timed);
  if (!seconds) return {};
  result->run.score.seconds = *seconds;
  result->seconds += processor_time() - timing;
  return result;
}

std::optional<Measured> MethodCandidate::measured(model::Run& run, const RunTask& task,
                                                  TaskShare& share,
                                                  const std::atomic<bool>* interrupt) const {
  const auto& problem = problem_.problem.problem;
  const auto& motion = *problem_.problem.motion;
  measure::ErrorSink errors(motion, problem, task.run.step,
                            {.impacts_are_reported = reports_impacts_,
                             .contact_time = facts_.subject.contact_time,
                             .history_bins = task.wanted.history_bins,
                             .states = task.run.tolerance > 0.0 || !problem_.states
                                           ? nullptr
                                           : problem_.states->of(task.run.step, task.run.steps),
                             .steps = task.run.tolerance > 0.0 ? 0 : task.run.steps,
                             .scales = problem_.scales.get()});
  model::TrajectorySink stored(reports_impacts_);
  RunRecorder recorder(errors, task.wanted.metrics ? &stored : nullptr);
  WatchedSink watched(&recorder, share, error_state, interrupt);
  const auto outcome = run.advance(watched);
  if (outcome.stopped_by_sink) return {};
  Measured result;
  result.run.score = errors.score(outcome);
  result.run.score.step = task.resolution();
  if (task.wanted.history_bins > 0)
    result.run.error_history = curve_of(errors.history(), motion.dof());
  if (!outcome.finished) return result;
  if (facts_.has_ends) result.end_u = relative(recorder.last_u(), problem_);
  // A state that is not finite is no row of a history.
  if (task.wanted.metrics && std::isfinite(result.run.score.u_error)) {
    auto facts = record::facts_of(problem_.summary, problem, spring_time_);
    facts.contact_time = facts_.subject.contact_time;
    auto metrics = record::all_metrics({stored.trajectory(), motion, problem, std::move(facts)}, {},
                                       interrupt);
    if (!metrics) return {};
    result.run.metrics = std::move(*metrics);
    if (extras_.record && motion.dof() <= record::most_blocks)
      result.run.motion = motion_of(stored.trajectory());
  }
  return result;
}

std::optional<Measured> MethodCandidate::observed(model::Run& run, const RunTask& task,
                                                  TaskShare& share,
                                                  const std::atomic<bool>* interrupt) const {
  model::TrajectorySink stored(reports_impacts_);
  WatchedSink watched(&stored, share, error_state, interrupt);
  const auto outcome = run.advance(watched);
  if (outcome.stopped_by_sink) return {};
  Measured result;
  const auto& u = stored.trajectory().u;
  if (!outcome.finished || !std::ranges::all_of(u, [](double x) { return std::isfinite(x); }))
    return result;
  const measure::Comparison comparison(stored.trajectory(), *problem_.problem.motion,
                                       problem_.problem.problem,
                                       {.contact_time = facts_.subject.contact_time});
  result.observation = diagnose::observe(
      comparison, {.step = task.resolution(),
                   .spacing = problem_.summary.end / double(task.run.steps),
                   .floor = 0.0,
                   .time_half_unit = 0.0,
                   .columns = {},
                   .contact_time = reports_impacts_ ? 0.0 : facts_.subject.contact_time});
  return result;
}

}  // namespace clackers::study
