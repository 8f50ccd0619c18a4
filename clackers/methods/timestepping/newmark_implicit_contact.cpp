#include <utility>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/position_newmark.hpp"

namespace clackers::methods {

struct NewmarkImplicitContact {
  static constexpr std::string_view name = "newmark-implicit-contact";
  static constexpr std::string_view summary =
      "average acceleration with implicit contact forces, of Kane and others; dissipates at impacts";
  static constexpr std::string_view card =
      R"(Newmark's average acceleration, but for contact forces, which act at the end of the step alone:

    M a1 + C v1 + K u1 + p(u1, v1) = f(t1),   0 <= g(u1) _|_ L >= 0
    u1 = u0 + h/2 (v0 + v1),   v1 = v0 + h/2 (a0 + a1) + h M^-1 B^T L

Made for elastic meshes, whose impact is one of waves: a node at the contact has a mass that vanishes
as the mesh is refined, and so does the energy that it loses. A single mass has no law of impact here:
with velocity -V at a stop it leaves with |1 - 2 x| V, where x is the part of the step that follows the
impact, however small the step. Nothing is therefore claimed through impacts; `verify --path` judges
the method on meshes. Only eta = 1 is accepted, which of a mesh is no more than a name.

Order       2 in smooth motion; along a path of meshes those of data with a jump.
Stability   for every h; contact forces never add energy.
Dissipation none in flight for C = 0; at an impact of a single mass 2/3 of its kinetic energy on the
            average over all positions of the impact in the step.
Memory      a0, without contact forces.
Rest        a mass at rest on its contact stays there.
Cost        one evaluation and one back-substitution a step, one more at an impact with its
            complementarity problem; one factorization.
Source      C. Kane, E. A. Repetto, M. Ortiz, J. E. Marsden, Comput. Methods Appl. Mech. Engrg. 180,
            1-26 (1999).
)";

  Facts facts() const {
    return position_newmark_facts(std::string(name), {Behaviour::undecided, 0.0, "no-impact-law"});
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    if (auto no = position_newmark_objection(std::string(name), problem)) return no;
    return objection_to_closed_contacts(std::string(name), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class NewmarkImplicitContact::Loop final : public PositionNewmark<Dof> {
 public:
  Loop(const NewmarkImplicitContact&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : PositionNewmark<Dof>(name, std::move(problem), plan, ContactForce::at_the_end) {}
};

template Row row<NewmarkImplicitContact>();

}  // namespace clackers::methods
