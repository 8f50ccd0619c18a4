#include "clackers/numerics/modes/tridiagonal_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "clackers/base/constants.hpp"

namespace clackers::numerics {
namespace {

using Eigen::Index;
using Vector = std::vector<DoubleDouble>;

// What a few operations in double-double round at most, of the sum of the sizes.
constexpr double rounding = 0x1p-99;
constexpr double most_shape_error = 0x1p-60, least_square = 0x1p-80;
// Of the largest square: from here on an iteration that does not halve the residual is the last.
constexpr double small_residual = 0x1p-84;
// A stiffness matrix without negative eigenvalues has some of this size by the rounding of its entries.
constexpr double unit = 64.0 * epsilon;
constexpr int most_iterations = 6;

DoubleDouble dot(const Vector& x, const Vector& y) {
  DoubleDouble sum;
  for (std::size_t i = 0; i < x.size(); ++i) sum = sum + x[i] * y[i];
  return sum;
}

Vector product(const Tridiagonal& a, const Vector& x) {
  Vector y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = a.diagonal[i] * x[i];
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    y[i] = y[i] + a.off_diagonal[i] * x[i + 1];
    y[i + 1] = y[i + 1] + a.off_diagonal[i] * x[i];
  }
  return y;
}

// Of the sizes of the entries.
double size_of_product(const Tridiagonal& a, const Vector& x, std::size_t i) {
  double size = std::abs(a.diagonal[i].hi * x[i].hi);
  if (i > 0) size += std::abs(a.off_diagonal[i - 1].hi * x[i - 1].hi);
  if (i + 1 < x.size()) size += std::abs(a.off_diagonal[i].hi * x[i + 1].hi);
  return size;
}

// x of (K - square M) x = y, by Gauss's elimination with row exchanges; where the matrix is singular a
// large multiple of what it maps to 0.
Vector solved(const Tridiagonal& k, const Tridiagonal& m, const DoubleDouble& square, Vector y) {
  const auto n = y.size();
  struct Row {
    DoubleDouble here, next, second;
  };
  std::vector<Row> rows(n);
  double largest = std::numeric_limits<double>::min();
  const auto entry = [&](const DoubleDouble& a, const DoubleDouble& b) { return a - square * b; };
  Row below{entry(k.diagonal[0], m.diagonal[0]), {}, {}};
  if (n > 1) below.next = entry(k.off_diagonal[0], m.off_diagonal[0]);
  for (std::size_t i = 0; i < n; ++i) {
    Row row = below;
    if (i + 1 < n) {
      const auto off_diagonal = entry(k.off_diagonal[i], m.off_diagonal[i]);
      below = {off_diagonal, entry(k.diagonal[i + 1], m.diagonal[i + 1]), {}};
      if (i + 2 < n) below.second = entry(k.off_diagonal[i + 1], m.off_diagonal[i + 1]);
      if (std::abs(below.here.hi) > std::abs(row.here.hi)) {
        std::swap(row, below);
        std::swap(y[i], y[i + 1]);
      }
      if (row.here.hi != 0.0) {
        const auto share = below.here / row.here;
        below = {below.next - share * row.next, below.second - share * row.second, {}};
        y[i + 1] = y[i + 1] - share * y[i];
      } else {
        below = {below.next, below.second, {}};
      }
    }
    largest =
        std::max(largest, std::abs(k.diagonal[i].hi) + std::abs(square.hi * m.diagonal[i].hi));
    rows[i] = row;
  }
  for (auto i = n; i-- > 0;) {
    auto& [here, next, second] = rows[i];
    if (std::abs(here.hi) < rounding * largest) here = {rounding * largest, 0.0};
    if (i + 1 < n) y[i] = y[i] - next * y[i + 1];
    if (i + 2 < n) y[i] = y[i] - second * y[i + 2];
    y[i] = y[i] / here;
  }
  return y;
}

struct RefinedMode {
  DoubleDouble square;
  double residual = std::numeric_limits<double>::infinity();  // a bound, in the norm of M^-1
  double shape_error = rounding;
  Vector shape;
};

// Masses that nothing joins to others, from degree of freedom `first` to that before `last`.
class Block {
 public:
  Block(const Tridiagonal& stiffness, const Tridiagonal& mass, std::size_t first, std::size_t last)
      : k_(part(stiffness, first, last)), m_(part(mass, first, last)) {
    for (std::size_t i = 0; i < size(); ++i) {
      double least = m_.diagonal[i].hi;
      if (i > 0) least -= std::abs(m_.off_diagonal[i - 1].hi);
      if (i + 1 < size()) least -= std::abs(m_.off_diagonal[i].hi);
      least_mass_ = std::min(least_mass_, least);
    }
  }

  // Nothing where they are not told apart.
  std::optional<std::vector<RefinedMode>> modes() const {
    if (!(least_mass_ > 0.0)) return std::nullopt;
    std::vector<RefinedMode> modes(size());
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> any(0.5, 1.5);
    const auto squares = this->squares();
    for (std::size_t j = 0; j < size(); ++j) {
      Vector start(size());
      for (auto& x : start) x = {any(random), 0.0};
      // The matrix of one mass may be 0.
      modes[j].shape =
          size() > 1 ? solved(k_, m_, {squares[Index(j)], 0.0}, std::move(start)) : start;
      refine(modes[j], squares.cwiseAbs().maxCoeff());
    }
    for (std::size_t j = 0; j < modes.size(); ++j) {
      double apart = std::numeric_limits<double>::infinity();
      for (const auto i : {j - 1, j + 1})
        if (i < modes.size())
          apart = std::min(apart, std::abs((modes[j].square - modes[i].square).hi) -
                                      modes[i].residual - modes[j].residual);
      modes[j].shape_error += 2.0 * modes[j].residual / apart;
      if (!(2.0 * modes[j].residual <= most_shape_error * apart)) return std::nullopt;
    }
    return modes;
  }

