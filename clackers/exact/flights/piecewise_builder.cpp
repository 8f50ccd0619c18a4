#include "clackers/exact/flights/piecewise_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t most_flights = 100000;
constexpr double most_bytes = 2e9;

}  // namespace

PiecewiseMotion::Builder::Builder(const model::ImpactProblem<>& problem, PiecewiseMotion& motion)
    : problem_(problem), m_(motion), lcp_(problem.contacts.size()), contacts_(problem.contacts) {
  if (const auto* springs = model::one_sided_springs(problem)) {
    contacts_.insert(contacts_.end(), springs->contacts().begin(), springs->contacts().end());
    stiffnesses_ = springs->stiffnesses();
  }
}

void PiecewiseMotion::Builder::build() {
  std::vector<bool> compressed(stiffnesses_.size());
  regime(compressed);  // is checked first
  for (std::size_t j = 0; j < stiffnesses_.size(); ++j) {
    const auto& contact = contacts_[springs() + j];
    compressed[j] = contact.gap_at(problem_.start.u) < 0.0;
    const VectorXd response =
        m_.regimes_[0].derivative(1) * m_.regimes_[0].impulse(contact.direction);
    stiffest_ = std::max(stiffest_, std::sqrt(stiffnesses_[j] * contact.direction.dot(response)));
  }
  const auto n = m_.dof();
  const auto first = regime(compressed);
  begin(first, 0.0, m_.regimes_[first].state(problem_.start.u, problem_.start.v),
        MatrixXd::Zero(2 * n, 2 * n));
  // The start itself is given; what the change to modes rounds is that of a flight of no length.
  m_.flights_.back().covariance = m_.covariance_after(m_.flights_.back(), 0.0);
  is_closed_.assign(springs(), false);
  for (std::size_t i = 0; i < springs(); ++i) {
    const auto& contact = contacts_[i];
    const double size = contact.direction.cwiseAbs().dot(problem_.start.u.cwiseAbs());
    is_closed_[i] = std::abs(contact.gap_at(problem_.start.u)) <=
                    epsilon * double(n) * (size + std::abs(contact.gap));
  }
  for (;;) {
    const auto closings = next_contacts();
    if (switching_)
      change_regime();
    else if (!closings.empty())
      collide(closing_first(closings));
    else
      return;
  }
}

std::size_t PiecewiseMotion::Builder::regime(const std::vector<bool>& closed) {
  const auto known = std::ranges::find(closed_springs_, closed);
  if (known != closed_springs_.end()) return std::size_t(known - closed_springs_.begin());
  auto structure = problem_;
  if (!stiffnesses_.empty()) structure.system.nonlinear = {};
  std::vector<model::HarmonicForce> forces;
  if (const auto* load = problem_.system.add_load.target<model::HarmonicLoad>())
    forces = load->forces();
  for (std::size_t j = 0; j < closed.size(); ++j) {
    if (!closed[j]) continue;
    const auto& [b, gap, restitution] = contacts_[springs() + j];
    structure.system.stiffness += stiffnesses_[j] * b * b.transpose();
    for (Index i = 0; i < b.size(); ++i)
      if (const double force = stiffnesses_[j] * gap * b[i]; force != 0.0)
        forces.push_back({int(i), force, 0.0, 0.0});
  }
  if (std::ranges::count(closed, true) > 0 && !forces.empty())
    structure.system.add_load = model::HarmonicLoad(std::move(forces));
  const auto& modes = m_.regimes_.emplace_back(structure, m_.who_);
  std::vector<Row> rows;
  for (const auto& contact : contacts_) {
    Row row{MatrixXd(2 * modes.dof(), 4), modes.impulse(contact.direction)};
    for (int order = 0; order < 4; ++order)
      row.by_state.col(order) = modes.derivative(order).transpose() * contact.direction;
    rows.push_back(std::move(row));
  }
  rows_.push_back(std::move(rows));
  closed_springs_.push_back(closed);
  return closed_springs_.size() - 1;
}

void PiecewiseMotion::Builder::change_regime() {
  const auto [contact, s] = *std::exchange(switching_, std::nullopt);
  auto closed = closed_springs_[flight().regime];
  closed[contact - springs()].flip();
  const auto next = regime(closed);
  const auto &before = modes(), &after = m_.regimes_[next];
  const double t = flight().t + s;
  const auto changed = [&](const VectorXd& z) {
    return after.state(before.derivative(0) * z, before.derivative(1) * z);
  };
  const Index n = before.dof();
  MatrixXd map(2 * n, 2 * n);
  for (Index i = 0; i < 2 * n; ++i) map.col(i) = changed(VectorXd::Unit(2 * n, i));
  const VectorXd z = changed(m_.total(flight(), t));
  begin(next, t, z, map * m_.covariance_after(flight(), s) * map.transpose());
  m_.flights_.back().covariance = m_.covariance_after(m_.flights_.back(), 0.0);
  is_closed_.assign(springs(), false);
  if (closed[contact - springs()]) m_.spring_contacts_.push_back(t);
}

void PiecewiseMotion::Builder::begin(std::size_t regime, double t, const VectorXd& z,
                                     MatrixXd covariance) {
  const double bytes = 8.0 * double(covariance.size()) * double(m_.flights_.size() + 1);
  if (m_.flights_.size() >= most_flights || bytes > most_bytes)
    throw InputError(
        fmt::format(
            "{}: {} impacts up to t = {:.6g} s, and {:.2g} GB for their errors; allowed: 1e5 "
            "impacts and 2 GB. Impacts may accumulate there; end the run earlier.",
            m_.who_, m_.flights_.size(), t, bytes * 1e-9),
        "out-of-memory");
  m_.flights_.push_back({t, regime, z - m_.regimes_[regime].steady(t), std::move(covariance)});
}

PiecewiseMotion::PiecewiseMotion(const model::ImpactProblem<>& problem, std::string_view who)
    : who_(who), end_(problem.end) {
  validate(problem);
  if (problem.start.t != 0.0) refuse(who, "start", problem.start.t, "t = 0");
  const auto& contacts = problem.contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &b = contacts[i].direction, &c = contacts[j].direction;
      if (b.dot(c) >= (1.0 - 4.0 * epsilon) * b.norm() * c.norm())
        throw InputError(
            fmt::format("{}: contacts {} and {} have the same direction; allowed: contacts "
                        "of which none makes another redundant. Leave one out.",
                        who, j + 1, i + 1),
            "redundant-contacts");
    }
  Builder(problem, *this).build();
}

model::ImpactProblem<> with_springs(model::ImpactProblem<> problem, double stiffness) {
  constexpr auto who = "penalized motion";
  require_positive(who, "stiffness", stiffness);
  for (const auto& contact : problem.contacts)
    if (contact.restitution != 1.0)
      refuse(who, "restitution", contact.restitution, "1, since a linear spring is elastic", {},
             "penalty-needs-elastic");
  std::vector<double> stiffnesses(problem.contacts.size(), stiffness);
  problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
      std::exchange(problem.contacts, {}), std::move(stiffnesses));
  return problem;
}

}  // namespace clackers::exact
