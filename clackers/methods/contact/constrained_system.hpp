#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/model/system.hpp"
#include "clackers/numerics/banded.hpp"

namespace clackers::methods {

/// The structure while some contacts are active, kept closed by contact forces: the same motion
/// equation seen through the projector Q = I - M^-1 B_a^T W_aa^-1 B_a over the active contacts,
/// with their part W_aa of the Delassus matrix. From a point u* where all of them are closed,
///
///     M a + Q^T C Q v + Q^T K Q u + Q^T p(u, v) = Q^T [f(t) - K (u* - Q u*)]
///
/// keeps B_a v = 0, so any integrator may step it as it stands. The contact forces are those that
/// make B_a a = 0.
template <int Dof>
class ConstrainedSystem {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;
  using State = model::State<Dof>;
  using Rows = typename ContactSet<Dof>::Rows;

  /// Both must outlive this; nothing is constrained.
  ConstrainedSystem(const model::SmoothSystem<Dof>& free, ContactSet<Dof>& contacts);
  ConstrainedSystem(const ConstrainedSystem&) = delete;
  ConstrainedSystem& operator=(const ConstrainedSystem&) = delete;

  /// Of the active contacts; where there are none, that of the last ones.
  const model::SmoothSystem<Dof>& system() const { return constrained_; }
  bool is_active(std::size_t contact) const { return is_active_[contact]; }
  bool is_any_active() const { return !active_.empty(); }
  Rows active() const { return active_; }

  /// Makes these contacts, closed at `u` and not redundant, the active ones.
  void activate(Rows contacts, const Vector& u);
  /// The same for rows whose rates b . v at `now` are kept, whatever these are.
  void hold(Rows rows, const State& now);

  /// Makes those of `resting` active that stay closed: contacts that are closed with gap rate 0 at
  /// `now`. Their gap accelerations A and forces F solve, with those A0 of the motion without them,
  ///
  ///     0 <= A = W F + A0 _|_ F >= 0
  ///
  /// A contact with A = 0 within rounding is active, also without a force. Forces that vanish at
  /// `now` are decided by their trend on the way to `later`, a state of the same motion or `now`
  /// itself. Returns why there are no such forces, or nothing.
  std::optional<Objection> decide(Rows resting, const State& now, const State& later);

  /// The forces [N] along the rows that keep the active contacts closed at this instant; 0 at the
  /// others. Valid until the next call.
  const Eigen::VectorXd& contact_forces(const State& now);
  /// The acceleration of a gap [m/s^2] under the forces of the active contacts.
  double gap_acceleration(std::size_t contact, const State& now);
  /// The force of an active contact and what its rounding may amount to [N]. A contact does not
  /// pull: where this is negative the contact opens.
  double release_margin(std::size_t contact, const State& now);

 private:
  class ProjectedForce;

  void project(const Vector& u);
  void add_load(double t, std::span<double> force);
  void find_gap_accelerations(const State& now);

  const model::SmoothSystem<Dof>& free_;
  numerics::BandedMatrix<Dof> damping_, stiffness_, damping_size_, stiffness_size_;  // of it
  ContactSet<Dof>& contacts_;
  model::SmoothSystem<Dof> constrained_;
  std::vector<std::size_t> active_;
  std::vector<bool> is_active_;
  numerics::PrincipalCholesky factors_;            // of W_aa
  Matrix projector_, matrix_;                      // Q
  Vector constant_, drift_, force_, size_, part_;  // drift_: growth of constant_ from since_ on
  double since_ = 0.0;
  Eigen::VectorXd solution_, forces_;
  Eigen::VectorXd acceleration_, rounding_, earlier_;  // of the gaps, without contact forces
};

}  // namespace clackers::methods
