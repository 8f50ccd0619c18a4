#include "clackers/model/first_order.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::model {
namespace {

using Eigen::VectorXd;
using Constant = Eigen::Map<const VectorXd>;

}  // namespace

FirstOrder::FirstOrder(const ImpactProblem<>& problem)
    : problem_(problem), mass_(problem.system.mass) {}

void FirstOrder::rate(double t, std::span<const double> y, std::span<double> rate) const {
  if (!problem_.frictions.empty())
    throw InputError(
        "problem: dry friction has any force within its limit where nothing slides, so that no rate "
        "follows from the state; allowed: problems without friction. Use M, C, K and the frictions of the "
        "problem itself.",
        "linear-only");
  const auto& system = problem_.system;
  const auto dof = problem_.dof();
  const Constant u(y.data(), dof), v(y.data() + dof, dof);
  VectorXd force = VectorXd::Zero(dof);
  if (system.add_load) system.add_load(t, {force.data(), std::size_t(dof)});
  force -= system.damping * v + system.stiffness * u;
  if (system.nonlinear) {
    VectorXd internal = VectorXd::Zero(dof);
    system.nonlinear->add(u, v, internal);
    force -= internal;
  }
  mass_.solveInPlace(force);
  Eigen::Map<VectorXd> out(rate.data(), 2 * dof);
  out << v, force;
}

double FirstOrder::gap(std::span<const double> y, std::size_t contact) const {
  return contact_at(contact).gap_at(Constant(y.data(), problem_.dof()));
}

void FirstOrder::impact(std::span<const double> y, std::optional<std::size_t> contact,
                        std::span<double> after) const {
  const auto dof = problem_.dof();
  const Constant u(y.data(), dof), v(y.data() + dof, dof);
  const auto& closed = contact_at(contact ? *contact : nearest_contact(y));
  const double gap_rate = closed.gap_rate(v);
  if (gap_rate > 0.0)
    refuse("impact", "b . v", gap_rate, "b . v <= 0 m/s, a gap that closes",
           "In this state the impact has already happened, or the event was found while the gap "
           "opens.");
  const VectorXd response = mass_.solve(closed.direction);
  const double change = (1.0 + closed.restitution) * gap_rate / closed.direction.dot(response);
  Eigen::Map<VectorXd> out(after.data(), 2 * dof);
  out << u, v - change * response;
}

const Contact<>& FirstOrder::contact_at(std::size_t number) const {
  const auto& contacts = problem_.contacts;
  if (contacts.empty())
    refuse("problem", "contact", double(number), "none: this problem has no contact");
  if (number >= contacts.size())
    refuse("problem", "contact", double(number),
           fmt::format("0 <= contact <= {}, the last of this problem", contacts.size() - 1));
  return contacts[number];
}

std::size_t FirstOrder::nearest_contact(std::span<const double> y) const {
  std::size_t nearest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t number = 0; number < problem_.contacts.size(); ++number)
    if (const double distance = std::abs(gap(y, number)); distance < smallest) {
      nearest = number;
      smallest = distance;
    }
  return nearest;
}

}  // namespace clackers::model
