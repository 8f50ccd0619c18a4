#include "clackers/methods/engines/constrained_motion.hpp"

#include <algorithm>
#include <utility>

#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::methods {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

std::span<const double> entries_of(const VectorXd& x) { return {x.data(), std::size_t(x.size())}; }

}  // namespace

void ConstrainedMotion::to_modes(std::span<const double> u, std::span<const double> v,
                                 std::span<numerics::ModalState> states) const {
  if (rest.isZero(0.0)) return modes.to_modes(u, v, states);
  from_rest_ = Eigen::Map<const VectorXd>(u.data(), rest.size()) - rest;
  modes.to_modes(entries_of(from_rest_), v, states);
}

void ConstrainedMotion::sample(std::span<const numerics::ModalState> start, double s,
                               std::span<double> u, std::span<double> v) const {
  modes.sample(start, s, u, v);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += rest[Index(i)];
}

ConstrainedMotions::ConstrainedMotions(const MatrixXd& mass, const MatrixXd& damping,
                                       const MatrixXd& stiffness, const MatrixXd& rows,
                                       const VectorXd& gaps)
    : mass_(mass), damping_(damping), stiffness_(stiffness), rows_(rows), gaps_(gaps) {}

const ConstrainedMotion* ConstrainedMotions::of(const std::vector<bool>& is_active) {
  for (const auto& motion : made_)
    if (motion->is_active == is_active) return motion.get();
  auto motion = make(is_active);
  if (!motion) return nullptr;
  made_.push_back(std::make_unique<const ConstrainedMotion>(std::move(*motion)));
  return made_.back().get();
}

std::optional<ConstrainedMotion> ConstrainedMotions::make(
    const std::vector<bool>& is_active) const {
  const Index n = mass_.rows(), active = std::ranges::count(is_active, true);
  ConstrainedMotion motion;
  motion.is_active = is_active;
  motion.rest = VectorXd::Zero(n);
  MatrixXd force_rows(active, n);  // contact forces are these times K u + C v
  if (active == 0) {
    auto modes = numerics::ModalSystem::make(mass_, damping_, stiffness_);
    if (!modes) return std::nullopt;
    motion.modes = std::move(*modes);
  } else {
    MatrixXd b(active, n);
    VectorXd gaps(active);
    for (Index i = 0, row = 0; i < rows_.rows(); ++i)
      if (is_active[std::size_t(i)]) {
        b.row(row) = rows_.row(i);
        gaps[row++] = gaps_[i];
      }
    const MatrixXd response = numerics::solved(mass_, b.transpose());
    const MatrixXd delassus = b * response;
    force_rows = numerics::shortest_solution(delassus, response.transpose());
    // Directions that keep the contacts closed.
    const MatrixXd basis = numerics::unseen_directions(b, mass_);
    const MatrixXd inverse = basis.transpose() * mass_;
    const MatrixXd stiffness = basis.transpose() * stiffness_ * basis;
    auto modes = numerics::ModalSystem::make(MatrixXd::Identity(n - active, n - active),
                                             basis.transpose() * damping_ * basis, stiffness);
    if (!modes) return std::nullopt;
    motion.modes = modes->seen_through(basis, inverse);
    if (!gaps.isZero(0.0)) {
      motion.rest = response * numerics::shortest_solution(delassus, gaps);
      if (active < n)
        motion.rest -= basis * numerics::shortest_solution(
                                   stiffness, basis.transpose() * (stiffness_ * motion.rest));
    }
  }
  for (Index i = 0, row = 0; i < rows_.rows(); ++i) {
    if (!is_active[std::size_t(i)]) {
      const VectorXd b = rows_.row(i);
      motion.forms.emplace_back(motion.modes, entries_of(b), std::span<const double>(),
                                b.dot(motion.rest) - gaps_[i]);
      continue;
    }
    const VectorXd weights = force_rows.row(row++);
    const VectorXd by_u = stiffness_ * weights, by_v = damping_ * weights;
    motion.forms.emplace_back(motion.modes, entries_of(by_u), entries_of(by_v),
                              by_u.dot(motion.rest));
  }
  return motion;
}

}  // namespace clackers::methods
