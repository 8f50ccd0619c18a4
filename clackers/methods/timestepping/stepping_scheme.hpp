#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clackers/methods/contact/friction_rows.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"
#include "clackers/methods/stepping/recorder.hpp"
#include "clackers/methods/stepping/step_plan.hpp"
#include "clackers/model/run.hpp"

namespace clackers::methods {

/// The run of a time-stepping scheme. Each step is made without impulses first. Where the velocity y
/// that the law of the contacts limits is then below the least gap rate, the impulses P of all such
/// contacts together are those with
///
///     0 <= b_j.y(P) - least_j _|_ P_j >= 0
///
/// whatever their numbers. y is affine in P, with the derivative `response`, but for nonlinear forces
/// and a response that is not symmetric: the complementarity problem is then solved again with the
/// step made of the last impulses, until these no longer change. So are the impulses of friction, which
/// at a contact have the limit mu P_j.
template <int Dof>
class SteppingScheme {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;
  using Equation = MotionEquation<Dof>;

  SteppingScheme(const SteppingScheme&) = delete;
  SteppingScheme& operator=(const SteppingScheme&) = delete;
  virtual ~SteppingScheme() = default;

  void advance(Recorder<Dof>& out);
  model::Work work() const;

 protected:
  /// An impact takes one step, or where `most_impact_steps` is 2 or 3 two and as long as there are
  /// impulses up to so many: those of its steps are reported as one. A scheme calls prepare() of the
  /// plan's step in its constructor.
  SteppingScheme(model::ImpactProblem<Dof> problem, const StepPlan& plan,
                 int most_impact_steps = 1);

  /// Does what depends only on the system and the step, and fills `response_`.
  virtual void prepare(double h) = 0;
  /// Fills the memory of the scheme from x0_.
  virtual void start() = 0;
  /// The part of the step that impulses do not change.
  virtual void predict(double h) = 0;
  /// x1_ and y_ of the step with the change of velocity `jump_` = M^-1 B^T P.
  virtual void complete(double h) = 0;
  /// The least gap rate [m/s] that the law leaves contact j; -infinity where it is not active.
  /// x1_ and y_ are those without impulses.
  virtual double least_rate(std::size_t j, double h) const = 0;
  /// Takes x1_ into the memory of the scheme.
  virtual void accept() = 0;
  /// The next iterate of `impulses_` for the contacts of `rows_`: of the complementarity problem,
  /// linear in P around the last one.
  virtual void improve_impulses();
  /// Whether `change_` of the impulses is nothing but rounding.
  virtual bool is_settled(double h) const;
  virtual int most_iterations() const { return 50; }

  /// Factorizes the matrix of these weights and takes its response; throws InputError, in the name of
  /// `who`, where it is not positive definite.
  void respond(std::string_view who, double h, const typename Equation::Weights& weights);
  /// What the rate y of contact j exceeds the least one by [m/s].
  double excess(std::size_t j) const { return contacts_.gap_rate(j, y_) - least_[j]; }

  model::ImpactProblem<Dof> problem_;
  Equation equation_;
  ContactSet<Dof> contacts_;
  ContactResponse<Dof> response_;  ///< of y to the impulses
  State x0_, x1_;                  ///< at the two ends of the step
  Vector before_;                  ///< the velocity that an impact starts from
  Vector y_;                       ///< the velocity that the law limits, with which an impact ends
  Vector jump_;                    ///< M^-1 B^T P [m/s]
  std::vector<std::size_t> rows_;  ///< contacts that an impulse may act on, ascending
  Eigen::VectorXd impulses_;       ///< P of the step [N s]
  Eigen::VectorXd change_;         ///< of P in the last iteration [N s]
  std::optional<Objection> failure_;  ///< why impulses or forces were not found

 private:
  struct Unfinished {  // an impact of which so many steps have been made
    int steps = 0;
    double impulse = 0.0;
    Vector before;
    State after;
  };

  bool step(double h, double t1, Recorder<Dof>& out);
  bool find_impulses(double h, double t1, Recorder<Dof>& out);
  bool improve_friction(double h);
  void take_violated();
  bool report(Recorder<Dof>& out);

  StepPlan plan_;
  int most_impact_steps_;
  std::vector<double> least_;
  std::vector<Unfinished> unfinished_;
  Eigen::VectorXd q_;
  ContactSet<Dof> frictions_;                  // as contacts
  ContactResponse<Dof> response_to_friction_;  // of y
  Eigen::VectorXd friction_;                   // impulses of the step [N s]
  Eigen::VectorXd last_friction_, slip_;
  std::vector<bool> sticks_, holds_;  // in the step before, and in this one
  long long steps_ = 0;
};

extern template class SteppingScheme<1>;
extern template class SteppingScheme<2>;
extern template class SteppingScheme<model::any_dof>;

}  // namespace clackers::methods
