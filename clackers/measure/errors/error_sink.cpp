#include "clackers/measure/errors/error_sink.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::measure {
namespace {

constexpr auto sink_name = "error sink";
constexpr auto sink_block = StateErrors::most;

const model::ImpactProblem<>& checked(const model::ImpactProblem<>& problem,
                                      const model::Motion& reference) {
  if (problem.dof() != reference.dof())
    refuse(sink_name, "masses of the problem", double(problem.dof()),
           "as many as the reference has", {}, "wrong-size");
  return problem;
}

}  // namespace

ErrorSink::ErrorSink(const model::Motion& reference, const model::ImpactProblem<>& problem,
                     double step, const ErrorSinkOptions& options)
    : reference_(reference),
      dof_(std::size_t(reference.dof())),
      start_(problem.start.t),
      step_(require_step(sink_name, step)),
      options_(options),
      contacts_(problem.contacts),
      times_(sink_block),
      u_reference_(sink_block * dof_),
      v_reference_(sink_block * dof_),
      relative_(dof_),
      meter_(reference, problem,
             options.scales != nullptr ? *options.scales
                                       : scales_of(reference, checked(problem, reference))),
      impacts_(reference, step, 0.0, int(problem.contacts.size()), options.contact_time),
      history_(options.history_bins, reference.dof(), problem.start.t, problem.end) {
  const auto& [peak, energy] = meter_.scales();
  for (const double u : peak.u) require_positive(sink_name, "envelope of u", u);
  for (const double v : peak.v) require_positive(sink_name, "envelope of v", v);
  require_positive(sink_name, "energy of the reference", energy);
}

// The states of the reference into u_reference_ and v_reference_. Returns whether the times are those expected.
bool ErrorSink::copy_ahead(std::span<const double> times) {
  for (std::size_t done = 0; done < times.size();) {
    const auto first = (taken_ + done) % GridStates::most;
    if (first == 0)
      ahead_.fill(reference_, start_, step_, std::size_t(options_.steps), taken_ + done, 0);
    const auto count = std::min(times.size() - done, ahead_.t.size() - first);
    if (count == 0 || !ahead_.holds(first, times.subspan(done, count))) return false;
    std::copy_n(&ahead_.u[first * dof_], count * dof_, &u_reference_[done * dof_]);
    std::copy_n(&ahead_.v[first * dof_], count * dof_, &v_reference_[done * dof_]);
    done += count;
  }
  return true;
}

StateRows ErrorSink::reference_at(std::span<const double> times) {
  const auto size = times.size() * dof_;
  const model::SampleBuffers out{{u_reference_.data(), size}, {v_reference_.data(), size}, {}};
  if (options_.states != nullptr) {
    if (options_.states->holds(taken_, times)) {
      const auto part = [&](const std::vector<double>& all) {
        return std::span(all).subspan(taken_ * dof_, size);
      };
      return {part(options_.states->u), part(options_.states->v)};
    }
  } else if (options_.steps > 0 && dof_ <= 2 && copy_ahead(times)) {
    return {out.u, out.v};
  }
  // A run that was at other times once is sampled at all that follow.
  options_.states = nullptr;
  options_.steps = 0;
  // start + n h may pass the end by a rounding of the product and one of the sum.
  const double end = reference_.end(), slack = 4.0 * std::numeric_limits<double>::epsilon() * end;
  for (std::size_t i = 0; i < times.size(); ++i)
    times_[i] = times[i] > end && times[i] <= end + slack ? end : times[i];
  reference_.sample({times_.data(), times.size()}, model::Side::right, out);
  return {out.u, out.v};
}

bool ErrorSink::take(const model::SampleBlock& block) {
  if (std::size_t(block.dof) != dof_)
    refuse(sink_name, "masses of the block", double(block.dof), "as many as the reference has", {},
           "wrong-size");
  for (std::size_t from = 0; from < block.t.size(); from += sink_block)
    take_part(block, from, std::min(sink_block, block.t.size() - from));
  return true;
}

void ErrorSink::take_part(const model::SampleBlock& block, std::size_t from, std::size_t count) {
  const auto t = block.t.subspan(from, count);
  const auto u = block.u.subspan(from * dof_, count * dof_);
  const auto v = block.v.subspan(from * dof_, count * dof_);
  const auto reference = reference_at(t);
  taken_ += count;
  meter_.take(t, {u, v}, reference);
  if (options_.history_bins == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < dof_; ++j)
      relative_[j] = std::abs(u[i * dof_ + j] - reference.u[i * dof_ + j]) /
                     meter_.scales().peak.u[Eigen::Index(j)];
    history_.take(t[i], relative_);
  }
}

bool ErrorSink::take(const model::ReportedImpact& impact) {
  meter_.take(impact);
  impacts_.take(impact.t, rests_in_contact(reference_, contacts_, impact.contact, impact.t),
                impact.contact);
  return true;
}

RunScore ErrorSink::score(const model::Outcome& outcome) const {
  auto score = meter_.score();
  score.step = step_;
  score.finished = outcome.finished;
  if (outcome.failed()) {
    score.failure_code = outcome.reason.name();
    score.failure = outcome.detail;
  }
  score.work = outcome.work;
  if (options_.impacts_are_reported)
    score.impacts = impacts_.score(meter_.last(), score.rounding_floor);
  return score;
}

}  // namespace clackers::measure
