#pragma once

#include <Eigen/Cholesky>
#include <cstddef>
#include <optional>
#include <span>

#include "clackers/model/impact_problem.hpp"

namespace clackers::model {

/// An impact problem as first-order equations for y = (u, v), of size 2 dof: the form that solvers of
/// ordinary differential equations take. The problem must outlive it.
class FirstOrder {
 public:
  explicit FirstOrder(const ImpactProblem<>& problem);

  std::size_t size() const { return 2 * std::size_t(problem_.dof()); }

  /// Writes dy/dt = (v, M^-1 (f(t) - C v - K u - p(u, v))) to `rate`, while nothing collides. Throws InputError
  /// for a problem with dry friction, whose force does not follow from the state where nothing slides.
  void rate(double t, std::span<const double> y, std::span<double> rate) const;
  /// g = b . u - gap of a contact [m]. Throws InputError for a contact that is not there.
  double gap(std::span<const double> y, std::size_t contact) const;
  /// Writes the state after an impact at a contact to `after`, by Newton's law of restitution:
  ///
  ///     v(+) = v(-) - (1 + eta) (b . v(-)) / (b . M^-1 b) M^-1 b
  ///
  /// Without a contact given, at the one whose gap is nearest to 0. Throws InputError where it opens,
  /// b . v(-) > 0, and where there is no such contact.
  void impact(std::span<const double> y, std::optional<std::size_t> contact,
              std::span<double> after) const;

 private:
  const Contact<>& contact_at(std::size_t number) const;
  std::size_t nearest_contact(std::span<const double> y) const;

  const ImpactProblem<>& problem_;
  Eigen::LLT<Eigen::MatrixXd> mass_;
};

}  // namespace clackers::model
