#include "clackers/methods/contact/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/time_loop.hpp"
#include "clackers/numerics/roots.hpp"

namespace clackers::methods {
namespace {

constexpr double default_factor = 1e4;
constexpr double contacts_per_period = 40.0;

// The degree of freedom whose stiffness sets the default of a contact.
template <int Dof>
Eigen::Index first_touched(const model::Contact<Dof>& contact) {
  Eigen::Index i = 0;
  while (contact.direction[i] == 0.0) ++i;
  return i;
}

// The largest omega^2 of a mass in the row of the contact, alone on its springs.
template <int Dof>
double fastest_squared(const model::SmoothSystem<Dof>& system, const model::Contact<Dof>& contact) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < contact.direction.size(); ++i)
    if (contact.direction[i] != 0.0)
      most = std::max(most, system.stiffness(i, i) / system.mass(i, i));
  return most;
}

// Linear one-sided springs at the contacts, p = sum_j stiffness_j min(g_j, 0) b_j, in addition to
// the force that a system has already.
template <int Dof>
class PenaltyForce final : public model::NonlinearForce<Dof> {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;

  // One stiffness a contact [N/m]. `other` may be empty.
  PenaltyForce(std::vector<model::Contact<Dof>> contacts, std::vector<double> stiffnesses,
               std::shared_ptr<const model::NonlinearForce<Dof>> other)
      : contacts_(std::move(contacts)),
        stiffnesses_(std::move(stiffnesses)),
        other_(std::move(other)) {}

  void add(const Vector& u, const Vector& v, Vector& p) const override {
    if (other_) other_->add(u, v, p);
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (const double g = contacts_[j].gap_at(u); g < 0.0)
        p += stiffnesses_[j] * g * contacts_[j].direction;
  }

  void add_tangent(const Vector& u, const Vector& v, Matrix& dp_du, Matrix& dp_dv) const override {
    if (other_) other_->add_tangent(u, v, dp_du, dp_dv);
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (contacts_[j].gap_at(u) < 0.0)
        dp_du += stiffnesses_[j] * contacts_[j].direction * contacts_[j].direction.transpose();
  }

 private:
  std::vector<model::Contact<Dof>> contacts_;
  std::vector<double> stiffnesses_;
  std::shared_ptr<const model::NonlinearForce<Dof>> other_;
};

}  // namespace

template <int Dof>
model::ImpactProblem<Dof> with_springs(model::ImpactProblem<Dof> problem,
                                       std::vector<double> stiffnesses) {
  problem.system.nonlinear = std::make_shared<PenaltyForce<Dof>>(
      problem.contacts, std::move(stiffnesses), std::move(problem.system.nonlinear));
  return problem;
}

template model::ImpactProblem<1> with_springs(model::ImpactProblem<1>, std::vector<double>);
template model::ImpactProblem<2> with_springs(model::ImpactProblem<2>, std::vector<double>);
template model::ImpactProblem<> with_springs(model::ImpactProblem<>, std::vector<double>);

const std::vector<Field<Penalty>>& Penalty::fields() {
  static const std::vector<Field<Penalty>> all = {{"stiffness", "0 < stiffness < infinity",
                                                   "of the contact spring [N/m]",
                                                   &Penalty::stiffness, "1e4 k1 or more"}};
  return all;
}

void Penalty::validate() const {
  if (!std::isnan(stiffness)) require_positive(name, "stiffness", stiffness);
}

Claim Penalty::claim(const Facts&) const {
  return {Behaviour::stagnating, 0.0, "contact-stiffness"};
}

template <int Dof>
std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<Dof>& problem) const {
  std::vector<double> all;
  if (!std::isnan(stiffness)) {
    all.assign(problem.contacts.size(), stiffness);
    return all;
  }
  const ContactSet<Dof> contacts(problem);
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const auto i = first_touched(problem.contacts[j]);
    // pi sqrt(m_e / k) <= 2 pi / omega / contacts_per_period, solved for k.
    const double shortest = 0.25 * contacts_per_period * contacts_per_period *
                            fastest_squared(problem.system, problem.contacts[j]) /
                            contacts.inverse_effective_mass(j);
    all.push_back(std::max(default_factor * problem.system.stiffness(i, i), shortest));
  }
  return all;
}

std::optional<Objection> Penalty::objection_to(const Facts& method) const {
  if (!method.is_linear_only) return std::nullopt;
  return Objection{method.name +
                       ": the force of a compliant contact is nonlinear, and the step is exact for "
                       "linear ones alone. Use event-driven.",
                   "linear-only"};
}

