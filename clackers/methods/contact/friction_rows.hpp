#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/method.hpp"

// Rows of dry friction, as the methods that take them see them.
namespace clackers::methods {

/// `before` and then the rows of friction as contacts: their responses to impulses.
template <int Dof>
ContactSet<Dof> friction_rows(const model::ImpactProblem<Dof>& problem,
                              std::vector<model::Contact<Dof>> before = {}) {
  for (const auto& f : problem.frictions) before.push_back({f.direction, 0.0, 0.0});
  return {std::move(before), problem.system.mass};
}
/// Contacts and then friction, of a problem that has it.
template <int Dof>
std::optional<ContactSet<Dof>> with_frictions(const model::ImpactProblem<Dof>& problem) {
  if (problem.frictions.empty()) return std::nullopt;
  return friction_rows(problem, problem.contacts);
}

/// Why located stick and slip does not take a problem: rows of friction that share a mass with others or
/// with contacts, and friction of contacts on which more than loads presses.
std::optional<Objection> objection_to_stick_slip(const std::string& who,
                                                 const model::ImpactProblem<>& problem);

/// The law F(s) in place of friction, which is regular: with x = s/width
///
///     F = kinetic tanh x + (limit - kinetic) (x/3) exp((1 - x^2/9)/2)
///
/// odd, steep through 0, within 1 % of the limit at x = 3, beyond tending to the kinetic force.
template <int Dof>
class RegularFriction final : public model::NonlinearForce<Dof> {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;

  /// One width a row [m/s].
  RegularFriction(const model::ImpactProblem<Dof>& problem, std::vector<double> widths)
      : rows_(problem.frictions), widths_(std::move(widths)), other_(problem.system.nonlinear) {}

  void add(const Vector& u, const Vector& v, Vector& p) const override {
    if (other_) other_->add(u, v, p);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double x = rows_[i].sliding_speed(v) / widths_[i];
      const double peak = x / 3.0 * std::exp(0.5 - x * x / 18.0);
      p += (rows_[i].kinetic * std::tanh(x) + (rows_[i].limit - rows_[i].kinetic) * peak) *
           rows_[i].direction;
    }
  }
  void add_tangent(const Vector& u, const Vector& v, Matrix& dp_du, Matrix& dp_dv) const override {
    if (other_) other_->add_tangent(u, v, dp_du, dp_dv);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double x = rows_[i].sliding_speed(v) / widths_[i], cosh = std::cosh(x);
      const double peak = (1.0 - x * x / 9.0) / 3.0 * std::exp(0.5 - x * x / 18.0);
      dp_dv += (rows_[i].kinetic / (cosh * cosh) + (rows_[i].limit - rows_[i].kinetic) * peak) /
               widths_[i] * rows_[i].direction * rows_[i].direction.transpose();
    }
  }

 private:
  std::vector<model::Friction<Dof>> rows_;
  std::vector<double> widths_;
  std::shared_ptr<const model::NonlinearForce<Dof>> other_;  // may be empty
};

}  // namespace clackers::methods
