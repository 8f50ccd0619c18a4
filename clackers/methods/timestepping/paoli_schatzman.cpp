#include <fmt/format.h>

#include <algorithm>

#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/leapfrog.hpp"

namespace clackers::methods {
namespace {

// What the cards of both names share.
std::string displacement_card(std::string_view head, std::string_view order,
                              std::string_view source) {
  return fmt::format(R"({}

    M (u2 - 2 u1 + u0) / h² + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L
    v1 = (u2 - u0) / 2 h
    0 <= (b.u2 + eta b.u0) / (1 + eta) - gap _|_ L >= 0   at every contact

The first step is that of Taylor's series. An impact takes two steps, or three where forces press the
contact on, but for eta = 0 at all contacts: its impulse is the sum of all h L, reported at the last; a
lasting contact is a row of such impacts. {}
Stability   omega h <= 2.
Dissipation none in flight for C = 0.
Memory      u0, kept as acceleration and velocity.
Rest        accumulating impacts end in a contact that is closed to less than the motion of one step,
            with eta = 0 at the first impact; its force is reported as an impulse every third step, for
            eta = 0 at all contacts every second one.
Cost        one evaluation and one back-substitution a step, one more in both steps of an impact
            with its complementarity problem; one factorization.
Source      {}
)",
                     head, order, source);
}

}  // namespace

struct PaoliSchatzman {
  static constexpr std::string_view name = "paoli-schatzman";
  static constexpr std::string_view summary =
      "central differences with restitution between displacements two steps apart";
  static std::string card() {
    return displacement_card(
        R"(Paoli and Schatzman's central differences with restitution between displacements two steps apart,
for M a + C v + K u + p(u, v) = f(t) + B^T L:)",
        R"(forward-increment-lagrange is another name of this scheme.

Order       2 in smooth motion; 1 through impacts, with errors on a line where others scatter, since
            each delays the motion after it by two steps, wherever in a step it falls; with scatter
            where a force presses the contact on for a third step (of `ball` the error over h varies
            by a factor 1.2 for eta = 0.5, 3.7 for 0.8, 4.2 for 0.9). With eta = 0 at all contacts
            the gap is closed without delay: 2 in displacement, 1 in velocity.)",
        "L. Paoli, M. Schatzman, SIAM J. Numer. Anal. 40, 702-733 and 734-768 (2002).");
  }

  std::string_view own_name = name;

  Facts facts() const {
    return {.name = std::string(own_name),
            .smooth_order = 2.0,
            .stability_limit = 2.0,
            .through_impacts = {Behaviour::proper, 1.0, {}},
            .plastic_order = 2.0,
            .scatters_pressed = true};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(std::string(own_name), problem);
  }

  template <int Dof>
  class Loop;
};

struct ForwardIncrementLagrange : PaoliSchatzman {
  static constexpr std::string_view name = "forward-increment-lagrange";
  static constexpr std::string_view summary =
      "central differences with multipliers that close the gap in the next step; paoli-schatzman";
  static std::string card() {
    return displacement_card(
        R"(Forward-increment Lagrange multipliers with central differences: the forces L at t1 are those that
close, at the end of the next step, the contacts that the free motion would penetrate. That is eta = 0, the
scheme of Carpenter, Taylor and Katona; with the law of Paoli and Schatzman it has restitution:)",
        R"(Signs of L follow from the complementarity and not from iterations over contacts.
The runs are those of paoli-schatzman, to the bit.

Order       2 in smooth motion, and in displacement through impacts with eta = 0 at all contacts, where
            it is 1 in velocity; otherwise 1 through impacts, as the card of paoli-schatzman says.)",
        R"(N. J. Carpenter, R. L. Taylor, M. G. Katona, Int. J. Numer. Methods Eng. 32, 103-128
            (1991).)");
  }

  ForwardIncrementLagrange() { own_name = name; }
};

template <int Dof>
class PaoliSchatzman::Loop final : public Leapfrog<Dof> {
 public:
  Loop(const PaoliSchatzman& scheme, const model::ImpactProblem<Dof>& problem, const StepPlan& plan)
      : Leapfrog<Dof>(scheme.own_name, problem, plan, is_any_elastic(problem.contacts) ? 3 : 2) {}

 private:
  static bool is_any_elastic(const std::vector<model::Contact<Dof>>& contacts) {
    return std::ranges::any_of(contacts, [](const auto& c) { return c.restitution > 0.0; });
  }
  // u2 = u1 + h y and u0 = u1 - h before_.
  double least_rate(std::size_t j, double h) const override {
    const double eta = this->contacts_.restitution(j);
    return eta * this->contacts_.gap_rate(j, this->before_) -
           (1.0 + eta) * this->contacts_.gap(j, this->x1_.u) / h;
  }
};

template Row row<PaoliSchatzman>();
template Row row<ForwardIncrementLagrange>();

}  // namespace clackers::methods
