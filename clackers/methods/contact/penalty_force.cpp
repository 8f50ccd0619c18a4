#include "clackers/methods/contact/penalty_force.hpp"

namespace clackers::methods {

template <int Dof>
void PenaltyForce<Dof>::add(const Vector& u, const Vector& v, Vector& p) const {
  if (beside_) beside_->add(u, v, p);
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    if (const double g = contacts_[j].gap_at(u); g < 0.0)
      p += stiffnesses_[j] * g * contacts_[j].direction;
}

template <int Dof>
void PenaltyForce<Dof>::add_tangent(const Vector& u, const Vector& v, Matrix& dp_du,
                                    Matrix& dp_dv) const {
  if (beside_) beside_->add_tangent(u, v, dp_du, dp_dv);
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    if (contacts_[j].gap_at(u) < 0.0)
      dp_du += stiffnesses_[j] * contacts_[j].direction * contacts_[j].direction.transpose();
}

template <int Dof>
model::ImpactProblem<Dof> with_springs(model::ImpactProblem<Dof> problem,
                                       std::vector<double> stiffnesses) {
  problem.system.nonlinear = std::make_shared<PenaltyForce<Dof>>(
      problem.contacts, std::move(stiffnesses), std::move(problem.system.nonlinear));
  return problem;
}

template class PenaltyForce<1>;
template class PenaltyForce<2>;
template class PenaltyForce<model::any_dof>;
template model::ImpactProblem<1> with_springs(model::ImpactProblem<1>, std::vector<double>);
template model::ImpactProblem<2> with_springs(model::ImpactProblem<2>, std::vector<double>);
template model::ImpactProblem<> with_springs(model::ImpactProblem<>, std::vector<double>);

}  // namespace clackers::methods
