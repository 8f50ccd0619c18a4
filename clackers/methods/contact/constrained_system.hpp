#pragma once

#include <memory>
#include <vector>

#include "clackers/methods/contact/impact_law.hpp"
#include "clackers/model/system.hpp"

namespace clackers::methods {

/// The structure while some contacts are active, kept closed by a contact force: the same motion equation
/// seen through the projector Q = I - sum_i (M^-1 b_i) b_i^T / (b_i . M^-1 b_i) over the closed
/// contacts, whose rows must not be coupled. From a point u* with every active b_i . u* = gap_i,
///
///     M a + Q^T C Q v + Q^T K Q u + Q^T p(u, v) = Q^T [f(t) - K (u* - Q u*)]
///
/// keeps b_i . v = 0, so any integrator may step it as it stands. The contact force along b_i is
/// the one that makes b_i . a = 0.
template <int Dof>
class ConstrainedSystem {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;
  using State = model::State<Dof>;

  /// Both must outlive this; nothing is constrained.
  ConstrainedSystem(const model::SmoothSystem<Dof>& free, const std::vector<ImpactLaw<Dof>>& laws);
  ConstrainedSystem(const ConstrainedSystem&) = delete;
  ConstrainedSystem& operator=(const ConstrainedSystem&) = delete;

  const model::SmoothSystem<Dof>& system() const { return constrained_; }
  bool is_active(std::size_t contact) const { return is_active_[contact]; }
  bool is_any_active() const { return count_ > 0; }

  /// Adds the constraint of a contact that is closed at `u`.
  void activate(std::size_t contact, const Vector& u);
  /// Removes the constraint of a contact; `u` is where the structure is.
  void deactivate(std::size_t contact, const Vector& u);
  void deactivate_all();

  /// The force [N] along b that would keep a closed contact closed at this instant. A contact does
  /// not pull: where this is negative the contact opens.
  double contact_force(std::size_t contact, const State& now);

 private:
  class ProjectedForce;

  void project(const Vector& u);
  void add_load(double t, std::span<double> force);

  const model::SmoothSystem<Dof>& free_;
  const std::vector<ImpactLaw<Dof>>& laws_;
  model::SmoothSystem<Dof> constrained_;
  std::vector<bool> is_active_;
  int count_ = 0;
  Matrix projector_, matrix_;  // Q
  Vector constant_, force_;
};

}  // namespace clackers::methods
