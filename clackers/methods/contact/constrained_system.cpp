#include "clackers/methods/contact/constrained_system.hpp"

#include <cmath>
#include <limits>

namespace clackers::methods {
namespace {

// The part of a step after which vanishing forces are looked at: enough for their trend to stand
// out from rounding, and too little for others to change.
constexpr double instant = 0x1p-20;

}  // namespace

// Q^T p(u, v); its tangents follow.
template <int Dof>
class ConstrainedSystem<Dof>::ProjectedForce : public model::NonlinearForce<Dof> {
 public:
  ProjectedForce(const model::NonlinearForce<Dof>& free, const Matrix& projector)
      : free_(free), projector_(projector) {}

  void add(const Vector& u, const Vector& v, Vector& p) const override {
    Vector whole = Vector::Zero(u.size());
    free_.add(u, v, whole);
    p += projector_.transpose() * whole;
  }

  void add_tangent(const Vector& u, const Vector& v, Matrix& dp_du, Matrix& dp_dv) const override {
    Matrix du = Matrix::Zero(u.size(), u.size()), dv = du;
    free_.add_tangent(u, v, du, dv);
    dp_du += projector_.transpose() * du;
    dp_dv += projector_.transpose() * dv;
  }

 private:
  const model::NonlinearForce<Dof>& free_;
  const Matrix& projector_;
};

template <int Dof>
ConstrainedSystem<Dof>::ConstrainedSystem(const model::SmoothSystem<Dof>& free,
                                          ContactSet<Dof>& contacts)
    : free_(free),
      contacts_(contacts),
      constrained_(free),
      is_active_(contacts.size(), false),
      factors_(contacts.size()) {
  damping_ = free.damping;
  stiffness_ = free.stiffness;
  damping_size_ = free.damping.cwiseAbs();
  stiffness_size_ = free.stiffness.cwiseAbs();
  const auto n = free.dof();
  projector_ = matrix_ = Matrix::Identity(n, n);
  constant_ = drift_ = force_ = size_ = part_ = Vector::Zero(n);
  active_.reserve(contacts.size());
  solution_ = forces_ = acceleration_ = rounding_ = earlier_ = contacts.no_impulses();
  constrained_.add_load = [this](double t, std::span<double> force) { add_load(t, force); };
  if (free.nonlinear)
    constrained_.nonlinear = std::make_shared<ProjectedForce>(*free.nonlinear, projector_);
}

template <int Dof>
void ConstrainedSystem<Dof>::activate(Rows contacts, const Vector& u) {
  active_.assign(contacts.begin(), contacts.end());
  project(u);
}

template <int Dof>
void ConstrainedSystem<Dof>::hold(Rows rows, const State& now) {
  activate(rows, now.u);
  if (active_.empty()) return;
  since_ = now.t;
  force_ = now.v;
  force_.noalias() -= projector_ * now.v;
  constant_.noalias() += free_.damping * force_;
  drift_.noalias() = free_.stiffness * force_;
}

template <int Dof>
std::optional<Objection> ConstrainedSystem<Dof>::decide(Rows resting, const State& now,
                                                        const State& later) {
  find_gap_accelerations(now);
  earlier_ = acceleration_;
  find_gap_accelerations(later);
  acceleration_ = earlier_ + instant * (acceleration_ - earlier_);
  if (auto no = contacts_.solve(contacts_.response(), resting, acceleration_, forces_)) return no;
  active_.clear();
  const auto& w = contacts_.response().delassus;
  for (const auto i : resting) {
    const double gap_acceleration = acceleration_[to_index(i)] + w.row(to_index(i)).dot(forces_);
    if (forces_[to_index(i)] > 0.0 || gap_acceleration <= rounding_[to_index(i)])
      active_.push_back(i);
  }
  project(now.u);
  return std::nullopt;
}

template <int Dof>
void ConstrainedSystem<Dof>::project(const Vector& u) {
  is_active_.assign(is_active_.size(), false);
  for (const auto i : active_) is_active_[i] = true;
  if (active_.empty()) return;
  projector_.setIdentity();
  factors_.compute(contacts_.response().delassus, active_);
  for (Eigen::Index column = 0; column < projector_.cols(); ++column) {
    for (std::size_t k = 0; k < active_.size(); ++k)
      solution_[to_index(k)] = contacts_.row(active_[k])[column];
    factors_.solve_in_place(solution_);
    for (std::size_t k = 0; k < active_.size(); ++k)
      projector_.col(column) -=
          solution_[to_index(k)] * contacts_.response().velocity.col(to_index(active_[k]));
  }
  matrix_.noalias() = free_.damping * projector_;
  constrained_.damping.noalias() = projector_.transpose() * matrix_;
  matrix_.noalias() = free_.stiffness * projector_;
  constrained_.stiffness.noalias() = projector_.transpose() * matrix_;
  force_ = u;
  force_.noalias() -= projector_ * u;
  constant_.noalias() = free_.stiffness * force_;
}

template <int Dof>
void ConstrainedSystem<Dof>::add_load(double t, std::span<double> force) {
  force_ = -constant_ - (t - since_) * drift_;
  if (free_.add_load)
    free_.add_load(t, std::span<double>(force_.data(), static_cast<std::size_t>(force_.size())));
  Eigen::Map<Vector> to(force.data(), force_.size());
  to.noalias() += projector_.transpose() * force_;
}

// With the rounding of their terms: some products a row.
template <int Dof>
void ConstrainedSystem<Dof>::find_gap_accelerations(const State& now) {
  force_.setZero();
  if (free_.add_load)
    free_.add_load(now.t,
                   std::span<double>(force_.data(), static_cast<std::size_t>(force_.size())));
  size_ = force_.cwiseAbs();
  if (free_.nonlinear) {
    force_ = -force_;
    free_.nonlinear->add(now.u, now.v, force_);
    force_ = -force_;
    size_ += force_.cwiseAbs();
  }
  damping_.subtract_product(now.v, force_);
  stiffness_.subtract_product(now.u, force_);
  part_ = now.v.cwiseAbs();
  damping_size_.add_product(part_, size_);
  part_ = now.u.cwiseAbs();
  stiffness_size_.add_product(part_, size_);
  const double unit = 8.0 * double(force_.size() + 1) * std::numeric_limits<double>::epsilon();
  const auto& velocity = contacts_.response().velocity;
  acceleration_.noalias() = velocity.transpose() * force_;
  rounding_.noalias() = unit * (velocity.cwiseAbs().transpose() * size_);
}

template <int Dof>
const Eigen::VectorXd& ConstrainedSystem<Dof>::contact_forces(const State& now) {
  find_gap_accelerations(now);
  for (std::size_t k = 0; k < active_.size(); ++k)
    solution_[to_index(k)] = -acceleration_[to_index(active_[k])];
  factors_.solve_in_place(solution_);
  forces_.setZero();
  for (std::size_t k = 0; k < active_.size(); ++k)
    forces_[to_index(active_[k])] = solution_[to_index(k)];
  return forces_;
}

template <int Dof>
double ConstrainedSystem<Dof>::gap_acceleration(std::size_t contact, const State& now) {
  const auto& forces = contact_forces(now);
  return acceleration_[to_index(contact)] +
         contacts_.response().delassus.row(to_index(contact)).dot(forces);
}

template <int Dof>
double ConstrainedSystem<Dof>::release_margin(std::size_t contact, const State& now) {
  const double force = contact_forces(now)[to_index(contact)];
  // The rounding of every gap acceleration, as the force that makes it.
  double rounding = 0.0;
  for (const auto j : active_)
    rounding += rounding_[to_index(j)] / std::sqrt(contacts_.inverse_effective_mass(j));
  return force +
         double(active_.size()) * rounding / std::sqrt(contacts_.inverse_effective_mass(contact));
}

template class ConstrainedSystem<1>;
template class ConstrainedSystem<2>;
template class ConstrainedSystem<model::any_dof>;

}  // namespace clackers::methods
