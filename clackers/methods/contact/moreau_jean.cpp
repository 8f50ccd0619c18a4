#include "clackers/methods/contact/moreau_jean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

const std::vector<Field<MoreauJean>>& MoreauJean::fields() {
  static const std::vector<Field<MoreauJean>> all = {
      {"theta", "1/2 <= theta <= 1", "weight of the end of the step", &MoreauJean::theta}};
  return all;
}

void MoreauJean::validate() const {
  if (!(theta >= 0.5 && theta <= 1.0))
    refuse(name, "theta", theta, "1/2 <= theta <= 1",
           "Below 1/2 undamped motion grows at every step size; use theta = 0.5 for no numerical "
           "dissipation.");
}

Facts MoreauJean::facts() const {
  return {.name = specification(*this),
          .smooth_order = theta == 0.5 ? 2.0 : 1.0,
          .stability_limit = std::numeric_limits<double>::infinity(),
          .through_impacts = {Behaviour::irregular, 1.0, {}}};
}

std::optional<Objection> MoreauJean::objection(const model::ImpactProblem<>& problem) const {
  const auto who = specification(*this);
  if (problem.system.nonlinear)
    return Objection{
        fmt::format("{} with a nonlinear force: its step is one linear equation. Use a "
                    "method that iterates, such as newmark+event-driven.",
                    who),
        "linear-only"};
  return objection_to_closed_contacts(who, problem);
}

/// A run under Moreau and Jean's scheme.
template <int Dof>
class MoreauJean::Loop {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  Loop(const MoreauJean& method, model::ImpactProblem<Dof> problem, const StepPlan& plan)
      : theta_(method.theta),
        problem_(std::move(problem)),
        plan_(plan),
        contacts_(problem_),
        v_before_(problem_.start.v),
        r_(v_before_),
        load_(r_),
        end_load_(r_),
        matrix_(problem_.system.mass),
        rates_(contacts_.no_impulses()),
        impulses_(rates_) {
    closed_.reserve(contacts_.size());
    prepare(plan.h);
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    State now = problem_.start;
    work_ = {};
    if (!out.append(now)) return;
    for (long long k = 1; k <= plan_.total; ++k) {
      const double t1 = plan_.time(k);
      // A shorter last step has a matrix of its own.
      if (k > plan_.whole) prepare(t1 - now.t);
      const bool goes_on = step(now, k <= plan_.whole ? plan_.h : t1 - now.t, t1, out);
      ++work_.steps;
      if (!goes_on || !out.append(now)) break;
    }
    if (plan_.total > plan_.whole) prepare(plan_.h);
  }

  model::Work work() const { return work_; }

 private:
  // What depends on the system and the step alone.
  void prepare(double h) {
    const auto& s = problem_.system;
    const double th = theta_ * h;
    matrix_ = s.mass + th * s.damping + th * th * s.stiffness;
    require_definite(name, h, !effective_.compute(matrix_));
    ++work_.factorizations;
    contacts_.respond(effective_, response_);
  }

  bool step(State& x, double h, double t1, Recorder<Dof>& out) {
    const auto& s = problem_.system;
    const double rest = 1.0 - theta_;
    v_before_ = x.v;
    // v1 without impulse: u_th = u0 + theta h v_th and v_th = theta v1 + (1 - theta) v0.
    r_ = x.u + theta_ * rest * h * x.v;
    load_.setZero();
    if (s.add_load) add_load(x.t, t1);
    load_.noalias() -= s.stiffness * r_;
    load_.noalias() -= rest * (s.damping * x.v);
    r_.noalias() = s.mass * x.v;
    r_ += h * load_;
    effective_.solve_in_place(r_);
    ++work_.force_evaluations;

    closed_.clear();
    for (std::size_t j = 0; j < contacts_.size(); ++j) {
      const double rate = contacts_.gap_rate(j, x.v);
      if (!(contacts_.gap(j, x.u) + 0.5 * h * rate <= 0.0)) continue;
      closed_.push_back(j);
      rates_[static_cast<Eigen::Index>(j)] =
          contacts_.gap_rate(j, r_) + contacts_.restitution(j) * rate;
    }
    if (!closed_.empty()) {
      if (const auto no = contacts_.solve(response_, closed_, rates_, impulses_))
        return out.fail(no->code, t1, no->sentence);
      r_.noalias() += response_.velocity * impulses_;
    }

    x.u += h * (theta_ * r_ + rest * x.v);
    x.v = r_;
    x.t = t1;
    for (const auto j : closed_)
      if (const double impulse = impulses_[static_cast<Eigen::Index>(j)]; impulse > 0.0)
        if (!out.impact(x, static_cast<int>(j), v_before_, impulse)) return false;
    return true;
  }

  // theta f(t1) + (1 - theta) f(t0)
  void add_load(double t0, double t1) {
    const auto span = [](Vector& x) {
      return std::span<double>(x.data(), static_cast<std::size_t>(x.size()));
    };
    end_load_.setZero();
    problem_.system.add_load(t1, span(end_load_));
    problem_.system.add_load(t0, span(load_));
    load_ = theta_ * end_load_ + (1.0 - theta_) * load_;
  }

  double theta_;
  model::ImpactProblem<Dof> problem_;
  StepPlan plan_;
  ContactSet<Dof> contacts_;
  Vector v_before_, r_, load_, end_load_;
  model::Matrix<Dof> matrix_;
  numerics::SpdSolver<Dof> effective_;
  ContactResponse<Dof> response_;     // of the effective mass
  Eigen::VectorXd rates_, impulses_;  // at the end of the step without impulses; of the step [N s]
  std::vector<std::size_t> closed_;
  model::Work work_;
};

template Row row<MoreauJean>();

}  // namespace clackers::methods
