#include "clackers/methods/contact/held_system.hpp"

namespace clackers::methods {

// Q^T p(u, v); its tangents follow.
template <int Dof>
class HeldSystem<Dof>::ProjectedForce : public model::NonlinearForce<Dof> {
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
HeldSystem<Dof>::HeldSystem(const model::SmoothSystem<Dof>& free,
                            const std::vector<ImpactLaw<Dof>>& laws)
    : free_(free), laws_(laws), held_(free), is_held_(laws.size(), false) {
  const auto n = free.dof();
  projector_ = matrix_ = Matrix::Identity(n, n);
  constant_ = force_ = Vector::Zero(n);
  held_.add_load = [this](double t, std::span<double> force) { add_load(t, force); };
  if (free.nonlinear)
    held_.nonlinear = std::make_shared<ProjectedForce>(*free.nonlinear, projector_);
}

template <int Dof>
void HeldSystem<Dof>::hold(std::size_t contact, const Vector& u) {
  if (!is_held_[contact]) ++count_;
  is_held_[contact] = true;
  project(u);
}

template <int Dof>
void HeldSystem<Dof>::release(std::size_t contact, const Vector& u) {
  if (is_held_[contact]) --count_;
  is_held_[contact] = false;
  project(u);
}

template <int Dof>
void HeldSystem<Dof>::release_all() {
  count_ = 0;
  is_held_.assign(is_held_.size(), false);
}

template <int Dof>
void HeldSystem<Dof>::project(const Vector& u) {
  projector_.setIdentity();
  for (std::size_t i = 0; i < laws_.size(); ++i)
    if (is_held_[i])
      projector_.noalias() -=
          laws_[i].push / laws_[i].mobility * laws_[i].contact.direction.transpose();
  matrix_.noalias() = free_.damping * projector_;
  held_.damping.noalias() = projector_.transpose() * matrix_;
  matrix_.noalias() = free_.stiffness * projector_;
  held_.stiffness.noalias() = projector_.transpose() * matrix_;
  force_ = u;
  force_.noalias() -= projector_ * u;
  constant_.noalias() = free_.stiffness * force_;
}

template <int Dof>
void HeldSystem<Dof>::add_load(double t, std::span<double> force) {
  force_ = -constant_;
  if (free_.add_load)
    free_.add_load(t, std::span<double>(force_.data(), static_cast<std::size_t>(force_.size())));
  Eigen::Map<Vector> to(force.data(), force_.size());
  to.noalias() += projector_.transpose() * force_;
}

template <int Dof>
double HeldSystem<Dof>::contact_force(std::size_t contact, const State& now) {
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
  return -laws_[contact].push.dot(force_) / laws_[contact].mobility;
}

template class HeldSystem<1>;
template class HeldSystem<2>;
template class HeldSystem<model::any_dof>;

}  // namespace clackers::methods
