#include "clackers/methods/contact/moreau_jean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/methods/contact/impact_law.hpp"
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
        laws_(impact_laws(problem_)),
        v_before_(problem_.start.v),
        r_(v_before_),
        load_(r_),
        end_load_(r_),
        matrix_(problem_.system.mass),
        response_(laws_.size(), v_before_),
        impulses_(laws_.size(), 0.0) {
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
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      response_[j] = laws_[j].contact.direction;
      effective_.solve_in_place(response_[j]);
    }
  }

  bool is_active(std::size_t j, const State& x, double h) const {
    const auto& contact = laws_[j].contact;
    return contact.gap_at(x.u) + 0.5 * h * contact.gap_rate(x.v) <= 0.0;
  }

  // What the rate at the end of the step would fall short of Newton's law without an impulse.
  double shortfall(std::size_t j, const State& x, const Vector& v_free) const {
    const auto& contact = laws_[j].contact;
    return contact.gap_rate(v_free) + contact.restitution * contact.gap_rate(x.v);
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

    // Which contacts need an impulse is decided by the velocity without any, so that their numbers
    // do not matter.
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const double lack = is_active(j, x, h) ? shortfall(j, x, r_) : 0.0;
      impulses_[j] = lack < 0.0 ? -lack / laws_[j].contact.direction.dot(response_[j]) : 0.0;
    }
    for (std::size_t j = 0; j < laws_.size(); ++j)
      if (impulses_[j] > 0.0) r_ += impulses_[j] * response_[j];
    if (!are_complementary(x, h, t1, out)) return false;

    x.u += h * (theta_ * r_ + rest * x.v);
    x.v = r_;
    x.t = t1;
    for (std::size_t j = 0; j < laws_.size(); ++j)
      if (impulses_[j] > 0.0 && !out.impact(x, static_cast<int>(j), v_before_, impulses_[j]))
        return false;
    return true;
  }

  // False, having ended the run, where an impulse has changed the rate at another contact that has
  // an impulse itself or now needs one.
  bool are_complementary(const State& x, double h, double t1, Recorder<Dof>& out) const {
    for (std::size_t i = 0; i < laws_.size(); ++i)
      for (std::size_t j = 0; j < laws_.size(); ++j) {
        if (j == i || !(impulses_[j] > 0.0) || !is_active(i, x, h)) continue;
        if (!(impulses_[i] > 0.0 || shortfall(i, x, r_) < 0.0)) continue;
        if (respond_to_each_other(i, j))
          return out.fail("simultaneous-contacts", t1,
                          simultaneous(std::min(i, j), std::max(i, j)));
      }
    return true;
  }

  bool respond_to_each_other(std::size_t i, std::size_t j) const {
    const auto& b = laws_[j].contact.direction;
    const double cross = std::abs(b.dot(response_[i]));
    const double own = laws_[i].contact.direction.dot(response_[i]), other = b.dot(response_[j]);
    // Uncoupled rows leave n products' rounding.
    const double rounding = 16.0 * double(b.size()) * std::numeric_limits<double>::epsilon();
    return cross > rounding * std::sqrt(own * other);
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
  std::vector<ImpactLaw<Dof>> laws_;
  Vector v_before_, r_, load_, end_load_;
  model::Matrix<Dof> matrix_;
  numerics::SpdSolver<Dof> effective_;
  std::vector<Vector> response_;  // effective mass^-1 b: the change of v1 by a unit impulse
  std::vector<double> impulses_;  // of the step [N s]
  model::Work work_;
};

template Row row<MoreauJean>();

}  // namespace clackers::methods
