#pragma once

#include <array>
#include <cstddef>

#include "clackers/methods/integrator.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"
#include "clackers/methods/stepping/step_plan.hpp"

namespace clackers::methods {

/// An explicit Runge-Kutta method on x' = F(t, x) with error estimate and dense output:
///
///     k_i = F(t0 + c_i h, x0 + h sum_j a_ij k_j),  i < stages;  x1 = x0 + h sum_j a_sj k_j,
///     k_s = F(t0 + h, x1),  s = stages, is k_0 of the next step
///     e = h sum_j error_j k_j;  e3 likewise by error_3
///
/// In the step, with r = (t - t0)/h,
///
///     x(t) = x0 + r (d_0 + (1 - r) (d_1 + r (d_2 + (1 - r) (d_3 + ...))))
///     d_0 = x1 - x0,  d_1 = h k_0 - d_0,  d_2 = 2 d_0 - h (k_0 + k_s),  d_(3+m) = h sum_j dense_mj k_j
///
/// where more stages, after k_s, may serve the dense output only.
struct EmbeddedPair {
  static constexpr std::size_t most = 16;  ///< stages of all kinds
  using Row = std::array<double, most>;

  int stages = 0, dense_stages = 0;
  double order = 0.0, dense_order = 0.0;
  int error_order = 0;  ///< of the power of h that the estimate falls with
  std::array<Row, most> a{};
  Row error{}, error_3{};  ///< error_3 = 0: there is none
  int dense_rows = 0;
  std::array<Row, 4> dense{};

  constexpr double c(std::size_t i) const {
    double sum = 0.0;
    for (const double x : a[i]) sum += x;
    return sum;
  }
};

/// The stepper of embedded pairs with step control. A step is accepted if its estimated error is
/// below the tolerance,
///
///     err = [mean over all u and v of (e / (tolerance scale))²]^(1/2) <= 1
///
/// where the scale of u is the largest |u| of any degree of freedom in the run so far, and that of v
/// the largest |v|. The next step is that of a PI controller (K. Gustafsson, ACM Trans. Math. Softw.
/// 17, 533-554 (1991)), h err^(-0.85/q) err_before^(0.2/q) with q the order of the estimate; the
/// first one is chosen as E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential
/// Equations I, II.4 (1993) do, with the rates of u and v in place of norms. After a restart the
/// step is the one tried last. The run fails with step-too-small where rounding of the time hides
/// the step.
///
/// Ends of steps are the stepper's own; the last one is the end of the plan. partial() is the dense
/// output of the step that rewind() has gone back before.
template <int Dof>
class AdaptiveStepper final : public AnyStepper<Dof> {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  /// Pair and system must outlive the stepper.
  AdaptiveStepper(const EmbeddedPair& pair, const model::SmoothSystem<Dof>& system,
                  const StepPlan& plan);

  void rebuild() override { equation_.rebuild(); }
  void restart(const State& from) override;
  std::size_t advance(long long first, std::span<State> states) override;
  void rewind(long long first, std::span<const State> states, std::size_t steps) override;
  const State& partial(const State& from, double s) override;

  bool failed() const override { return failed_; }
  Code failure() const override { return "step-too-small"; }
  void reset() override;
  void add_work(model::Work& work) const override { equation_.add_work(work); }

 private:
  using Tally = typename MotionEquation<Dof>::Tally;

  // What step control remembers of the steps before.
  struct Control {
    double h = 0.0;  // 0: not chosen yet
    double error = 1e-4;
    double u_scale = 0.0, v_scale = 0.0;
  };
  struct Mark {
    Control control;
    Tally tally;
  };

  void evaluate(std::size_t i, double t, const Vector& u, const Vector& v);
  double first_step(const State& from);
  bool step(const State& x, State& y);
  double attempt(const State& x, double t1, State& y, Control& scales);
  void prepare_dense(const State& x);

  const EmbeddedPair& pair_;
  StepPlan plan_;
  MotionEquation<Dof> equation_;
  std::array<Vector, EmbeddedPair::most> rate_u_, rate_v_;  // k_i
  std::array<Vector, 7> dense_u_, dense_v_;                 // d_i
  Vector u_, v_, sum_;
  State part_;
  double length_ = 0.0;     // of the step whose stages are held
  bool is_at_end_ = false;  // of it: its last stage is the first one of the next step
  bool has_dense_ = false;
  bool failed_ = false;
  Control control_;
  std::array<Mark, AnyStepper<Dof>::most_steps> marks_;  // before each step of a block
};

extern template class AdaptiveStepper<1>;
extern template class AdaptiveStepper<2>;
extern template class AdaptiveStepper<model::any_dof>;

}  // namespace clackers::methods
