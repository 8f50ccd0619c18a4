#include <limits>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/timestepping/stepping_scheme.hpp"

namespace clackers::methods {

struct MoreauJean {
  static constexpr std::string_view name = "moreau-jean";
  static constexpr std::string_view summary =
      "time-stepping with velocity impulses, impacts not located inside the step";
  static constexpr std::string_view card =
      R"(Moreau and Jean's time-stepping, with x_th = theta x1 + (1 - theta) x0 for x = u, v, f:

    M (v1 - v0) + h C v_th + h K u_th + h p(u_th, v_th) = h f_th + B^T P
    u1 = u0 + h v_th
    0 <= b.v1 + eta b.v0 _|_ P >= 0    where g(u0 + h/2 v0) <= 0, else P = 0

The contact is thus decided by a predictor at half a step, and the impact happens somewhere in
the step. It is reported at the end of the step. Contacts with linearly dependent b that need
impulses in one step end the run.

Rows of dry friction have the impulses L of the same step with

    |L| <= h limit where b.v1 = velocity,   L = -h kinetic sgn(b.v1 - velocity) elsewhere

of rows that slid in the step before with h kinetic for both; of a row of friction of a contact both are
mu P, with the P of the contact in the step.

Order       1 of the upper envelope; in smooth motion 2 for theta = 1/2, otherwise 1, and where
            that error, of the size (theta - 1/2) h, is the larger one, errors lie on a line.
Stability   for every h.
Dissipation none in flight for theta = 1/2, C = 0; grows with theta.
Memory      none.
Rest        accumulating impacts end in a contact that is closed to less than the motion of one step;
            its force is reported as an impulse in each step.
Cost        one evaluation and one back-substitution a step, one more at an impact with its
            complementarity problem; one factorization.
Source      J. J. Moreau, Comput. Methods Appl. Mech. Eng. 177, 329-349 (1999).
)";
  static constexpr bool takes_friction = true;
  static const std::vector<Field<MoreauJean>>& fields() {
    static const std::vector<Field<MoreauJean>> all = {
        {"theta", "1/2 <= theta <= 1", "weight of the end of the step", &MoreauJean::theta}};
    return all;
  }

  double theta = 0.5;  ///< in [1/2, 1]; below 1/2 the method is unstable for every h

  /// Throws InputError for theta outside [1/2, 1].
  void validate() const {
    if (!(theta >= 0.5 && theta <= 1.0))
      refuse(name, "theta", theta, "1/2 <= theta <= 1",
             "Below 1/2 undamped motion grows at every step size; use theta = 0.5 for no numerical "
             "dissipation.");
  }
  Facts facts() const {
    return {.name = specification(*this),
            .smooth_order = theta == 0.5 ? 2.0 : 1.0,
            .stability_limit = std::numeric_limits<double>::infinity(),
            .through_impacts = {Behaviour::irregular, 1.0, {}}};
  }
  std::optional<Objection> objection(const model::ImpactProblem<>& problem) const {
    return objection_to_closed_contacts(specification(*this), problem);
  }

  template <int Dof>
  class Loop;
};

template <int Dof>
class MoreauJean::Loop final : public SteppingScheme<Dof> {
 public:
  Loop(const MoreauJean& method, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : Base(std::move(problem), plan), theta_(method.theta), a_(x0_.v), u_(a_), shift_(a_) {
    prepare(plan.h);
  }

 private:
  using Base = SteppingScheme<Dof>;
  using Base::before_, Base::contacts_, Base::equation_, Base::jump_, Base::x0_, Base::x1_;
  using Base::y_;

  // v1 = v0 + h a, v_th = v0 + theta h a and u_th = u0 + theta h v_th.
  typename MotionEquation<Dof>::Weights weights(double h) const {
    return {1.0, theta_ * h, theta_ * theta_ * h * h};
  }

  void prepare(double h) override { this->respond(name, h, weights(h)); }
  void start() override { a_.setZero(); }

  void predict(double h) override {
    before_ = x0_.v;
    u_ = x0_.u + theta_ * h * x0_.v;
  }

  void complete(double h) override {
    shift_ = jump_ / -h;
    equation_.solve({x1_.t, x0_.t, 1.0 - theta_}, weights(h), u_, x0_.v, a_, &shift_);
    x1_.v = y_ = x0_.v + h * a_;
    x1_.u = x0_.u + h * x0_.v + theta_ * h * h * a_;
  }

  double least_rate(std::size_t j, double h) const override {
    const double rate = contacts_.gap_rate(j, x0_.v);
    if (contacts_.gap(j, x0_.u) + 0.5 * h * rate > 0.0)
      return -std::numeric_limits<double>::infinity();
    return -contacts_.restitution(j) * rate;
  }

  void accept() override {}

  double theta_;
  model::Vector<Dof> a_, u_, shift_;
};

template Row row<MoreauJean>();

}  // namespace clackers::methods
