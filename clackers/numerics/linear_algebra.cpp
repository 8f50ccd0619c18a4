#include "clackers/numerics/linear_algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "clackers/base/error.hpp"

namespace clackers::numerics {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using GeneralizedSolver = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>;

namespace {

// What is seen less than this part of the strongest is rounding.
constexpr double least_seen = 1e-10;

void require_samples(std::span<const MatrixXd> samples) {
  bool fits = samples.size() >= 3;
  for (const auto& sample : samples)
    fits = fits && sample.size() > 0 && sample.rows() == samples[0].rows() &&
           sample.cols() == samples[0].cols() && sample.allFinite();
  if (!fits)
    refuse("realization", "samples", double(samples.size()),
           "at least three finite matrices of one size");
}

// The block Hankel matrix whose block (i, j) is samples[i + j + shift].
MatrixXd hankel(std::span<const MatrixXd> samples, Eigen::Index blocks, Eigen::Index shift) {
  const auto rows = samples[0].rows(), columns = samples[0].cols();
  MatrixXd matrix(blocks * rows, blocks * columns);
  for (Eigen::Index i = 0; i < blocks; ++i)
    for (Eigen::Index j = 0; j < blocks; ++j)
      matrix.block(i * rows, j * columns, rows, columns) =
          samples[static_cast<std::size_t>(i + j + shift)];
  return matrix;
}

}  // namespace

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

Cholesky::Cholesky(const MatrixXd& a) : factors_(a) {}

bool Cholesky::is_definite(const MatrixXd& a, double rounding) const {
  if (factors_.info() != Eigen::Success) return false;
  const auto pivots = factors_.matrixLLT().diagonal().array().square();
  return (pivots > rounding * a.diagonal().array()).all();
}

MatrixXd Cholesky::solve(const MatrixXd& b) const { return factors_.solve(b); }

MatrixXd solved(const MatrixXd& a, const MatrixXd& b) { return Cholesky(a).solve(b); }

MatrixXd product_of_halves(const Eigen::Ref<const MatrixXd>& a, const MatrixXd& x) {
  const auto half = a.cols() / 2;
  if (a.rightCols(half).isZero(0.0)) return a.leftCols(half) * x.topRows(half);
  if (a.leftCols(half).isZero(0.0)) return a.rightCols(half) * x.bottomRows(half);
  return a * x;
}

MatrixXd shortest_solution(const MatrixXd& a, const MatrixXd& b) {
  return Eigen::CompleteOrthogonalDecomposition<MatrixXd>(a).solve(b);
}

// In L^T Z they are the orthogonal complement of L^-1 rows^T.
MatrixXd unseen_directions(const MatrixXd& rows, const MatrixXd& mass) {
  const auto count = rows.cols() - rows.rows();
  if (count == 0) return MatrixXd(rows.cols(), 0);
  const Eigen::LLT<MatrixXd> factors(mass);
  const MatrixXd seen = factors.matrixL().solve(rows.transpose());
  const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(seen).householderQ();
  return factors.matrixU().solve(q.rightCols(count));
}

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

std::vector<std::complex<double>> eigenvalues_of_iterates(std::span<const MatrixXd> samples) {
  require_samples(samples);
  const auto blocks = static_cast<Eigen::Index>(samples.size() / 2);
  const Eigen::JacobiSVD<MatrixXd> svd(hankel(samples, blocks, 0),
                                       Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& seen = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < seen.size() && seen[rank] > least_seen * seen[0]) ++rank;
  if (rank == 0) return {};
  const VectorXd scale = seen.head(rank).cwiseSqrt().cwiseInverse();
  const MatrixXd map = scale.asDiagonal() * svd.matrixU().leftCols(rank).transpose() *
                       hankel(samples, blocks, 1) * svd.matrixV().leftCols(rank) *
                       scale.asDiagonal();
  const Eigen::VectorXcd found = eigenvalues(map);
  return {found.begin(), found.end()};
}

}  // namespace clackers::numerics
