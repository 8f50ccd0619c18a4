#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

namespace clackers::numerics {

/// The eigenvalues of an unknown linear map A, from what is seen of its iterates: samples[k] =
/// C A^k X for k = 0, 1, ..., a row an output and a column a start. Eigenvalues that C does not see
/// or X does not excite, relative to the others by more than 1e-10, are not found. By the realization
/// of the smallest dimension: B.-L. Ho, R. E. Kalman, Regelungstechnik 14, 545-548 (1966). Throws
/// InputError for fewer than three samples, for samples of unlike size, and for numbers that are not
/// finite. Empty when all samples are 0.
std::vector<std::complex<double>> eigenvalues_of_iterates(std::span<const Eigen::MatrixXd> samples);

}  // namespace clackers::numerics
