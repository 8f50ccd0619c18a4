#include "clackers/measure/errors/error_sink.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/measure/errors/comparison.hpp"

namespace clackers::measure {
namespace {

constexpr auto sink_name = "error sink";
constexpr std::size_t block_size = 256;

// The largest of the reference over the run: that at the start, unless it has none there or a load
// brings some; then the largest at 1024 equal parts.
double energy_scale(const MechanicalEnergy& energy, const model::Motion& reference, double start,
                    bool is_loaded) {
  const auto at = [&](double t) {
    const auto now = reference.at(t, model::Side::right);
    return energy.total(now.u.data(), now.v.data());
  };
  double scale = at(start);
  constexpr int parts = 1024;
  if (is_loaded || !(scale > 0.0))
    for (int i = 1; i <= parts; ++i) scale = std::max(scale, at(reference.end() * i / parts));
  return require_positive(sink_name, "energy of the reference", scale);
}

}  // namespace

ErrorSink::ErrorSink(const model::Motion& reference, const model::ImpactProblem<>& problem,
                     double step, const ErrorSinkOptions& options)
    : reference_(reference),
      dof_(std::size_t(reference.dof())),
      step_(require_step(sink_name, step)),
      options_(options),
      contacts_(problem.contacts),
      energy_(problem.system),
      scale_(reference.peak()),
      start_(problem.start.t),
      times_(block_size),
      u_reference_(block_size * dof_),
      v_reference_(block_size * dof_),
      relative_(dof_),
      u_error_(dof_),
      last_(start_),
      velocity_(reference),
      impacts_(reference, step, 0.0, int(problem.contacts.size())),
      history_(options.history_bins, reference.dof(), problem.start.t, problem.end) {
  if (problem.dof() != reference.dof())
    refuse(sink_name, "masses of the problem", double(problem.dof()),
           "as many as the reference has", {}, "wrong-size");
  for (const double scale : scale_.u) require_positive(sink_name, "envelope of u", scale);
  for (const double scale : scale_.v) require_positive(sink_name, "envelope of v", scale);
  energy_scale_ = energy_scale(energy_, reference, start_, bool(problem.system.add_load));
}

void ErrorSink::sample_reference(std::span<const double> times) {
  // start + n h may pass the end by a rounding of the product and one of the sum.
  const double end = reference_.end(), slack = 4.0 * std::numeric_limits<double>::epsilon() * end;
  for (std::size_t i = 0; i < times.size(); ++i)
    times_[i] = times[i] > end && times[i] <= end + slack ? end : times[i];
  const auto size = times.size() * dof_;
  reference_.sample({times_.data(), times.size()}, model::Side::right,
                    {{u_reference_.data(), size}, {v_reference_.data(), size}, {}});
}

bool ErrorSink::take(const model::SampleBlock& block) {
  if (std::size_t(block.dof) != dof_)
    refuse(sink_name, "masses of the block", double(block.dof), "as many as the reference has", {},
           "wrong-size");
  for (std::size_t from = 0; from < block.t.size(); from += block_size)
    take_part(block, from, std::min(block_size, block.t.size() - from));
  return true;
}

void ErrorSink::take_part(const model::SampleBlock& block, std::size_t from, std::size_t count) {
  const auto t = block.t.subspan(from, count);
  const auto u = block.u.subspan(from * dof_, count * dof_);
  const auto v = block.v.subspan(from * dof_, count * dof_);
  sample_reference(t);
  velocity_.take(t, v, v_reference_);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i * dof_;
    for (std::size_t j = 0; j < dof_; ++j) {
      const double error = std::abs(u[row + j] - u_reference_[row + j]);
      u_error_[j] = std::max(u_error_[j], error);
      // The difference of a number that is not finite and itself is NaN.
      finite_ += (error - error) + (v[row + j] - v[row + j]);
    }
    const double found = energy_.total(&u[row], &v[row]);
    const double expected = energy_.total(&u_reference_[row], &v_reference_[row]);
    energy_error_ = std::max(energy_error_, std::abs(found - expected));
    energy_ratio_ = expected > 0.0 ? found / expected : std::numeric_limits<double>::quiet_NaN();
    if (options_.history_bins > 0) {
      for (std::size_t j = 0; j < dof_; ++j)
        relative_[j] = std::abs(u[row + j] - u_reference_[row + j]) / scale_.u[Eigen::Index(j)];
      history_.take(t[i], relative_);
    }
  }
  last_ = t.back();
  bound_ = std::max(bound_, relative_bound(reference_, scale_, last_));
  states_ += static_cast<long long>(count);
}

bool ErrorSink::take(const model::ReportedImpact& impact) {
  velocity_.take(impact);
  impacts_.take(impact.t, rests_in_contact(reference_, contacts_, impact.contact, impact.t),
                impact.contact);
  return true;
}

RunScore ErrorSink::score(const model::Outcome& outcome) const {
  RunScore score;
  score.step = step_;
  score.finished = outcome.finished;
  if (outcome.failed()) {
    score.failure_code = outcome.reason.name();
    score.failure = outcome.detail;
  }
  score.work = outcome.work;
  score.energy_error = energy_error_ / energy_scale_;
  score.energy_ratio = energy_ratio_;
  // Each step rounds the state by about one unit; at worst they all add up.
  score.rounding_floor = std::max(std::numeric_limits<double>::epsilon() * double(states_), bound_);
  const double length = last_ - start_;
  for (std::size_t j = 0; j < dof_; ++j) {
    const auto mass = Eigen::Index(j);
    score.u_error_absolute = std::max(score.u_error_absolute, u_error_[j]);
    score.u_error = std::max(score.u_error, u_error_[j] / scale_.u[mass]);
    if (length > 0.0)
      score.v_error =
          std::max(score.v_error, velocity_.integral(int(j)) / (length * scale_.v[mass]));
  }
  if (finite_ != 0.0)
    score.u_error = score.u_error_absolute = score.v_error = score.energy_error = infinity;
  if (options_.impacts_are_reported) score.impacts = impacts_.score(last_, score.rounding_floor);
  return score;
}

}  // namespace clackers::measure
