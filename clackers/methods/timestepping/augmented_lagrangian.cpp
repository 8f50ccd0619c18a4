#include "clackers/methods/timestepping/augmented_lagrangian.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/position_newmark.hpp"

namespace clackers::methods {

const std::vector<Field<AugmentedLagrangian>>& AugmentedLagrangian::fields() {
  static const std::vector<Field<AugmentedLagrangian>> all = {
      {"factor", "0 < factor < 2", "penalty over the stiffness that the step gives to a contact",
       &AugmentedLagrangian::factor},
      {"tolerance", "0 < tolerance < infinity", "of the gap in the iteration [m]",
       &AugmentedLagrangian::tolerance}};
  return all;
}

void AugmentedLagrangian::validate() const {
  if (!(factor > 0.0 && factor < 2.0))
    refuse(name, "factor", factor, "0 < factor < 2", "From 2 on the iteration does not converge.");
  require_positive(name, "tolerance", tolerance);
}

Facts AugmentedLagrangian::facts() const { return position_newmark_facts(specification(*this)); }

std::optional<Objection> AugmentedLagrangian::objection(
    const model::ImpactProblem<>& problem) const {
  return position_newmark_objection(specification(*this), problem);
}

template <int Dof>
class AugmentedLagrangian::Loop final : public PositionNewmark<Dof> {
 public:
  Loop(const AugmentedLagrangian& method, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : PositionNewmark<Dof>(specification(method), std::move(problem), plan), method_(method) {}

 private:
  using Base = SteppingScheme<Dof>;
  using Base::change_, Base::impulses_, Base::response_, Base::rows_;

  // In terms of impulses h L and of the gap rate 2 g / h.
  void improve_impulses() override {
    const double largest = response_.delassus.cwiseAbs().rowwise().sum().maxCoeff();
    penalty_ = method_.factor / largest;
    for (const auto j : rows_) {
      auto& impulse = impulses_[Eigen::Index(j)];
      impulse = std::max(0.0, impulse - penalty_ * this->excess(j));
    }
  }
  bool is_settled(double h) const override {
    return 0.5 * h * change_.cwiseAbs().maxCoeff() <= method_.tolerance * penalty_;
  }
  int most_iterations() const override { return 10000; }

  AugmentedLagrangian method_;
  double penalty_ = 0.0;
};

template Row row<AugmentedLagrangian>();

}  // namespace clackers::methods
