#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/methods/method.hpp"
#include "clackers/methods/stepping/step_powers.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/numerics/lcp.hpp"
#include "clackers/numerics/spd_solver.hpp"

namespace clackers::methods {

inline Eigen::Index to_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// What impulses P along the rows of the contacts do through an effective matrix A, symmetric
/// positive definite: the mass matrix, or M + theta h C + theta^2 h^2 K of a time-stepping scheme.
template <int Dof>
struct ContactResponse {
  Eigen::Matrix<double, Dof, Eigen::Dynamic> velocity;  ///< A^-1 B^T: v changes by this times P
  Eigen::MatrixXd delassus;  ///< W = B A^-1 B^T: the gap rates B v change by this times P
};

/// All contacts of a problem: the rows b_i of B, gaps g = B u - gap, gap rates U = B v, and the
/// impulses or forces that keep them from being violated, found together as the solution of a
/// linear complementarity problem. Such a solution does not depend on the numbers of the contacts.
///
/// `rows` are the numbers of the contacts that take part, ascending, from 0; vectors of impulses
/// have an entry for every contact of the set, 0 for those that do not take part. After
/// construction nothing is allocated but for a failure.
template <int Dof>
class ContactSet {
 public:
  using Vector = model::Vector<Dof>;
  using Rows = std::span<const std::size_t>;

  explicit ContactSet(const model::ImpactProblem<Dof>& problem)
      : ContactSet(problem.contacts, problem.system.mass) {}
  ContactSet(std::vector<model::Contact<Dof>> contacts, const model::Matrix<Dof>& mass);

  std::size_t size() const { return contacts_.size(); }
  const model::Contact<Dof>& contact(std::size_t i) const { return contacts_[i]; }
  const Vector& row(std::size_t i) const { return contacts_[i].direction; }
  double restitution(std::size_t i) const { return contacts_[i].restitution; }

  /// An entry for every contact, all 0.
  Eigen::VectorXd no_impulses() const { return Eigen::VectorXd::Zero(q_.size()); }

  /// g [m]: open where positive.
  double gap(std::size_t i, const Vector& u) const { return product(i, u) - contacts_[i].gap; }
  /// U = dg/dt [m/s]: closing where negative.
  double gap_rate(std::size_t i, const Vector& v) const { return product(i, v); }
  /// How far from 0 the gap can be by rounding only [m]: n products and the gap, and as much
  /// again for u itself being rounded, twice.
  double rounding(std::size_t i, const Vector& u) const;
  /// How far from 0 the gap rate can be by rounding only [m/s].
  double rate_rounding(std::size_t i, const Vector& v) const;

  /// Of the mass matrix.
  const ContactResponse<Dof>& response() const { return response_; }
  /// Of another effective matrix. `to` keeps its size.
  void respond(const numerics::SpdSolver<Dof>& effective, ContactResponse<Dof>& to) const;
  double inverse_effective_mass(std::size_t i) const;  ///< b . M^-1 b [1/kg]
  /// True where an impulse at one contact changes the gap rate of the other.
  bool are_coupled(std::size_t i, std::size_t j) const;

  /// Impulses P that are 0 outside `rows` and solve there
  ///
  ///     0 <= W P + q _|_ P >= 0
  ///
  /// with W = response.delassus and q, which has an entry for every contact. Returns nothing, or
  /// why there are none: "redundant-contacts" where the rows of B depend linearly on each other,
  /// "complementarity-failed" where rounding hides the solution.
  std::optional<Objection> solve(const ContactResponse<Dof>& response, Rows rows,
                                 const Eigen::VectorXd& q, Eigen::VectorXd& impulses);

  /// Newton's law of restitution at all `rows` at once:
  ///
  ///     v(+) = v(-) + M^-1 B^T P,   0 <= U(+) + eta U(-) _|_ P >= 0
  ///
  /// `v` becomes v(+). Kinetic energy does not grow if all rows close or rest, U(-) <= 0, or if all
  /// eta are equal; so contacts that separate should not take part. eta of `plastic` rows, ascending,
  /// counts as 0. Returns what solve() does; after a failure `v` is unchanged.
  std::optional<Objection> impact(Rows rows, Vector& v, Eigen::VectorXd& impulses,
                                  Rows plastic = {});

  /// "redundant-contacts" where the rows of B depend linearly on each other, or nothing.
  std::optional<Objection> redundancy(Rows rows);

 private:
  double product(std::size_t i, const Vector& x) const {
    if constexpr (Dof == model::any_dof) return gaps_.product(i, x);
    return row(i).dot(x);
  }

  std::vector<model::Contact<Dof>> contacts_;
  Gaps gaps_;
  ContactResponse<Dof> response_;
  numerics::LcpSolver lcp_;
  numerics::PrincipalCholesky factors_;
  Eigen::VectorXd q_;
};

/// The objection of every rigid treatment to a problem that starts with redundant contacts closed;
/// or nothing.
std::optional<Objection> objection_to_closed_contacts(const std::string& who,
                                                      const model::ImpactProblem<>& problem);

extern template class ContactSet<1>;
extern template class ContactSet<2>;
extern template class ContactSet<model::any_dof>;

}  // namespace clackers::methods