std::optional<Objection> Penalty::objection(const Facts& method,
                                            const model::ImpactProblem<>& problem) const {
  for (const auto& contact : problem.contacts) {
    if (contact.restitution != 1.0)
      return Objection{
          fmt::format("{} with eta = {}: a linear penalty spring gives back what it takes, "
                      "so it can only stand for eta = 1. Use event-driven.",
                      method.name, contact.restitution),
          "penalty-needs-elastic"};
  }
  const auto all = stiffnesses(problem);
  for (std::size_t j = 0; j < all.size(); ++j)
    if (!(all[j] > 0.0))
      return Objection{
          fmt::format("{}: contact {} has no default stiffness, since degree of freedom {}, "
                      "the first in its row, has none of its own. Give one: "
                      "penalty:stiffness=VALUE, in N/m.",
                      method.name, j + 1, first_touched(problem.contacts[j]) + 1),
          "no-default-stiffness"};
  return std::nullopt;
}

double Penalty::contact_time(const model::ImpactProblem<>& problem) const {
  const ContactSet<model::any_dof> contacts(problem);
  const auto all = stiffnesses(problem);
  double shortest = 0.0;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double time = std::numbers::pi / std::sqrt(all[j] * contacts.inverse_effective_mass(j));
    shortest = j == 0 ? time : std::min(shortest, time);
  }
  return shortest;
}

template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<1>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<2>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<>&) const;

/// A run with penalty springs.
template <int Dof>
class Penalty::Loop {
 public:
  using State = model::State<Dof>;

  Loop(const Integrator& integrator, const Penalty& penalty, const model::ImpactProblem<Dof>& rigid,
       const StepPlan& plan)
      : problem_(with_springs(rigid, penalty.stiffnesses(rigid))),
        time_loop_(plan, problem_.dof()),
        stepper_(integrator.stepper(problem_.system, plan)),
        at_(problem_.start) {
    touches_.reserve(problem_.contacts.size());
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    stepper_->reset();
    searches_ = 0;
    stepper_->restart(problem_.start);
    steps_ = time_loop_.run(*this, problem_.start, out);
  }

  model::Work work() const {
    model::Work work;
    work.steps = steps_;
    work.event_searches = searches_;
    stepper_->add_work(work);
    return work;
  }

  AnyStepper<Dof>& stepper() { return *stepper_; }

  bool is_quiet(const State& before, const State& now) const {
    for (const auto& contact : problem_.contacts)
      if (contact.gap_at(before.u) >= 0.0 && contact.gap_at(now.u) < 0.0) return false;
    return true;
  }

  // Reports the contacts first touched in this step, in order of time.
  Handled handle(const State& before, const State& now, Recorder<Dof>& out) {
    touches_.clear();
    for (std::size_t i = 0; i < problem_.contacts.size(); ++i) {
      const auto& contact = problem_.contacts[i];
      const double g0 = contact.gap_at(before.u), g1 = contact.gap_at(now.u);
      if (!(g0 >= 0.0 && g1 < 0.0)) continue;
      const double length = now.t - before.t;
      const auto bracket =
          numerics::shrink([&](double s) { return contact.gap_at(stepper_->partial(before, s).u); },
                           {0.0, g0, length, g1}, std::numeric_limits<double>::epsilon() * length);
      touches_.push_back({bracket.a, static_cast<int>(i)});
      ++searches_;
    }
    std::sort(touches_.begin(), touches_.end(),
              [](const Touch& one, const Touch& other) { return one.s < other.s; });
    for (const auto& [s, contact] : touches_) {
      at_ = before;
      if (s > 0.0) at_ = stepper_->partial(before, s);
      at_.t = std::min(before.t + s, now.t);
      if (!out.impact(at_, contact, at_.v, 0.0)) return Handled::ended;
    }
    if (!stepper_->failed()) return Handled::unchanged;
    out.fail_step(now.t, stepper_->failure());
    return Handled::ended;
  }

 private:
  struct Touch {
    double s;
    int contact;
  };

  model::ImpactProblem<Dof> problem_;
  TimeLoop<Dof> time_loop_;
  std::unique_ptr<AnyStepper<Dof>> stepper_;
  State at_;
  std::vector<Touch> touches_;
  long long steps_ = 0, searches_ = 0;
};

template Row row<Penalty>();

}  // namespace clackers::methods
