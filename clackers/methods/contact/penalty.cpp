#include "clackers/methods/contact/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/methods/contact/compliant_force.hpp"
#include "clackers/methods/contact/friction_rows.hpp"
#include "clackers/methods/rows.hpp"
#include "clackers/methods/stepping/time_loop.hpp"
#include "clackers/numerics/roots.hpp"

namespace clackers::methods {
namespace {

constexpr double default_factor = 1e4;
constexpr double contacts_per_period = 40.0;
constexpr double share_of_speed = 0.01, steps_a_contact = 25.0;

// The degree of freedom whose stiffness sets the default of a contact.
template <int Dof>
Eigen::Index first_touched(const model::Contact<Dof>& contact) {
  Eigen::Index i = 0;
  while (contact.direction[i] == 0.0) ++i;
  return i;
}

// With the stiffness that smooth nonlinear springs have at u = 0.
template <int Dof>
model::SmoothSystem<Dof> linearized(model::SmoothSystem<Dof> system) {
  if (!system.nonlinear || system.nonlinear->has_kinks()) return system;
  const model::Vector<Dof> zero = model::Vector<Dof>::Zero(system.dof());
  model::Matrix<Dof> damping = system.damping;
  system.nonlinear->add_tangent(zero, zero, system.stiffness, damping);
  return system;
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

// The largest approach speed of a contact that the energy at the start allows; 0 for a linear law,
// which has one contact time at every speed.
template <int Dof>
double largest_speed(const CompliantLaw& law, const model::ImpactProblem<Dof>& problem,
                     double mass) {
  if (law.exponent == 1.0) return 0.0;
  const auto& [t, u, v] = problem.start;
  const auto& system = problem.system;
  double energy = 0.5 * (v.dot(system.mass * v) + u.dot(system.stiffness * u));
  if (system.nonlinear && !system.nonlinear->has_kinks()) energy += system.nonlinear->potential(u);
  return std::sqrt(2.0 * std::max(energy, 0.0) / mass);
}

}  // namespace

const std::vector<Field<Penalty>>& Penalty::fields() {
  static const std::vector<Field<Penalty>> all = [] {
    Field<Penalty> law_field{"law", {}, "force of penetration and its rate", &Penalty::law};
    for (const auto& row : compliant_laws())
      law_field.words.push_back(
          {std::string(row.name), std::string(row.summary), std::string(row.source)});
    return std::vector<Field<Penalty>>{
        law_field,
        {"stiffness", "0 < stiffness < infinity", "k of the law [N/m], or [N/m^1.5]",
         &Penalty::stiffness, "1e4 k1 or more, or of the same contact time"},
        {"width", "0 < width < infinity", "sliding speed of the regular law of friction [m/s]",
         &Penalty::width, "a hundredth of limit/(m_e omega)"}};
  }();
  return all;
}

void Penalty::validate() const {
  if (!std::isnan(stiffness)) require_positive(name, "stiffness", stiffness);
  if (!std::isnan(width)) require_positive(name, "width", width);
}

Claim Penalty::claim(const Facts&) const {
  return {Behaviour::stagnating, 0.0, "contact-stiffness"};
}

// The masses are late by a part of the contact time at each impact.
double Penalty::model_order() const { return 1.0 / (compliant_law(law).exponent + 1.0); }

template <int Dof>
std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<Dof>& problem) const {
  std::vector<double> all;
  if (!std::isnan(stiffness)) {
    all.assign(problem.contacts.size(), stiffness);
    return all;
  }
  const auto& chosen = compliant_law(law);
  const auto system = linearized(problem.system);
  const ContactSet<Dof> contacts(problem);
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const auto& contact = problem.contacts[j];
    const auto i = first_touched(contact);
    // pi sqrt(m_e / k) <= 2 pi / omega / contacts_per_period, solved for k.
    const double mass = 1.0 / contacts.inverse_effective_mass(j);
    const double shortest =
        0.25 * contacts_per_period * contacts_per_period * fastest_squared(system, contact) * mass;
    const double linear = std::max(default_factor * system.stiffness(i, i), shortest);
    all.push_back(chosen.exponent == 1.0
                      ? linear
                      : chosen.stiffness_for(std::numbers::pi * std::sqrt(mass / linear), mass,
                                             largest_speed(chosen, problem, mass)));
  }
  return all;
}