 private:
  static Tridiagonal part(const Tridiagonal& a, std::size_t first, std::size_t last) {
    return {{a.diagonal.begin() + Index(first), a.diagonal.begin() + Index(last)},
            {a.off_diagonal.begin() + Index(first), a.off_diagonal.begin() + Index(last - 1)}};
  }
  std::size_t size() const { return k_.diagonal.size(); }
  // Ascending, to the rounding of the largest, by bisection: K - x M has as many negative pivots as there
  // are squares below x. B. N. Parlett, chapter 3.
  Eigen::VectorXd squares() const {
    constexpr Index lanes = 8;
    using Lanes = Eigen::Array<double, lanes, 1>;
    const auto n = Index(size());
    double bound = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      double sum = std::abs(k_.diagonal[i].hi);
      if (i > 0) sum += std::abs(k_.off_diagonal[i - 1].hi);
      if (i + 1 < size()) sum += std::abs(k_.off_diagonal[i].hi);
      bound = std::max(bound, sum / least_mass_);
    }
    Eigen::VectorXd found(n);
    for (Index first = 0; first < n; first += lanes) {
      const Lanes number = Lanes::LinSpaced(double(first), double(first + lanes - 1));
      Lanes low = Lanes::Constant(-bound), high = -low;
      for (int halving = 0; halving < 60; ++halving) {
        const Lanes x = 0.5 * (low + high);
        Lanes off = Lanes::Zero(), pivot = Lanes::Ones(), below = Lanes::Zero();
        for (std::size_t i = 0; i < size(); ++i) {
          if (i > 0) off = k_.off_diagonal[i - 1].hi - x * m_.off_diagonal[i - 1].hi;
          pivot = k_.diagonal[i].hi - x * m_.diagonal[i].hi - off * off / pivot;
          pivot = (pivot == 0.0).select(rounding * bound * least_mass_, pivot);
          below += (pivot < 0.0).cast<double>();
        }
        const auto is_below = (below > number).eval();
        high = is_below.select(x, high);
        low = is_below.select(low, x);
      }
      const Index count = std::min(lanes, n - first);
      found.segment(first, count) = (0.5 * (low + high)).matrix().head(count);
    }
    return found;
  }

  void refine(RefinedMode& mode, double largest) const {
    for (int k = 0; k < most_iterations; ++k) {
      if (k > 0) mode.shape = solved(k_, m_, mode.square, product(m_, mode.shape));
      auto momenta = product(m_, mode.shape);
      const auto norm = sqrt(dot(mode.shape, momenta));
      for (auto* vector : {&mode.shape, &momenta})
        for (auto& x : *vector) x = x / norm;
      const auto forces = product(k_, mode.shape);
      mode.square = dot(mode.shape, forces);
      double sum = 0.0;
      for (std::size_t i = 0; i < size(); ++i) {
        const double residual = std::abs((forces[i] - mode.square * momenta[i]).hi) +
                                rounding * (size_of_product(k_, mode.shape, i) +
                                            largest * size_of_product(m_, mode.shape, i));
        sum += residual * residual;
      }
      const double before = std::exchange(mode.residual, std::sqrt(sum / least_mass_));
      if (mode.residual == 0.0 ||
          (mode.residual < small_residual * largest && mode.residual > 0.5 * before))
        break;
    }
  }

  Tridiagonal k_, m_;
  double least_mass_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<TridiagonalModes> tridiagonal_modes(const Tridiagonal& stiffness,
                                                  const Tridiagonal& mass) {
  const auto n = stiffness.diagonal.size();
  std::vector<std::pair<std::size_t, RefinedMode>> modes;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    for (last = first + 1; last < n && (stiffness.off_diagonal[last - 1].hi != 0.0 ||
                                        mass.off_diagonal[last - 1].hi != 0.0);)
      ++last;
    const Block block(stiffness, mass, first, last);
    auto some = block.modes();
    if (!some) return std::nullopt;
    for (auto& mode : *some) modes.emplace_back(first, std::move(mode));
  }
  std::ranges::stable_sort(modes, {}, [](const auto& mode) { return mode.second.square.hi; });
  const double largest =
      std::max(modes.back().second.square.hi, std::abs(modes.front().second.square.hi));
  TridiagonalModes found;
  for (auto* vector :
       {&found.squares, &found.square_errors, &found.squares_rest, &found.rest_errors})
    vector->resize(Index(n));
  found.shapes = found.shapes_rest = Eigen::MatrixXd::Zero(Index(n), Index(n));
  for (Index j = 0; j < Index(n); ++j) {
    const auto& [first, mode] = modes[std::size_t(j)];
    const auto& [square, residual, shape_error, shape] = mode;
    const bool is_zero =
        square.hi <= least_square * largest && square.hi >= -unit * double(n) * largest;
    found.squares[j] = is_zero ? 0.0 : square.hi;
    found.squares_rest[j] = is_zero ? 0.0 : square.lo;
    found.square_errors[j] = residual + std::abs((square - DoubleDouble{found.squares[j], 0.0}).hi);
    found.rest_errors[j] = is_zero ? found.square_errors[j] : residual;
    found.shape_error = std::max(found.shape_error, shape_error);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      found.shapes(Index(first + i), j) = shape[i].hi;
      found.shapes_rest(Index(first + i), j) = shape[i].lo;
    }
  }
  return found;
}

}  // namespace clackers::numerics
