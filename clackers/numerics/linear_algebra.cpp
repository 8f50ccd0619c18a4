#include "clackers/numerics/linear_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace clackers::numerics {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using GeneralizedSolver = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>;

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

MatrixXd solved(const MatrixXd& a, const MatrixXd& b) { return a.llt().solve(b); }

VectorXd least_squares(const MatrixXd& a, const VectorXd& b, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  if (threshold >= 0.0) qr.setThreshold(threshold);
  return qr.solve(b);
}

std::optional<NormalModes> normal_modes(const MatrixXd& stiffness, const MatrixXd& mass) {
  const GeneralizedSolver solver(stiffness, mass);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return NormalModes{solver.eigenvalues(), solver.eigenvectors()};
}

double highest_square(const MatrixXd& stiffness, const MatrixXd& mass) {
  return GeneralizedSolver(stiffness, mass, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const MatrixXd& a) { return a.eigenvalues(); }

}  // namespace clackers::numerics
