#include "clackers/assess/metrics/norm_error.hpp"

#include <cmath>

#include "clackers/assess/errors/velocity_error.hpp"
#include "clackers/assess/metrics/value.hpp"

namespace clackers::assess {
namespace {

struct Pair {
  std::span<const double> found, reference;
};

Pair columns(const Comparison& comparison, Quantity quantity) {
  switch (quantity) {
    case Quantity::u:
      return {comparison.history().u, comparison.true_u()};
    case Quantity::v:
      return {comparison.history().v, comparison.true_v()};
    case Quantity::a:
      return {comparison.history().a, comparison.true_a()};
  }
  return {};
}

std::vector<double> largest(const Pair& pair, std::size_t dof) {
  std::vector<double> errors(dof);
  for (std::size_t i = 0; i < pair.found.size(); i += dof)
    for (std::size_t j = 0; j < dof; ++j)
      errors[j] = std::max(errors[j], std::abs(pair.found[i + j] - pair.reference[i + j]));
  return errors;
}

std::vector<double> last(const Pair& pair, std::size_t dof) {
  std::vector<double> errors(dof);
  const auto row = pair.found.size() - dof;
  for (std::size_t j = 0; j < dof; ++j)
    errors[j] = std::abs(pair.found[row + j] - pair.reference[row + j]);
  return errors;
}

// Integral of |e|^power of a quantity that is continuous.
std::vector<double> integral(const Comparison& comparison, const Pair& pair, Norm norm) {
  const auto& t = comparison.history().t;
  const auto dof = comparison.dof();
  std::vector<double> sum(dof);
  const auto height = [&](std::size_t at) {
    const double error = std::abs(pair.found[at] - pair.reference[at]);
    return norm == Norm::l1 ? error : error * error;
  };
  for (std::size_t i = 1; i < t.size(); ++i)
    for (std::size_t j = 0; j < dof; ++j)
      sum[j] += 0.5 * (t[i] - t[i - 1]) * (height((i - 1) * dof + j) + height(i * dof + j));
  return sum;
}

// The same of one that jumps.
std::vector<double> integral_across_jumps(const Comparison& comparison, const Pair& pair,
                                          Quantity quantity, Norm norm) {
  const auto& t = comparison.history().t;
  const auto dof = comparison.dof();
  VelocityError error(comparison.reference(), quantity == Quantity::v
                                                  ? JumpingQuantity::velocity
                                                  : JumpingQuantity::acceleration);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto found = pair.found.subspan(i * dof, dof),
               reference = pair.reference.subspan(i * dof, dof);
    if (!comparison.is_left_limit(i)) {
      error.take(t[i], found, reference);
      continue;
    }
    // A jump is an instant of its own between own times. At the ends of the history there is
    // nothing beyond, so that it is an own time as well.
    const auto after = pair.found.subspan((i + 1) * dof, dof);
    if (i == 0) error.take(t[i], found, reference);
    error.take(model::ReportedImpact{t[i], 0, {}, found, after, 0.0});
    ++i;
    if (i + 1 == t.size()) error.take(t[i], after, pair.reference.subspan(i * dof, dof));
  }
  std::vector<double> sum(dof);
  for (std::size_t j = 0; j < dof; ++j)
    sum[j] = norm == Norm::l1 ? error.integral(int(j)) : error.integral_of_square(int(j));
  return sum;
}

}  // namespace

MetricValue norm_error(const Comparison& comparison, Quantity quantity, Norm norm) {
  const auto pair = columns(comparison, quantity);
  if (pair.found.empty())
    return not_measured(quantity == Quantity::v ? "The history has no velocities."
                                                : "The history has no accelerations.");
  if (norm == Norm::max) return measured(largest(pair, comparison.dof()));
  if (norm == Norm::end) return measured(last(pair, comparison.dof()));
  auto sum = quantity == Quantity::u ? integral(comparison, pair, norm)
                                     : integral_across_jumps(comparison, pair, quantity, norm);
  const auto& t = comparison.history().t;
  for (double& entry : sum) {
    entry /= t.back() - t.front();
    if (norm == Norm::l2) entry = std::sqrt(entry);
  }
  return measured(std::move(sum));
}

MetricValue relative_norm_error(const Comparison& comparison, Quantity quantity, Norm norm) {
  const auto envelope = quantity == Quantity::u   ? comparison.u_envelope()
                        : quantity == Quantity::v ? comparison.v_envelope()
                                                  : comparison.a_envelope();
  return relative_to(norm_error(comparison, quantity, norm), envelope);
}

}  // namespace clackers::assess
