#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {

struct CdLagrange {
  static constexpr std::string_view name = "cd-lagrange";
  static constexpr std::string_view summary =
      "central differences with impulses between velocities at half steps";
  static constexpr std::string_view card =
      R"(CD-Lagrange: central differences with velocities at half steps, and impulses between them:

    u1 = u0 + h w0
    M (w1 - w0) + h C v1 + h [K u1 + p(u1, v1) - f(t1)] = B^T P
    v1 = (w0 + w1) / 2
    0 <= b.w1 + eta b.w0 _|_ P >= 0     where g(u1) <= 0, otherwise P = 0

The first half step is w0 = v0 + h/2 a0. Impacts are reported at the end of the step; the velocity
there is the mean of the two sides.

Order       2 in smooth motion; 1 of the upper envelope through impacts, errors of neighbouring
            steps scatter.
Stability   omega h <= 2.
Dissipation none in flight for C = 0: the scheme is symplectic.
Memory      w0, kept as acceleration and velocity.
Rest        accumulating impacts end in a contact that is closed to less than the motion of one step;
            its force is reported as an impulse in each step.
Cost        one evaluation and one back-substitution a step, one more at an impact with its
            complementarity problem; one factorization.
Source      F.-E. Fekak, M. Brun, A. Gravouil, B. Depale, Comput. Mech. 60, 233-258 (2017);
            J. Di Stasio et al., Adv. Model. Simul. Eng. Sci. 6, 2 (2019).
)";

  Facts facts() const {
    return {.name = std::string(name),
            .smooth_order = 2.0,
            .stability_limit = 2.0,
            .through_impacts = {Behaviour::irregular, 1.0, {}}};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(std::string(name), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class CdLagrange::Loop final : public Leapfrog<Dof> {
 public:
  Loop(const CdLagrange&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Leapfrog<Dof>(name, std::move(problem), plan, 1) {}

 private:
  double least_rate(std::size_t j, double) const override {
    if (this->contacts_.gap(j, this->x1_.u) > 0.0) return -std::numeric_limits<double>::infinity();
    return -this->contacts_.restitution(j) * this->contacts_.gap_rate(j, this->before_);
  }
};

template Row row<CdLagrange>();

}  // namespace clackers::methods
