#include "clackers/numerics/lcp.hpp"
#include "clackers/base/constants.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::numerics {
namespace {

using Eigen::Index;

Index to_index(std::size_t i) { return static_cast<Index>(i); }

}  // namespace

PrincipalCholesky::PrincipalCholesky(std::size_t most)
    : factors_(to_index(most), to_index(most)), products_(to_index(most)) {}

std::size_t PrincipalCholesky::compute(const Eigen::MatrixXd& a,
                                       std::span<const std::size_t> rows) {
  // A pivot carries one rounding of its diagonal entry a row, and those of A itself, some products.
  const double unit = 64.0 * double(rows.size()) * epsilon;
  for (count_ = 0; count_ < to_index(rows.size()); ++count_) {
    const Index i = to_index(rows[static_cast<std::size_t>(count_)]);
    double pivot = a(i, i);
    for (Index k = 0; k < count_; ++k) {
      double product = a(i, to_index(rows[static_cast<std::size_t>(k)]));
      for (Index j = 0; j < k; ++j) product -= products_[j] * factors_(k, j);
      products_[k] = product;  // L D
      factors_(count_, k) = product / factors_(k, k);
      pivot -= product * factors_(count_, k);
    }
    if (!(pivot > unit * a(i, i))) break;
    factors_(count_, count_) = pivot;
  }
  return static_cast<std::size_t>(count_);
}

void PrincipalCholesky::solve_in_place(Eigen::VectorXd& x) const {
  for (Index i = 0; i < count_; ++i) x[i] -= factors_.row(i).head(i).dot(x.head(i));
  for (Index i = count_ - 1; i >= 0; --i) {
    const Index below = count_ - 1 - i;
    x[i] =
        x[i] / factors_(i, i) - factors_.col(i).segment(i + 1, below).dot(x.segment(i + 1, below));
  }
}

LcpSolver::LcpSolver(std::size_t most)
    : table_(to_index(most), 2 * to_index(most) + 2),
      basis_(most, 0),
      scale_(to_index(most)),
      values_(to_index(most)),
      factors_(most) {
  positive_.reserve(most);
}

bool LcpSolver::solve(const Eigen::MatrixXd& w, const Eigen::VectorXd& q,
                      std::span<const std::size_t> rows, Eigen::VectorXd& z) {
  z.setZero(q.size());
  positive_.clear();
  if (rows.size() == 1) {
    const Index i = to_index(rows[0]);
    if (q[i] >= 0.0) return true;
    z[i] = -q[i] / w(i, i);
    if (z[i] > 0.0 && std::isfinite(z[i])) return true;
    z[i] = 0.0;
    return false;
  }
  if (!pivot_to_solution(w, q, rows)) return false;
  // Where the solution is degenerate, rounding may leave a value below 0: its row does not belong
  // to the positive ones.
  while (!positive_.empty()) {
    if (factors_.compute(w, positive_) < positive_.size()) return false;
    for (std::size_t k = 0; k < positive_.size(); ++k)
      values_[to_index(k)] = -q[to_index(positive_[k])];
    factors_.solve_in_place(values_);
    const auto count = to_index(positive_.size());
    Index lowest = 0;
    if (values_.head(count).minCoeff(&lowest) >= 0.0) break;
    positive_.erase(positive_.begin() + lowest);
  }
  for (std::size_t k = 0; k < positive_.size(); ++k)
    z[to_index(positive_[k])] = values_[to_index(k)];
  if (is_solution(w, q, rows, z)) return true;
  z.setZero();
  return false;
}

