#include "clackers/numerics/realization.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "clackers/base/error.hpp"

namespace clackers::numerics {
namespace {

// What is seen less than this part of the strongest is rounding.
constexpr double least_seen = 1e-10;

void require_samples(std::span<const Eigen::MatrixXd> samples) {
  bool fits = samples.size() >= 3;
  for (const auto& sample : samples)
    fits = fits && sample.size() > 0 && sample.rows() == samples[0].rows() &&
           sample.cols() == samples[0].cols() && sample.allFinite();
  if (!fits)
    refuse("realization", "samples", double(samples.size()),
           "at least three finite matrices of one size");
}

// The block Hankel matrix whose block (i, j) is samples[i + j + shift].
Eigen::MatrixXd hankel(std::span<const Eigen::MatrixXd> samples, Eigen::Index blocks,
                       Eigen::Index shift) {
  const auto rows = samples[0].rows(), columns = samples[0].cols();
  Eigen::MatrixXd matrix(blocks * rows, blocks * columns);
  for (Eigen::Index i = 0; i < blocks; ++i)
    for (Eigen::Index j = 0; j < blocks; ++j)
      matrix.block(i * rows, j * columns, rows, columns) =
          samples[static_cast<std::size_t>(i + j + shift)];
  return matrix;
}

}  // namespace

std::vector<std::complex<double>> eigenvalues_of_iterates(
    std::span<const Eigen::MatrixXd> samples) {
  require_samples(samples);
  const auto blocks = static_cast<Eigen::Index>(samples.size() / 2);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(hankel(samples, blocks, 0),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& seen = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < seen.size() && seen[rank] > least_seen * seen[0]) ++rank;
  if (rank == 0) return {};
  const Eigen::VectorXd scale = seen.head(rank).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd map = scale.asDiagonal() * svd.matrixU().leftCols(rank).transpose() *
                              hankel(samples, blocks, 1) * svd.matrixV().leftCols(rank) *
                              scale.asDiagonal();
  const Eigen::VectorXcd found = map.eigenvalues();
  return {found.begin(), found.end()};
}

}  // namespace clackers::numerics
