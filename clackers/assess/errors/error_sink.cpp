#include "clackers/assess/errors/error_sink.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/assess/impacts/contact_rest.hpp"
#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

constexpr auto who = "error sink";
constexpr std::size_t block_size = 256;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> positive_entries(std::string_view name, const Eigen::VectorXd& vector) {
  std::vector<double> entries;
  for (const double entry : vector) entries.push_back(require_positive(who, name, entry));
  return entries;
}

}  // namespace

ErrorSink::ErrorSink(const model::Motion& reference, const model::ImpactProblem<>& problem,
                     double step, const ErrorSinkOptions& options)
    : reference_(reference),
      dof_(std::size_t(reference.dof())),
      step_(require_step(who, step)),
      options_(options),
      contacts_(problem.contacts),
      energy_(problem.system),
      u_envelope_(positive_entries("initial envelope of u", reference.envelope(0.0).u)),
      v_envelope_(positive_entries("initial envelope of v", reference.envelope(0.0).v)),
      start_(problem.start.t),
      times_(block_size),
      u_true_(block_size * dof_),
      v_true_(block_size * dof_),
      relative_(dof_),
      last_(start_),
      velocity_(reference),
      impacts_(reference, step),
      history_(options.history_bins, reference.dof(), problem.start.t, problem.end) {
  if (problem.dof() != reference.dof())
    refuse(who, "masses of the problem", double(problem.dof()), "as many as the true motion has",
           {}, "wrong-size");
  const auto at_start = reference.at(start_, model::Side::right);
  first_energy_ = require_positive(who, "true energy at the start",
                                   energy_.total(at_start.u.data(), at_start.v.data()));
}

void ErrorSink::sample_reference(std::span<const double> times) {
  // start + n h may pass the end by a rounding of the product and one of the sum.
  const double end = reference_.end(), slack = 4.0 * std::numeric_limits<double>::epsilon() * end;
  for (std::size_t i = 0; i < times.size(); ++i)
    times_[i] = times[i] > end && times[i] <= end + slack ? end : times[i];
  const auto size = times.size() * dof_;
  reference_.sample({times_.data(), times.size()}, model::Side::right,
                    {{u_true_.data(), size}, {v_true_.data(), size}, {}});
}

bool ErrorSink::take(const model::SampleBlock& block) {
  if (std::size_t(block.dof) != dof_)
    refuse(who, "masses of the block", double(block.dof), "as many as the true motion has", {},
           "wrong-size");
  for (std::size_t from = 0; from < block.t.size(); from += block_size) {
    if (!goes_on()) return false;
    take_part(block, from, std::min(block_size, block.t.size() - from));
  }
  return goes_on();
}

void ErrorSink::take_part(const model::SampleBlock& block, std::size_t from, std::size_t count) {
  sample_reference(block.t.subspan(from, count));
  for (std::size_t i = 0; i < count; ++i) {
    const double* u = block.u.data() + (from + i) * dof_;
    const double* v = block.v.data() + (from + i) * dof_;
    const double* u_true = u_true_.data() + i * dof_;
    const double* v_true = v_true_.data() + i * dof_;
    last_ = block.t[from + i];
    for (std::size_t j = 0; j < dof_; ++j) {
      const double error = std::abs(u[j] - u_true[j]);
      relative_[j] = error / u_envelope_[j];
      u_absolute_ = std::max(u_absolute_, error);
      u_error_ = std::max(u_error_, relative_[j]);
      finite_ = finite_ && std::isfinite(error) && std::isfinite(v[j]);
    }
    velocity_.take(last_, {v, dof_}, {v_true, dof_});
    const double found = energy_.total(u, v), expected = energy_.total(u_true, v_true);
    energy_error_ = std::max(energy_error_, std::abs(found - expected) / first_energy_);
    energy_ratio_ = expected > 0.0 ? found / expected : std::numeric_limits<double>::quiet_NaN();
    history_.take(last_, relative_);
  }
  states_ += static_cast<long long>(count);
}

bool ErrorSink::take(const model::ReportedImpact& impact) {
  velocity_.take(impact);
  impacts_.take(impact.t, rests_in_contact(reference_, contacts_, impact.contact, impact.t));
  return goes_on();
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
  score.u_error = finite_ ? u_error_ : infinity;
  score.u_error_absolute = finite_ ? u_absolute_ : infinity;
  score.energy_error = finite_ ? energy_error_ : infinity;
  score.energy_ratio = energy_ratio_;
  // Each step rounds the state by about one unit; at worst they all add up.
  score.rounding_floor = std::numeric_limits<double>::epsilon() * double(states_);
  const double length = last_ - start_;
  for (std::size_t j = 0; j < dof_; ++j)
    if (length > 0.0)
      score.v_error =
          std::max(score.v_error, velocity_.integral(int(j)) / (length * v_envelope_[j]));
  if (!finite_) score.v_error = infinity;
  if (options_.impacts_are_reported) score.impacts = impacts_.score(last_, score.rounding_floor);
  return score;
}

}  // namespace clackers::assess
