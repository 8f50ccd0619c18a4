// The modes of structures whose damping couples those of mass and stiffness.
#include "clackers/numerics/modes/coupled_modes.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <complex>
#include <vector>

#include "clackers/numerics/modes/modal_flight.hpp"

namespace clackers::numerics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<std::vector<Index>> coupled_blocks(const MatrixXd& a, const MatrixXd& b) {
  const Index n = a.rows();
  const double a_size = rounding_of(a), b_size = rounding_of(b);
  std::vector<std::vector<Index>> blocks;
  std::vector<bool> is_taken(std::size_t(n), false);
  for (Index first = 0; first < n; ++first) {
    if (is_taken[std::size_t(first)]) continue;
    is_taken[std::size_t(first)] = true;
    std::vector<Index> block{first};
    for (std::size_t k = 0; k < block.size(); ++k)
      for (Index j = 0; j < n; ++j) {
        if (is_taken[std::size_t(j)]) continue;
        if (!(std::abs(a(block[k], j)) > a_size || std::abs(b(block[k], j)) > b_size)) continue;
        is_taken[std::size_t(j)] = true;
        block.push_back(j);
      }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

namespace {

constexpr double worst_condition = 1e5;

MatrixXd part(const MatrixXd& x, const std::vector<Index>& rows) {
  MatrixXd made(rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j) made(Index(i), Index(j)) = x(rows[i], rows[j]);
  return made;
}

// Eigenvectors of a symmetric matrix, first those whose eigenvalue is 0 give or take a rounding.
struct Directions {
  MatrixXd vectors;
  VectorXd values;
  Index none = 0;  // eigenvalues that are 0
  Directions(const MatrixXd& x, double rounding) : vectors(x), values(x.rows()) {
    if (x.size() == 0) return;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(x);
    const auto& all = solver.eigenvalues();
    const Index below = (all.array() < -rounding).count();
    none = (all.array() <= rounding).count() - below;
    for (Index i = 0; i < all.size(); ++i) {
      const Index from = i < none ? below + i : i < none + below ? i - none : i;
      vectors.col(i) = solver.eigenvectors().col(from);
      values[i] = i < none ? 0.0 : all[from];
    }
  }
};

}  // namespace

// The modes of a block that damping couples; their shapes in the coordinates of the block. A direction
// without stiffness keeps its displacement, an eigenvalue that is exactly 0: the matrix is of the
// other displacements and of all velocities. One that has no damping either is a mode by itself.
bool ModalSystem::add_coupled(const std::vector<Index>& block, const MatrixXd& damping,
                              const MatrixXd& stiffness) {
  const MatrixXd block_damping = part(damping, block);
  const Directions stiff(part(stiffness, block), rounding_of(stiffness));
  MatrixXd directions = stiff.vectors;
  const auto loose = directions.leftCols(stiff.none);
  const Directions damped(loose.transpose() * block_damping * loose, rounding_of(damping));
  directions.leftCols(stiff.none) = MatrixXd(loose * damped.vectors);
  const auto add = [&](const Mode& mode, const VectorXd& shape, const VectorXd& rate_shape) {
    const auto column = Index(modes_.size());
    for (std::size_t i = 0; i < block.size(); ++i) {
      shapes_(block[i], column) = shape[Index(i)];
      rate_shapes_(block[i], column) = rate_shape[Index(i)];
    }
    modes_.push_back(mode);
  };
  for (Index i = 0; i < damped.none; ++i)
    add(Mode(0.0, 0.0), directions.col(i), VectorXd::Zero(directions.rows()));
  directions = MatrixXd(directions.rightCols(directions.cols() - damped.none));
  const MatrixXd c = directions.transpose() * block_damping * directions;
  const Index m = c.rows(), free = stiff.none - damped.none, held = m - free;
  const VectorXd k = stiff.values.tail(held);
  // In units of time in which all entries are 1 at most.
  const double fast =
      std::max(std::sqrt(stiff.values.cwiseAbs().maxCoeff()), c.cwiseAbs().maxCoeff());
  MatrixXd first_order = MatrixXd::Zero(held + m, held + m);
  first_order.block(0, held + free, held, held).setIdentity();
  first_order.block(held + free, 0, held, held) = MatrixXd((-k / (fast * fast)).asDiagonal());
  first_order.bottomRightCorner(m, m) = -c / fast;
  const Eigen::EigenSolver<MatrixXd> solver(first_order);
  if (solver.info() != Eigen::Success) return false;
  Eigen::VectorXcd values = Eigen::VectorXcd::Zero(2 * m);
  values.tail(held + m) = solver.eigenvalues();
  Eigen::MatrixXcd vectors = Eigen::MatrixXcd::Zero(2 * m, 2 * m);
  vectors.topLeftCorner(free, free).setIdentity();
  const Eigen::MatrixXcd found = solver.eigenvectors();
  vectors.block(free, free, held + m, held + m) = found;
  for (Index i = 0; i < free; ++i)
    vectors.row(i).tail(held + m) =
        found.row(held + i).cwiseQuotient(solver.eigenvalues().transpose());
  vectors = Eigen::MatrixXcd(vectors.colwise().normalized());
  if (!(vectors.inverse().norm() * vectors.norm() < worst_condition)) return false;
  // Displacements in the coordinates of the block.
  const Eigen::MatrixXcd shapes = directions.cast<std::complex<double>>() * vectors.topRows(m);

  std::vector<Index> real;
  for (Index i = 0; i < 2 * m; ++i) {
    const double decay = -values[i].real() * fast, w = values[i].imag() * fast;
    if (w == 0.0) real.push_back(i);
    if (!(w > 0.0)) continue;
    const Eigen::VectorXcd x = shapes.col(i);
    Mode mode(decay, decay * decay + w * w);
    mode.w = w;
    add(mode, x.real() + (decay / w) * x.imag(), x.imag() / w);
  }
  // Two real eigenvalues are a mode as well; the farthest from each other are best told apart.
  std::ranges::sort(real, {}, [&](Index i) { return values[i].real(); });
  for (std::size_t i = 0; i < real.size() / 2; ++i) {
    const Index first = real[i], second = real[real.size() - 1 - i];
    const double a = values[first].real() * fast, b = values[second].real() * fast;
    const VectorXd x = shapes.col(first).real(), y = shapes.col(second).real();
    if (a == b) return false;
    Mode mode(-0.5 * (a + b), a * b + 0.0);  // not -0
    mode.w = 0.5 * std::abs(a - b);
    add(mode, (a * y - b * x) / (a - b), (x - y) / (a - b));
  }
  return true;
}

}  // namespace clackers::numerics
