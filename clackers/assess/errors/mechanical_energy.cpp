#include "clackers/assess/errors/mechanical_energy.hpp"

namespace clackers::assess {
namespace {

std::vector<double> row_major(const Eigen::MatrixXd& matrix) {
  std::vector<double> entries;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) entries.push_back(matrix(i, j));
  return entries;
}

}  // namespace

MechanicalEnergy::MechanicalEnergy(const model::SmoothSystem<>& system)
    : dof_(std::size_t(system.dof())),
      mass_(row_major(system.mass)),
      stiffness_(row_major(system.stiffness)) {}

// x' A x, A row-major.
double MechanicalEnergy::form(const std::vector<double>& matrix, const double* x) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < dof_; ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < dof_; ++j) row += matrix[i * dof_ + j] * x[j];
    sum += x[i] * row;
  }
  return sum;
}

}  // namespace clackers::assess
