#include <fmt/format.h>

#include <algorithm>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {

struct PaoliSchatzman {
  static constexpr std::string_view name = "paoli-schatzman";
  static constexpr std::string_view summary =
      "central differences with restitution between displacements two steps apart";
  static constexpr std::string_view card =
      R"(Paoli and Schatzman's central differences with restitution between displacements two steps apart,
for M a + C v + K u + p(u, v) = f(t) + B^T L:

    M (u2 - 2 u1 + u0) / h² + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
    v1 = (u2 - u0) / 2 h
    0 <= (b.u2 + eta b.u0) / (1 + eta) - gap _|_ L >= 0   at every contact

The first step is that of Taylor's series. An impact takes two steps, or three where forces press the
contact on: its impulse is the sum of all h L, reported at the last; a lasting contact is a row of such
impacts. With eta = 0 at all contacts it is forward-increment-lagrange, of another order: that one is to
be used.

Order       2 in smooth motion; 1 through impacts, with errors on a line where others scatter, since
            the impact ends at a time that is smooth in the step; with scatter where a force presses
            the contact on for a third step (of `ball` the error over h varies by a factor 1.2 for eta = 0.5,
            3.7 for 0.8, 4.2 for 0.9).
Stability   omega h <= 2.
Dissipation none in flight for C = 0.
Memory      u0, kept as acceleration and velocity.
Rest        accumulating impacts end in a contact that is closed to less than the motion of one step;
            its force is reported as an impulse every third step.
Cost        one evaluation and one back-substitution a step, one more in both steps of an impact
            with its complementarity problem; one factorization.
Source      L. Paoli, M. Schatzman, SIAM J. Numer. Anal. 40, 702-733 and 734-768 (2002).
)";

  Facts facts() const {
    return {.name = std::string(name),
            .smooth_order = 2.0,
            .stability_limit = 2.0,
            .through_impacts = {Behaviour::proper, 1.0, {}},
            .scatters_pressed = true};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    const auto is_inelastic = [](const auto& contact) { return contact.restitution == 0.0; };
    if (!problem.contacts.empty() && std::ranges::all_of(problem.contacts, is_inelastic))
      return Objection{
          fmt::format("{} with eta = 0: it is then forward-increment-lagrange, of order 2. "
                      "Use that.",
                      name),
          "law-needs-restitution"};
    return objection_to_closed_contacts(std::string(name), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class PaoliSchatzman::Loop final : public Leapfrog<Dof> {
 public:
  Loop(const PaoliSchatzman&, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Leapfrog<Dof>(name, std::move(problem), plan, 3) {}

 private:
  // u2 = u1 + h y and u0 = u1 - h before_.
  double least_rate(std::size_t j, double h) const override {
    const double eta = this->contacts_.restitution(j);
    return eta * this->contacts_.gap_rate(j, this->before_) -
           (1.0 + eta) * this->contacts_.gap(j, this->x1_.u) / h;
  }
};

template Row row<PaoliSchatzman>();

}  // namespace clackers::methods
