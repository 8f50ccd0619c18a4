#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "clackers/model/impact_problem.hpp"

namespace clackers::methods {

/// Linear one-sided springs at the contacts, p = sum_j stiffness_j min(g_j, 0) b_j, beside the
/// force that a system has already.
template <int Dof>
class PenaltyForce final : public model::NonlinearForce<Dof> {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;

  /// One stiffness a contact [N/m]. `beside` may be empty.
  PenaltyForce(std::vector<model::Contact<Dof>> contacts, std::vector<double> stiffnesses,
               std::shared_ptr<const model::NonlinearForce<Dof>> beside)
      : contacts_(std::move(contacts)),
        stiffnesses_(std::move(stiffnesses)),
        beside_(std::move(beside)) {}

  void add(const Vector& u, const Vector& v, Vector& p) const override;
  void add_tangent(const Vector& u, const Vector& v, Matrix& dp_du, Matrix& dp_dv) const override;

 private:
  std::vector<model::Contact<Dof>> contacts_;
  std::vector<double> stiffnesses_;
  std::shared_ptr<const model::NonlinearForce<Dof>> beside_;
};

/// The problem with springs in its system; the contacts stay to be looked at.
template <int Dof>
model::ImpactProblem<Dof> with_springs(model::ImpactProblem<Dof> problem,
                                       std::vector<double> stiffnesses);

}  // namespace clackers::methods