std::optional<Objection> Penalty::objection_to(const Facts& method) const {
  if (!method.is_linear_only) return std::nullopt;
  return Objection{method.name +
                       ": the force of a compliant contact is nonlinear, and the step is exact for "
                       "linear ones only. Use event-driven.",
                   "linear-only"};
}

std::optional<Objection> Penalty::objection(const Facts& method,
                                            const model::ImpactProblem<>& problem) const {
  if (!problem.frictions.empty() && !problem.contacts.empty())
    return Objection{
        method.name +
            ": the problem has friction and contacts, but regular friction is taken of a constant "
            "normal force only, without contacts. Use event-driven or moreau-jean.",
        "linear-only"};
  for (const double w : widths(problem))
    if (!(w > 0.0 && std::isfinite(w)))
      return Objection{
          method.name +
              ": the problem has friction on a mass without a spring of its own, so that "
              "its law has no default width. Give one: penalty:width=VALUE, in m/s.",
          "no-default-stiffness"};
  const auto& chosen = compliant_law(law);
  for (const auto& contact : problem.contacts) {
    const double eta = contact.restitution;
    if (chosen.models(eta)) continue;
    if (chosen.restitution == CompliantLaw::Restitution::elastic)
      return Objection{
          fmt::format("{} with eta = {}: the law {} is elastic, so it models only eta = 1. Use "
                      "penalty:law=kelvin-voigt or "
                      "event-driven.",
                      method.name, eta, law),
          "penalty-needs-elastic"};
    return Objection{
        fmt::format("{} with eta = {}: the law {} has infinite damping there; allowed: "
                    "0 < eta <= 1. Use penalty:law=kelvin-voigt or event-driven.",
                    method.name, eta, law),
        "law-needs-restitution"};
  }
  const auto all = stiffnesses(problem);
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (all[j] > 0.0 && std::isfinite(all[j])) continue;
    const auto i = first_touched(problem.contacts[j]);
    const auto why =
        linearized(problem.system).stiffness(i, i) > 0.0
            ? std::string("the problem starts without energy, so that no approach speed is known")
            : fmt::format("degree of freedom {}, the first in its row, has none of its own", i + 1);
    return Objection{
        fmt::format("{}: contact {} has no default stiffness, since {}. Give one: "
                    "penalty:stiffness=VALUE, in {}.",
                    method.name, j + 1, why, chosen.exponent == 1.0 ? "N/m" : "N/m^1.5"),
        "no-default-stiffness"};
  }
  return std::nullopt;
}

double Penalty::contact_time(const model::ImpactProblem<>& problem) const {
  const auto& chosen = compliant_law(law);
  const ContactSet<model::any_dof> contacts(problem);
  const auto all = stiffnesses(problem);
  double shortest = std::numeric_limits<double>::infinity();
  const auto rows = friction_rows(problem);
  const auto speeds = widths(problem);
  for (std::size_t j = 0; j < rows.size(); ++j)
    shortest =
        std::min(shortest, steps_a_contact * speeds[j] /
                               (rows.inverse_effective_mass(j) * problem.frictions[j].limit));
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const double mass = 1.0 / contacts.inverse_effective_mass(j);
    shortest =
        std::min(shortest, chosen.contact_time(all[j], mass, largest_speed(chosen, problem, mass)));
  }
  return std::isfinite(shortest) ? shortest : 0.0;
}

template <int Dof>
std::vector<double> Penalty::widths(const model::ImpactProblem<Dof>& problem) const {
  const auto rows = friction_rows(problem);
  std::vector<double> all;
  for (std::size_t j = 0; j < rows.size(); ++j)
    all.push_back(!std::isnan(width)
                      ? width
                      : share_of_speed * problem.frictions[j].limit *
                            rows.inverse_effective_mass(j) /
                            std::sqrt(fastest_squared(problem.system, rows.contact(j))));
  return all;
}

template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<1>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<2>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<>&) const;

template <int Dof>
model::ImpactProblem<Dof> Penalty::with_regular_friction(model::ImpactProblem<Dof> problem) const {
  if (!problem.frictions.empty())
    problem.system.nonlinear = std::make_shared<RegularFriction<Dof>>(problem, widths(problem));
  return problem;
}

