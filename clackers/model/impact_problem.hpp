#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/model/system.hpp"

namespace clackers::model {

/// One row of the contact condition g = b . u - gap >= 0 with Newton's law of restitution:
/// at an impact b . v(+) = -restitution b . v(-), by an impulse along b.
template <int Dof = any_dof>
struct Contact {
  Vector<Dof> direction;     ///< b, dimensionless; (1, -1) keeps mass 1 above mass 2
  double gap = 0.0;          ///< [m]; contact happens at b . u = gap
  double restitution = 1.0;  ///< eta in [0, 1]; 1 is elastic

  /// g [m]: open where positive.
  double gap_at(const Vector<Dof>& u) const { return direction.dot(u) - gap; }
  /// dg/dt [m/s]: closing where negative.
  double gap_rate(const Vector<Dof>& v) const { return direction.dot(v); }
};

/// Dry friction along b: with the sliding speed s = b . v - velocity the structure feels -kinetic sgn(s) b,
/// and where s = 0 the force lambda b, |lambda| <= limit, that keeps it so; C. A. Coulomb (1785). Of a contact
/// limit = kinetic is a coefficient, times the force of the contact; at an impact of impulse P the same
/// holds of the impulse, at most limit P, and of s after it.
template <int Dof = any_dof>
struct Friction {
  Vector<Dof> direction;                 ///< b, dimensionless
  double limit = 0.0;                    ///< of the static force [N], of a contact over its force
  double kinetic = 0.0;                  ///< force while it slides, at most the limit
  double velocity = 0.0;                 ///< b . v at which nothing slides [m/s]: that of a belt
  std::optional<std::size_t> contact{};  ///< from 0; nothing: of a constant normal force

  /// s [m/s].
  double sliding_speed(const Vector<Dof>& v) const { return direction.dot(v) - velocity; }
};

/// The contact that keeps u_i - u_j >= 0, of `dof` displacements.
inline Contact<> contact_between(Eigen::Index dof, Eigen::Index i, Eigen::Index j,
                                 double restitution = 1.0) {
  Contact<> contact{Eigen::VectorXd::Zero(dof), 0.0, restitution};
  contact.direction[i] = 1.0;
  contact.direction[j] = -1.0;
  return contact;
}

/// All that a method sees of a task: a structure, where it may collide, how it starts, and when
/// the run ends [s].
template <int Dof = any_dof>
struct ImpactProblem {
  SmoothSystem<Dof> system;
  std::vector<Contact<Dof>> contacts;  ///< empty: no contact anywhere
  State<Dof> start;
  double end = 0.0;
  std::vector<Friction<Dof>> frictions{};
  /// A law that the motion obeys and no row states, in words; no method takes such a problem.
  std::string unstated{};

  /// No row says where impacts are: none can be looked for or counted.
  bool has_unstated_impacts() const { return contacts.empty() && !unstated.empty(); }

  Eigen::Index dof() const { return system.dof(); }
};

/// The first entry (i, j), i < j, that differs from (j, i) by more than rounding: 4 units of itself and 32 n units of
/// sqrt |x_ii x_jj|, which bounds it in a positive definite matrix.
std::optional<std::pair<Eigen::Index, Eigen::Index>> asymmetric_entry(const Eigen::MatrixXd& x);
/// The refusal of it.
std::string text_of_asymmetry(std::string_view name, const Eigen::MatrixXd& x,
                              const std::pair<Eigen::Index, Eigen::Index>& entry);

/// Throws InputError unless sizes fit, all numbers are finite, the mass matrix is symmetric
/// positive definite, damping and stiffness are symmetric, restitutions lie in [0, 1], no contact
/// is violated at the start, the forces of friction are 0 <= kinetic <= limit, of a contact of the problem
/// kinetic = limit, and the end lies after the start.
void validate(const ImpactProblem<>& problem);

/// The same problem with its number of degrees of freedom known at compile time (Dof is 1, 2 or
/// any_dof); its nonlinear force is then not for several threads at once. Throws InputError if the sizes
/// differ.
template <int Dof>
ImpactProblem<Dof> with_dof(const ImpactProblem<>& problem);

}  // namespace clackers::model
