#include "clackers/methods/method.hpp"

#include <algorithm>

#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::methods {
namespace {

// Whether no load acts, or one that does not change with time.
bool has_constant_load(const model::SmoothSystem<>& system) {
  if (!system.add_load) return true;
  const auto* load = system.add_load.target<model::HarmonicLoad>();
  return load != nullptr &&
         std::ranges::all_of(load->forces(), [](const auto& f) { return f.frequency == 0.0; });
}

// Whether a constant force accelerates a gap towards its contact, or springs accelerate it there.
bool presses(const model::ImpactProblem<>& problem) {
  const auto is_off_rest = [](const auto& contact) { return contact.gap != 0.0; };
  if (!problem.system.stiffness.isZero(0.0) && std::ranges::any_of(problem.contacts, is_off_rest))
    return true;
  const auto* load = problem.system.add_load.target<model::HarmonicLoad>();
  if (load == nullptr) return false;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(problem.dof());
  for (const auto& f : load->forces())
    if (f.frequency == 0.0) force[f.dof] += f.amplitude * std::cos(f.phase);
  const Eigen::VectorXd acceleration = numerics::solved(problem.system.mass, force);
  return std::ranges::any_of(
      problem.contacts, [&](const auto& contact) { return contact.gap_rate(acceleration) < 0.0; });
}

// Whether every step between events is exact to rounding; see ExactUnder. Dry friction is a constant
// load between them.
bool is_exact_on(const Facts& facts, const model::ImpactProblem<>& problem) {
  const auto& system = problem.system;
  if (system.nonlinear || !has_constant_load(system)) return false;
  if (facts.exact_under == ExactUnder::constant_load) return true;
  const bool is_loaded = system.add_load || !problem.frictions.empty();
  if (facts.exact_under == ExactUnder::no_load && !is_loaded) return true;
  const bool is_free = system.stiffness.isZero(0.0) && system.damping.isZero(0.0);
  return is_free && (!is_loaded || facts.smooth_order > 1.5 ||
                     facts.exact_under == ExactUnder::constant_force);
}

}  // namespace

Claim claim_on(const Facts& facts, const model::ImpactProblem<>& problem, bool collides,
               bool shares_impacts, bool opens_at_once) {
  const bool is_of_impacts =
      collides || !problem.frictions.empty() || facts.through_impacts.behaviour == Behaviour::exact;
  Claim claim =
      is_of_impacts ? facts.through_impacts : Claim{Behaviour::proper, facts.smooth_order, {}};
  // How soon a regular law of friction tears loose decides by how much later motion errs.
  if (!problem.frictions.empty() && claim.behaviour == Behaviour::stagnating) return {};
  if (shares_impacts && claim.behaviour == Behaviour::stagnating) return {claim.behaviour, 0.0, {}};
  const bool is_plastic =
      facts.plastic_order > 0.0 && collides && !problem.contacts.empty() &&
      std::ranges::all_of(problem.contacts, [](const auto& c) { return c.restitution == 0.0; });
  if (is_plastic && !opens_at_once) claim.order = facts.plastic_order;
  // An impact that is not located leaves an error of its own.
  const bool keeps_order =
      claim.behaviour == Behaviour::proper && claim.order >= facts.smooth_order;
  if (keeps_order && is_exact_on(facts, problem)) return {Behaviour::exact, 0.0, {}};
  const auto& nonlinear = problem.system.nonlinear;
  if (facts.scatters_pressed && collides && claim.behaviour == Behaviour::proper &&
      (is_plastic ? opens_at_once : nonlinear || presses(problem)))
    claim.behaviour = Behaviour::irregular;
  if (claim.order > 0.0 && nonlinear && nonlinear->has_kinks())
    return {Behaviour::irregular, std::min(2.0, facts.smooth_order), {}};
  return claim;
}

}  // namespace clackers::methods