/// A run with compliant contacts, or with regular friction.
template <int Dof>
class Penalty::Loop {
 public:
  using State = model::State<Dof>;

  Loop(const Integrator& integrator, const Penalty& penalty, const model::ImpactProblem<Dof>& rigid,
       const StepPlan& plan)
      : problem_(penalty.with_regular_friction(rigid)),
        force_(std::make_shared<CompliantForce<Dof>>(compliant_law(penalty.law), problem_,
                                                     penalty.stiffnesses(rigid))),
        time_loop_(plan, problem_),
        contacts_(problem_),
        at_(problem_.start) {
    problem_.system.nonlinear = force_;
    stepper_ = integrator.stepper(problem_.system, plan);
    touches_.reserve(problem_.contacts.size());
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void advance(Recorder<Dof>& out) {
    stepper_->reset();
    searches_ = 0;
    force_->open_all();
    stepper_->restart(problem_.start);
    steps_ = time_loop_.run(*this, problem_.start, out);
  }

  model::Work work() const { return work_of(steps_, searches_, *stepper_); }

  AnyStepper<Dof>& stepper() { return *stepper_; }

  bool is_open() const { return force_->vanishes(); }

  bool is_quiet(const State& before, const State& now) const {
    for (std::size_t j = 0; j < problem_.contacts.size(); ++j)
      if (force_->is_closed(j) ? has_left(j, before) : contacts_.gap(j, now.u) < 0.0) return false;
    return true;
  }

  // Opens contacts that were left before the step and closes those touched in it, which it reports in
  // order of time. Forces change, so the step is made anew.
  Handled handle(const State& before, const State& now, Recorder<Dof>& out) {
    touches_.clear();
    for (std::size_t j = 0; j < problem_.contacts.size(); ++j)
      if (is_touched(j, before, now)) touches_.push_back({touch_time(j, before, now), j, 0.0});
    std::sort(touches_.begin(), touches_.end(),
              [](const Touch& first, const Touch& other) { return first.s < other.s; });
    for (auto& [s, j, w0] : touches_) {
      at_ = before;
      if (s > 0.0) at_ = stepper_->partial(before, s);
      at_.t = std::min(before.t + s, now.t);
      w0 = -contacts_.gap_rate(j, at_.v);
      if (!out.impact(at_, static_cast<int>(j), at_.v, 0.0)) return Handled::ended;
    }
    if (stepper_->failed()) {
      out.fail_step(now.t, stepper_->failure());
      return Handled::ended;
    }
    for (std::size_t j = 0; j < problem_.contacts.size(); ++j)
      if (force_->is_closed(j) && has_left(j, before)) force_->open(j);
    for (const auto& [s, j, w0] : touches_) force_->close(j, w0);
    return Handled::unchanged;
  }

 private:
  struct Touch {
    double s;
    std::size_t contact;
    double w0;
  };

  bool has_left(std::size_t j, const State& at) const {
    return contacts_.gap(j, at.u) >= 0.0 && contacts_.gap_rate(j, at.v) > 0.0;
  }

  bool is_touched(std::size_t j, const State& before, const State& now) const {
    return (!force_->is_closed(j) || has_left(j, before)) && contacts_.gap(j, now.u) < 0.0;
  }

  // After `before`; 0 where the contact is violated there, because it was left and touched again in
  // the step that ends there.
  double touch_time(std::size_t j, const State& before, const State& now) {
    const double g0 = contacts_.gap(j, before.u), g1 = contacts_.gap(j, now.u);
    if (!(g0 >= 0.0)) return 0.0;
    const double length = now.t - before.t;
    ++searches_;
    return numerics::shrink(
               [&](double s) { return contacts_.gap(j, stepper_->partial(before, s).u); },
               {0.0, g0, length, g1}, std::numeric_limits<double>::epsilon() * length)
        .a;
  }

  model::ImpactProblem<Dof> problem_;
  std::shared_ptr<CompliantForce<Dof>> force_;
  TimeLoop<Dof> time_loop_;
  ContactSet<Dof> contacts_;
  std::unique_ptr<AnyStepper<Dof>> stepper_;
  State at_;
  std::vector<Touch> touches_;
  long long steps_ = 0, searches_ = 0;
};

template Row row<Penalty>();

}  // namespace clackers::methods
