// The modal systems of a piecewise motion: which contacts are held, which springs closed.
#include <algorithm>
#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/exact/flights/held_contacts.hpp"
#include "clackers/exact/flights/idle_contacts.hpp"
#include "clackers/exact/flights/piecewise_builder.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/double_double.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Of a force that is 0 in every motion rounding alone is left.
bool is_nearly_zero(const ForcedModes::Observable& seen) {
  constexpr double small = 1e-9;
  double response = 0.0, size = 0.0;
  for (std::size_t i = 0; i < seen.response.size(); ++i) {
    response += std::abs(seen.response[i]);
    size += seen.direct_size[i];
  }
  return (seen.by_state.col(0).array().abs() <= small * seen.size.array()).all() &&
         std::abs(seen.constant) <= small * seen.constant_size && response <= small * size;
}

}  // namespace

std::size_t PiecewiseMotion::Builder::regime(const std::vector<bool>& closed) {
  const auto known = std::ranges::find(closed_, closed);
  if (known != closed_.end()) return std::size_t(known - closed_.begin());
  auto structure = problem_;
  if (!stiffnesses_.empty()) structure.system.nonlinear = {};
  std::vector<model::HarmonicForce> forces;
  if (const auto* load = problem_.system.add_load.target<model::HarmonicLoad>())
    forces = load->forces();
  std::vector<std::size_t> held;
  ForcedModes::Rest rest{MatrixXd::Zero(problem_.dof(), problem_.dof()),
                         VectorXd::Zero(problem_.dof())};
  if (closed.back()) structure.system.damping *= law_.damping_after_impact;
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    if (!closed[j]) continue;
    if (j < springs()) {
      held.push_back(j);
      continue;
    }
    const auto& [b, gap, restitution] = contacts_[j];
    const double stiffness = stiffnesses_[j - springs()];
    for (Index row = 0; row < b.size(); ++row)
      for (Index column = 0; column < b.size(); ++column) {
        if (b[row] == 0.0 || b[column] == 0.0) continue;
        auto& entry = structure.system.stiffness(row, column);
        const auto sum = numerics::DoubleDouble{entry, rest.stiffness(row, column)} +
                         numerics::two_product(stiffness, b[row]) * b[column];
        entry = sum.hi;
        rest.stiffness(row, column) = sum.lo;
      }
    for (Index i = 0; i < b.size(); ++i)
      if (const auto force = numerics::two_product(stiffness, gap) * b[i]; force.hi != 0.0) {
        forces.push_back({int(i), force.hi, 0.0, 0.0});
        rest.force[i] += force.lo;
      }
  }
  if (!forces.empty()) structure.system.add_load = model::HarmonicLoad(std::move(forces));
  const auto constrained = constraint(held);
  const auto& modes =
      m_.regimes_.emplace_back(structure, m_.who_, constrained.basis, constrained.offset, rest,
                               m_.has_bounds_ && problem_.dof() > most_masses_of_balls);
  const VectorXd none = VectorXd::Zero(m_.dof());
  std::vector<Row> rows;
  for (const auto& contact : contacts_)
    rows.push_back({modes.observe(contact.direction, none, none, none, -contact.gap),
                    modes.impulse(contact.direction)});
  rows_.push_back(std::move(rows));
  auto& of_contacts = m_.forces_.emplace_back(springs());
  for (std::size_t k = 0; k < held.size(); ++k) {
    const VectorXd need = constrained.forces.row(Index(k)).transpose();
    of_contacts[held[k]] = modes.observe(modes.stiffness() * need, modes.damping() * need,
                                         modes.mass() * need, -need, 0.0);
    auto& force = *of_contacts[held[k]];
    if (is_nearly_zero(force) && !closed.back() && is_never_pressed(problem_, closed, held[k]))
      force = modes.observe(none, none, none, none, 0.0);
  }
  closed_.push_back(closed);
  return closed_.size() - 1;
}

auto PiecewiseMotion::Builder::constraint(const std::vector<std::size_t>& contacts) const
    -> Constraint {
  std::vector<model::Contact<>> held;
  for (const auto i : contacts) held.push_back(contacts_[i]);
  const Index n = problem_.dof(), count = std::ssize(contacts);
  const HeldContacts<double> solved(held, std::size_t(n), [](double x) { return std::abs(x); });
  Constraint found{MatrixXd::Zero(n, n - count), MatrixXd::Zero(count, n), VectorXd::Zero(n)};
  Index column = 0;
  for (Index i = 0; i < n; ++i) {
    if (solved.is_pivot[std::size_t(i)]) continue;
    found.basis(i, column) = 1.0;
    for (std::size_t k = 0; k < held.size(); ++k)
      found.basis(Index(solved.pivots[k]), column) = -solved.shares[k][std::size_t(i)];
    ++column;
  }
  for (std::size_t k = 0; k < held.size(); ++k) {
    const auto pivot = Index(solved.pivots[k]);
    found.offset[pivot] = solved.gaps[k];
    for (Index j = 0; j < count; ++j) found.forces(j, pivot) = solved.inverse[k][std::size_t(j)];
  }
  return found;
}

std::size_t PiecewiseMotion::Builder::with_held(std::size_t regime,
                                                const std::vector<std::size_t>& contacts,
                                                bool held) {
  auto closed = closed_[regime];
  for (const auto i : contacts) closed[i] = held;
  return this->regime(closed);
}

std::size_t PiecewiseMotion::Builder::after_impact(std::size_t regime) {
  if (law_.damping_after_impact == 1.0) return regime;
  auto closed = closed_[regime];
  closed.back() = true;
  return this->regime(closed);
}

void PiecewiseMotion::Builder::change_regime() {
  const auto [contact, s] = *std::exchange(switching_, std::nullopt);
  const auto now = flight().regime;
  std::vector<Closing> closings{{contact, s}};
  State state = arrived(closings);
  const double t = state.t;
  if (!is_spring(contact)) {
    passed_[contact] = false;
    opens_[contact] = Begin::by_speed;
    return begin(std::move(state));
  }
  const double time_error =
      error_of(contact, s) / std::abs(watch(contact, s).slope) + 4.0 * epsilon * t;
  m_.flights_.back().ends = Event{{t - time_error, t + time_error}, {contact}};
  auto closed = closed_[now];
  closed[contact].flip();
  begin(seen_in(regime(closed), state));
  m_.flights_.back().errors = m_.errors_after(flight(), 0.0);
  if (closed[contact]) m_.spring_contacts_.push_back(t);
}

}  // namespace clackers::exact
