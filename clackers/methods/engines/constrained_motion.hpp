#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clackers/numerics/modes/modal_form.hpp"

namespace clackers::methods {

/// How a linear structure moves without a load while a set of contacts is kept closed: u - rest is a
/// sum of modes in the subspace b_i . u = 0 of the closed contacts.
struct ConstrainedMotion {
  std::vector<bool> is_active;  ///< the contacts that are kept closed
  Eigen::VectorXd rest;         ///< displacement at rest [m]
  numerics::ModalSystem modes;  ///< of u - rest
  /// Of each contact the gap [m]; of an active one the contact force along b [N], which is negative
  /// where it would have to pull.
  std::vector<numerics::ModalForm> forms;

  void to_modes(std::span<const double> u, std::span<const double> v,
                std::span<numerics::ModalState> states) const;
  void sample(std::span<const numerics::ModalState> start, double s, std::span<double> u,
              std::span<double> v) const;

 private:
  mutable Eigen::VectorXd from_rest_;
};

/// The constrained motions of one structure, each made when it is first asked for.
class ConstrainedMotions {
 public:
  /// M, C, K; a row of `rows` is the direction b of a contact.
  ConstrainedMotions(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
                     const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& rows,
                     const Eigen::VectorXd& gaps);

  /// Null where the motion is no sum of modes. The active rows must not depend linearly on each other.
  const ConstrainedMotion* of(const std::vector<bool>& is_active);

 private:
  std::optional<ConstrainedMotion> make(const std::vector<bool>& is_active) const;

  Eigen::MatrixXd mass_, damping_, stiffness_, rows_;
  Eigen::VectorXd gaps_;
  std::vector<std::unique_ptr<const ConstrainedMotion>> made_;
};

}  // namespace clackers::methods
