#include "clackers/measure/metrics/definitions.hpp"

#include <cmath>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/meter.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {
namespace {

struct Columns {
  std::span<const double> found, reference;
};

Columns columns_of(const Comparison& comparison, Component quantity) {
  switch (quantity) {
    case Component::u:
      return {comparison.history().u, comparison.reference_u()};
    case Component::v:
      return {comparison.history().v, comparison.reference_v()};
    case Component::a:
      return {comparison.history().a, comparison.reference_a()};
  }
  return {};
}

// The four norms of one quantity, mass by mass.
struct Norms {
  std::vector<double> max, l1, l2, end;

  const std::vector<double>& of(Norm norm) const {
    return norm == Norm::max ? max : norm == Norm::l1 ? l1 : norm == Norm::l2 ? l2 : end;
  }
};

// The integrals of |e| and e^2 of a quantity that is continuous.
void integrate(const Comparison& comparison, const Columns& columns, Norms& norms) {
  const auto& t = comparison.history().t;
  const auto dof = comparison.dof();
  std::vector<double> last(dof);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double half = i > 0 ? 0.5 * (t[i] - t[i - 1]) : 0.0;
    for (std::size_t j = 0; j < dof; ++j) {
      const double error = std::abs(columns.found[i * dof + j] - columns.reference[i * dof + j]);
      norms.l1[j] += half * (last[j] + error);
      norms.l2[j] += half * (last[j] * last[j] + error * error);
      last[j] = error;
    }
  }
}

// The same of accelerations: a history with them has the limits of its jumps as rows. A jump is an
// instant between output times; at the ends of the history it is an output time as well.
VelocityError integrate_accelerations(const Comparison& comparison, const Columns& columns) {
  const auto& t = comparison.history().t;
  const auto dof = comparison.dof();
  VelocityError error(comparison.reference(), JumpingQuantity::acceleration);
  const auto row = [dof](std::span<const double> all, std::size_t i) {
    return all.subspan(i * dof, dof);
  };
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool left = comparison.is_left_limit(i), right = comparison.is_right_limit(i);
    if ((!left && !right) || (left && i == 0) || (right && i + 1 == t.size()))
      error.take(t[i], row(columns.found, i), row(columns.reference, i));
    if (left)
      error.take(model::ReportedImpact{
          t[i], 0, {}, row(columns.found, i), row(columns.found, i + 1), 0.0});
  }
  return error;
}

void integrate(const VelocityError& error, Norms& norms) {
  for (std::size_t j = 0; j < norms.l1.size(); ++j) {
    norms.l1[j] = error.integral(int(j));
    norms.l2[j] = error.integral_of_square(int(j));
  }
}

template <Component quantity>
Norms norms_of(const Comparison& comparison) {
  const auto columns = columns_of(comparison, quantity);
  const auto dof = comparison.dof();
  const std::vector<double> zeros(dof);
  Norms norms{zeros, zeros, zeros, zeros};
  if constexpr (quantity == Component::u)
    norms.max.assign(comparison.meter().u_errors().begin(), comparison.meter().u_errors().end());
  else
    for (std::size_t i = 0; i < columns.found.size(); ++i)
      norms.max[i % dof] =
          std::max(norms.max[i % dof], std::abs(columns.found[i] - columns.reference[i]));
  const auto last = columns.found.size() - dof;
  for (std::size_t j = 0; j < dof; ++j)
    norms.end[j] = std::abs(columns.found[last + j] - columns.reference[last + j]);
  if constexpr (quantity == Component::u)
    integrate(comparison, columns, norms);
  else if constexpr (quantity == Component::v)
    integrate(comparison.meter().velocity(), norms);
  else
    integrate(integrate_accelerations(comparison, columns), norms);
  const double length = comparison.history().t.back() - comparison.history().t.front();
  for (double& mean : norms.l1) mean /= length;
  for (double& mean : norms.l2) mean = std::sqrt(mean / length);
  return norms;
}

}  // namespace

MetricValue norm_error(const Comparison& comparison, Component quantity, Norm norm) {
  switch (quantity) {
    case Component::u:
      return measured(comparison.shared(norms_of<Component::u>).of(norm));
    case Component::v:
      if (!comparison.has_velocities()) return not_measured(Comparison::no_velocities);
      return measured(comparison.shared(norms_of<Component::v>).of(norm));
    case Component::a:
      break;
  }
  if (!comparison.has_accelerations()) return not_measured("The history has no accelerations.");
  return measured(comparison.shared(norms_of<Component::a>).of(norm));
}

MetricValue relative_norm_error(const Comparison& comparison, Component quantity, Norm norm) {
  const auto envelope = quantity == Component::u   ? comparison.u_envelope()
                        : quantity == Component::v ? comparison.v_envelope()
                                                   : comparison.a_envelope();
  return relative_to(norm_error(comparison, quantity, norm), envelope);
}

}  // namespace clackers::measure