// Leaves in positive_ the rows where z is positive.
bool LcpSolver::pivot_to_solution(const Eigen::MatrixXd& w, const Eigen::VectorXd& q,
                                  std::span<const std::size_t> rows) {
  n_ = to_index(rows.size());
  const Index artificial = 2 * n_, right = 2 * n_ + 1;
  const auto row = [&](Index i) { return to_index(rows[static_cast<std::size_t>(i)]); };
  for (Index i = 0; i < n_; ++i) {
    const double diagonal = w(row(i), row(i));
    scale_[i] = diagonal > 0.0 ? 1.0 / std::sqrt(diagonal) : 1.0;
    basis_[static_cast<std::size_t>(i)] = i;
  }
  table_.topLeftCorner(n_, n_).setIdentity();
  for (Index i = 0; i < n_; ++i) {
    for (Index j = 0; j < n_; ++j) table_(i, n_ + j) = -scale_[i] * w(row(i), row(j)) * scale_[j];
    table_(i, artificial) = -1.0;
    table_(i, right) = scale_[i] * q[row(i)];
  }
  auto values = table_.col(right).head(n_);
  if (n_ == 0 || values.minCoeff() >= 0.0) return true;
  const double size = values.cwiseAbs().maxCoeff();
  values /= size;
  // The least value leaves; of equal ones the last, which has the lexicographically least row.
  Index leaving = 0;
  for (Index i = 1; i < n_; ++i)
    if (values[i] <= values[leaving]) leaving = i;
  Index entering = artificial;
  for (Index pivots = 0; pivots <= 50 * n_; ++pivots) {
    const Index left = basis_[static_cast<std::size_t>(leaving)];
    pivot(leaving, entering);
    if (left == artificial) {
      for (Index i = 0; i < n_; ++i)
        if (const Index j = basis_[static_cast<std::size_t>(i)]; j >= n_)
          positive_.push_back(rows[static_cast<std::size_t>(j - n_)]);
      std::sort(positive_.begin(), positive_.end());
      return true;
    }
    entering = left < n_ ? left + n_ : left - n_;
    leaving = leaving_row(entering);
    if (leaving < 0) return false;
  }
  return false;
}

// The row with the lexicographically least (value, w columns) / entry, or -1: the artificial
// variable can grow for ever, and no z has W z + q >= 0.
Index LcpSolver::leaving_row(Index entering) const {
  const double unit = 16.0 * double(n_) * epsilon;
  const Index artificial = 2 * n_, right = 2 * n_ + 1;
  const auto is_less = [&](Index i, Index k) {
    const double at_i = table_(i, entering), at_k = table_(k, entering);
    for (Index c = -1; c < n_; ++c) {
      const Index column = c < 0 ? right : c;
      const double ratio_i = table_(i, column) * at_k, ratio_k = table_(k, column) * at_i;
      // Equal but for rounding: the next column decides. The artificial variable leaves if it can.
      if (std::abs(ratio_i - ratio_k) > unit * (std::abs(ratio_i) + std::abs(ratio_k)))
        return ratio_i < ratio_k;
      if (c < 0 && basis_[static_cast<std::size_t>(i)] == artificial) return true;
      if (c < 0 && basis_[static_cast<std::size_t>(k)] == artificial) return false;
    }
    return false;
  };
  Index best = -1;
  for (Index i = 0; i < n_; ++i)
    if (table_(i, entering) > unit && (best < 0 || is_less(i, best))) best = i;
  return best;
}

void LcpSolver::pivot(Index row, Index entering) {
  const Index columns = 2 * n_ + 2;
  const double scale = 1.0 / table_(row, entering);
  for (Index c = 0; c < columns; ++c) {
    if (c == entering) continue;
    const double factor = scale * table_(row, c);
    if (factor == 0.0) continue;
    table_.col(c).head(n_) -= factor * table_.col(entering).head(n_);
    table_(row, c) = factor;
  }
  table_.col(entering).head(n_).setZero();
  table_(row, entering) = 1.0;
  basis_[static_cast<std::size_t>(row)] = entering;
}

// Within the rounding that a factorization leaves in a row: n units of sqrt(W_ii W_jj) z_j.
bool LcpSolver::is_solution(const Eigen::MatrixXd& w, const Eigen::VectorXd& q,
                            std::span<const std::size_t> rows, const Eigen::VectorXd& z) const {
  double sum = 0.0;
  for (Index k = 0; k < n_; ++k) sum += z[to_index(rows[static_cast<std::size_t>(k)])] / scale_[k];
  for (Index k = 0; k < n_; ++k) {
    const Index i = to_index(rows[static_cast<std::size_t>(k)]);
    double value = q[i];
    for (const auto j : positive_) value += w(i, to_index(j)) * z[to_index(j)];
    const double rounding = 8.0 * double(n_ + 1) * epsilon * (sum / scale_[k] + std::abs(q[i]));
    if (!(value >= -rounding) || (z[i] > 0.0 && value > rounding)) return false;
  }
  return true;
}

}  // namespace clackers::numerics
