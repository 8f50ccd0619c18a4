#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "clackers/model/impact_problem.hpp"

// Forces that can be written down as numbers, so that programs and files know them too.
namespace clackers::model {

/// The force amplitude cos(frequency t + phase) on one degree of freedom; constant for frequency 0.
struct HarmonicForce {
  int dof = 0;             ///< from 0
  double amplitude = 0.0;  ///< [N]
  double frequency = 0.0;  ///< [rad/s], >= 0
  double phase = 0.0;      ///< [rad]
};

/// A Load that is a sum of harmonic forces: `add_load.target<HarmonicLoad>()` finds it again.
class HarmonicLoad {
 public:
  explicit HarmonicLoad(std::vector<HarmonicForce> forces) : forces_(std::move(forces)) {}
  void operator()(double t, std::span<double> force) const {
    for (const auto& f : forces_)
      force[std::size_t(f.dof)] += f.amplitude * std::cos(f.frequency * t + f.phase);
  }
  const std::vector<HarmonicForce>& forces() const { return forces_; }

 private:
  std::vector<HarmonicForce> forces_;
};

/// Linear springs that act in compression alone: p = sum_j stiffness_j min(g_j, 0) b_j, with the
/// gaps g_j = b_j . u - gap_j of `contacts`, whose restitution has no meaning here.
class OneSidedSprings final : public NonlinearForce<any_dof> {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// One stiffness a contact [N/m].
  OneSidedSprings(std::vector<Contact<>> contacts, std::vector<double> stiffnesses)
      : contacts_(std::move(contacts)), stiffnesses_(std::move(stiffnesses)) {}

  void add(const Vector& u, const Vector&, Vector& p) const override {
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (const double g = contacts_[j].gap_at(u); g < 0.0)
        p += stiffnesses_[j] * g * contacts_[j].direction;
  }
  void add_tangent(const Vector& u, const Vector&, Matrix& dp_du, Matrix&) const override {
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (contacts_[j].gap_at(u) < 0.0)
        dp_du += stiffnesses_[j] * contacts_[j].direction * contacts_[j].direction.transpose();
  }
  bool add_tangent_rows(const Vector& u, const Vector&,
                        std::vector<TangentRow>& rows) const override {
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (contacts_[j].gap_at(u) < 0.0)
        rows.push_back({&contacts_[j].direction, stiffnesses_[j], 0.0});
    return true;
  }

  double potential(const Vector& u) const override {
    double sum = 0.0;
    for (std::size_t j = 0; j < contacts_.size(); ++j) {
      const double g = std::min(contacts_[j].gap_at(u), 0.0);
      sum += 0.5 * stiffnesses_[j] * g * g;
    }
    return sum;
  }
  bool has_kinks() const override { return true; }

  const std::vector<Contact<>>& contacts() const { return contacts_; }
  const std::vector<double>& stiffnesses() const { return stiffnesses_; }

 private:
  std::vector<Contact<>> contacts_;
  std::vector<double> stiffnesses_;
};

/// The one-sided springs of a problem; nullptr where it has none.
inline const OneSidedSprings* one_sided_springs(const ImpactProblem<>& problem) {
  return dynamic_cast<const OneSidedSprings*>(problem.system.nonlinear.get());
}

}  // namespace clackers::model
