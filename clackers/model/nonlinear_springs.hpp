#pragma once

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/model/impact_problem.hpp"

namespace clackers::model {

/// Springs to the ground whose force is not proportional to the displacement x = b . u, a force along b:
///
///     sine     stiffness length sin(x/length), of a pendulum with the arc x
///     cubic    stiffness x^3
class NonlinearSprings final : public NonlinearForce<any_dof> {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;
  enum class Law { sine, cubic };
  struct Row {
    Vector direction;  ///< b
    Law law = Law::cubic;
    double stiffness = 0.0;  ///< [N/m] or [N/m^3]
    double length = 0.0;     ///< [m]; of `cubic` without meaning

    std::string_view name() const { return law == Law::sine ? "sine" : "cubic"; }
  };

  explicit NonlinearSprings(std::vector<Row> rows) : rows_(std::move(rows)) {}

  void add(const Vector& u, const Vector&, Vector& p) const override {
    for (const auto& row : rows_) {
      const double x = row.direction.dot(u);
      p += row.stiffness *
           (row.law == Law::sine ? row.length * std::sin(x / row.length) : x * x * x) *
           row.direction;
    }
  }
  void add_tangent(const Vector& u, const Vector&, Matrix& dp_du, Matrix&) const override {
    for (const auto& row : rows_) {
      const double x = row.direction.dot(u);
      dp_du += row.stiffness * (row.law == Law::sine ? std::cos(x / row.length) : 3.0 * x * x) *
               row.direction * row.direction.transpose();
    }
  }
  double potential(const Vector& u) const override {
    double sum = 0.0;
    for (const auto& row : rows_) {
      const double x = row.direction.dot(u);
      sum += row.stiffness * (row.law == Law::sine
                                  ? 2.0 * std::pow(row.length * std::sin(0.5 * x / row.length), 2)
                                  : 0.25 * x * x * x * x);
    }
    return sum;
  }

  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;
};

/// The nonlinear springs of a problem; nullptr where it has none.
inline const NonlinearSprings* nonlinear_springs(const ImpactProblem<>& problem) {
  return dynamic_cast<const NonlinearSprings*>(problem.system.nonlinear.get());
}

}  // namespace clackers::model
