#include "clackers/methods/contact/constrained_system.hpp"

namespace clackers::methods {

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
                                          const std::vector<ImpactLaw<Dof>>& laws)
    : free_(free), laws_(laws), constrained_(free), is_active_(laws.size(), false) {
  const auto n = free.dof();
  projector_ = matrix_ = Matrix::Identity(n, n);
  constant_ = force_ = Vector::Zero(n);
  constrained_.add_load = [this](double t, std::span<double> force) { add_load(t, force); };
  if (free.nonlinear)
    constrained_.nonlinear = std::make_shared<ProjectedForce>(*free.nonlinear, projector_);
}

template <int Dof>
void ConstrainedSystem<Dof>::activate(std::size_t contact, const Vector& u) {
  if (!is_active_[contact]) ++count_;
  is_active_[contact] = true;
  project(u);
}

template <int Dof>
void ConstrainedSystem<Dof>::deactivate(std::size_t contact, const Vector& u) {
  if (is_active_[contact]) --count_;
  is_active_[contact] = false;
  project(u);
}

template <int Dof>
void ConstrainedSystem<Dof>::deactivate_all() {
  count_ = 0;
  is_active_.assign(is_active_.size(), false);
}

template <int Dof>
void ConstrainedSystem<Dof>::project(const Vector& u) {
  projector_.setIdentity();
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (is_active_[i])
      projector_.noalias() -= laws_[i].inverse_mass_direction / laws_[i].inverse_effective_mass *
                              laws_[i].contact.direction.transpose();
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
  force_ = -constant_;
  if (free_.add_load)
    free_.add_load(t, std::span<double>(force_.data(), static_cast<std::size_t>(force_.size())));
  Eigen::Map<Vector> to(force.data(), force_.size());
  to.noalias() += projector_.transpose() * force_;
}

template <int Dof>
double ConstrainedSystem<Dof>::contact_force(std::size_t contact, const State& now) {
  force_.setZero();
  if (free_.nonlinear) {
    free_.nonlinear->add(now.u, now.v, force_);
    force_ = -force_;
  }
  force_.noalias() -= free_.damping * now.v;
  force_.noalias() -= free_.stiffness * now.u;
  if (free_.add_load)
    free_.add_load(now.t,
                   std::span<double>(force_.data(), static_cast<std::size_t>(force_.size())));
  return -laws_[contact].inverse_mass_direction.dot(force_) / laws_[contact].inverse_effective_mass;
}

template class ConstrainedSystem<1>;
template class ConstrainedSystem<2>;
template class ConstrainedSystem<model::any_dof>;

}  // namespace clackers::methods
