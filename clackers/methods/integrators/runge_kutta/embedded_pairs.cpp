#include "clackers/methods/integrators/runge_kutta/embedded_pairs.hpp"
#include "clackers/methods/integrators/families.hpp"
#include "clackers/methods/integrators/family.hpp"
#include "clackers/methods/integrators/stability.hpp"
#include "clackers/methods/stepping/adaptive_stepper.hpp"

namespace clackers::methods {
namespace {

class AdaptiveIntegrator final : public Integrator {
 public:
  AdaptiveIntegrator(std::string_view name, const EmbeddedPair& pair) : name_(name), pair_(pair) {}

  Facts facts() const override {
    const auto last = std::size_t(pair_.stages);
    return {.name = std::string(name_),
            .smooth_order = pair_.order,
            .dense_order = pair_.dense_order,
            .is_adaptive = true,
            .stability_limit = limit_of(pair_.a, pair_.a[last], last)};
  }
  StepperPointer<1> stepper(const model::SmoothSystem<1>& system,
                            const StepPlan& plan) const override {
    return make(system, plan);
  }
  StepperPointer<2> stepper(const model::SmoothSystem<2>& system,
                            const StepPlan& plan) const override {
    return make(system, plan);
  }
  StepperPointer<model::any_dof> stepper(const model::SmoothSystem<>& system,
                                         const StepPlan& plan) const override {
    return make(system, plan);
  }

 private:
  template <int Dof>
  StepperPointer<Dof> make(const model::SmoothSystem<Dof>& system, const StepPlan& plan) const {
    require_tolerance(name_, plan.tolerance);
    return std::make_unique<AdaptiveStepper<Dof>>(pair_, system, plan);
  }

  std::string_view name_;
  const EmbeddedPair& pair_;
};

Row adaptive(std::string_view name, std::string_view summary, const EmbeddedPair& pair,
             std::string_view card) {
  Row row;
  row.entry = {std::string(name), "integrator", std::string(summary), {}, std::string(card)};
  row.integrator = [name, &pair](const Settings& given) {
    complete(name, {}, given);  // refuses all
    return std::make_shared<AdaptiveIntegrator>(name, pair);
  };
  return row;
}

}  // namespace

std::vector<Row> embedded_pairs() {
  return {
      adaptive(
          "dopri5", "Dormand and Prince's pair 5(4), its steps chosen by a tolerance", dopri5,
          R"(Dormand and Prince's pair of order 5(4) with step control, on x = (u, v), x' = (v, a(t, u, v)):

    x1 = x0 + h (35/384 k1 + 500/1113 k3 + 125/192 k4 - 2187/6784 k5 + 11/84 k6)
    e  = h (71/57600 k1 - 71/16695 k3 + 71/1920 k4 - 17253/339200 k5 + 22/525 k6 - 1/40 k7)

A step is accepted where the mean square of e, over the tolerance and over the largest |u| or |v| of
the run so far, is at most 1. The next step is that of a PI controller, the first one that of
Hairer, Norsett and Wanner. Inside a step the dense output is of order 4.

Order       5 in the mean step; the error is proportional to the tolerance.
Stability   the step control keeps omega h near the limit where accuracy asks for less.
Dissipation of order (omega h)^6 a step below the limit.
Memory      the acceleration at the end of the last step, the step, and the scales of u and v; the
            step and the scales are kept at an impact.
Cost        six force evaluations a step, also for a step that is rejected.
Source      J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6, 19-26 (1980).
)"),
      adaptive(
          "tsit5", "Tsitouras' pair 5(4), its steps chosen by a tolerance", tsit5,
          R"(Tsitouras' pair of order 5(4) with step control; its coefficients have 16 digits. Acceptance, next
step and first step are those of dopri5. Inside a step the dense output is of order 4.

    x1 = x0 + h sum_j b_j k_j,   e = h sum_j e_j k_j

Order       5 in the mean step; the error is proportional to the tolerance.
Stability   the step control keeps omega h near the limit where accuracy asks for less.
Dissipation of order (omega h)^6 a step below the limit.
Memory      the acceleration at the end of the last step, the step, and the scales of u and v; the
            step and the scales are kept at an impact.
Cost        six force evaluations a step, also for a step that is rejected.
Source      Ch. Tsitouras, Comput. Math. Appl. 62, 770-775 (2011).
)"),
      adaptive(
          "dop853", "Dormand and Prince's method of order 8, its steps chosen by a tolerance",
          dop853,
          R"(Dormand and Prince's method of order 8 with the estimates of order 5 and 3 of Hairer, Norsett and
Wanner, twelve stages:

    x1 = x0 + h sum_j b_j k_j,   err = |e5|²/(|e5|² + 0.01 |e3|²)^(1/2)

Norms, next step and first step are those of dopri5. Inside a step the dense output is of order 7.

Order       8 in the mean step; the error is proportional to the tolerance.
Stability   the step control keeps omega h near the limit where accuracy asks for less.
Dissipation of order (omega h)^10 a step below the limit.
Memory      the acceleration at the end of the last step, the step, and the scales of u and v; the
            step and the scales are kept at an impact.
Cost        twelve force evaluations a step, also for a step that is rejected; three more for an
            impact.
Source      E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, II.5 (1993).
)")};
}

}  // namespace clackers::methods
