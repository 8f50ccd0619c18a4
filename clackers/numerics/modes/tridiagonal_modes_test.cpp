#include "clackers/numerics/modes/tridiagonal_modes.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace clackers::numerics {
namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                           boost::multiprecision::et_off>;
using Row = std::vector<Real>;

Real exact(const DoubleDouble& x) { return Real(x.hi) + Real(x.lo); }

// A second way: Sturm's sequence counts the squares below x, and inverse iteration with 60 digits has the shape of one.
struct Pencil {
  const Tridiagonal &k, &m;
  std::size_t size() const { return k.diagonal.size(); }
  Real here(std::size_t i, const Real& x) const {
    return exact(k.diagonal[i]) - x * exact(m.diagonal[i]);
  }
  Real off_diagonal(std::size_t i, const Real& x) const {
    return exact(k.off_diagonal[i]) - x * exact(m.off_diagonal[i]);
  }
  // The pivots of K - x M without row exchanges.
  Row pivots(const Real& x) const {
    Row d(size());
    for (std::size_t i = 0; i < size(); ++i) {
      d[i] = here(i, x);
      if (i > 0) d[i] -= off_diagonal(i - 1, x) * off_diagonal(i - 1, x) / d[i - 1];
      if (d[i] == 0) d[i] = Real("1e-300");
    }
    return d;
  }
  int squares_below(const Real& x) const {
    int count = 0;
    for (const auto& d : pivots(x))
      if (d < 0) ++count;
    return count;
  }
  Row momenta(const Row& y) const {
    Row p(size());
    for (std::size_t i = 0; i < size(); ++i) {
      p[i] += exact(m.diagonal[i]) * y[i];
      if (i + 1 == size()) break;
      p[i] += exact(m.off_diagonal[i]) * y[i + 1];
      p[i + 1] += exact(m.off_diagonal[i]) * y[i];
    }
    return p;
  }
  Row shape(const Real& x, Row y) const {
    const auto n = size();
    const auto d = pivots(x);
    for (int iteration = 0; iteration < 3; ++iteration) {
      y = momenta(y);
      for (std::size_t i = 1; i < n; ++i) y[i] -= off_diagonal(i - 1, x) / d[i - 1] * y[i - 1];
      for (auto i = n; i-- > 0;) {
        if (i + 1 < n) y[i] -= off_diagonal(i, x) * y[i + 1];
        y[i] /= d[i];
      }
      Real norm = 0;
      const auto p = momenta(y);
      for (std::size_t i = 0; i < n; ++i) norm += p[i] * y[i];
      for (auto& value : y) value /= sqrt(norm);
    }
    return y;
  }
};

void expect_modes(const Tridiagonal& k, const Tridiagonal& m, double most_error,
                  double most_shape_error) {
  const auto found = tridiagonal_modes(k, m);
  ASSERT_TRUE(found);
  const Pencil pencil{k, m};
  const auto n = Eigen::Index(pencil.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    const double square = found->squares[j], error = found->square_errors[j];
    EXPECT_LE(error, most_error * found->squares[n - 1]) << j;
    const Real width = Real(error) + Real("1e-45");
    EXPECT_LE(pencil.squares_below(Real(square) - width), j);
    EXPECT_GE(pencil.squares_below(Real(square) + width), j + 1);
    Row start;
    double size = 0.0;
    for (const double x : found->shapes.col(j)) {
      start.emplace_back(x);
      size = std::max(size, std::abs(x));
    }
    auto shape = pencil.shape(Real(square) + Real(1e-19 * found->squares[n - 1]), start);
    std::size_t largest = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
      if (abs(shape[i]) > abs(shape[largest])) largest = i;
    const Real sign = shape[largest] * start[largest] < 0 ? -1 : 1;
    for (std::size_t i = 0; i < shape.size(); ++i)
      EXPECT_LE(abs(sign * shape[i] - start[i]),
                Real(0x1p-53) * abs(start[i]) + Real(0x1p-60 * size))
          << j << " " << i;
    // The same in double-double: the square by Sturm's sequence, the shape in the norm of M.
    const Real rest = Real(square) + Real(found->squares_rest[j]),
               narrow = Real(found->rest_errors[j]) + Real("1e-45");
    EXPECT_LE(found->rest_errors[j], std::max(error, 1e-24 * found->squares[n - 1]));
    EXPECT_LE(pencil.squares_below(rest - narrow), j);
    EXPECT_GE(pencil.squares_below(rest + narrow), j + 1);
    for (std::size_t i = 0; i < shape.size(); ++i)
      shape[i] = sign * shape[i] - start[i] - Real(found->shapes_rest(Eigen::Index(i), j));
    Real norm = 0;
    const auto momenta = pencil.momenta(shape);
    for (std::size_t i = 0; i < shape.size(); ++i) norm += shape[i] * momenta[i];
    EXPECT_LE(sqrt(norm), found->shape_error) << j;
  }
  EXPECT_LE(found->shape_error, most_shape_error);
}

TEST(TridiagonalModes, LieNextToTheTrueNumbers) {
  std::mt19937 random(31);  // NOLINT: the same numbers in every run
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (std::size_t trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 31, trial " << trial);
    const auto n = 1 + trial % 14;
    const double spread = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 1.0 : 6.0;
    const auto size = [&] { return std::exp2(spread * (any(random) - 0.5)); };
    Tridiagonal k, m;
    std::vector<double> springs;
    for (std::size_t i = 0; i <= n; ++i) springs.push_back(size());
    if (trial % 2 == 0) springs.front() = springs.back() = 0.0;  // moves freely
    for (std::size_t i = 0; i < n; ++i) {
      k.diagonal.push_back(two_sum(springs[i], springs[i + 1]));
      m.diagonal.push_back({size(), 0.0});
      if (i + 1 == n) break;
      k.off_diagonal.push_back({-springs[i + 1], 0.0});
      m.off_diagonal.push_back({trial % 4 < 2 ? 0.0 : 0.1 * std::exp2(-0.5 * spread), 0.0});
    }
    expect_modes(k, m, 1e-15, 1e-20);
    EXPECT_EQ(tridiagonal_modes(k, m)->squares[0] == 0.0, trial % 2 == 0);
  }
}

TEST(TridiagonalModes, MayGrow) {
  const Tridiagonal mass{{{1.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}}};
  EXPECT_EQ(tridiagonal_modes({{{-1.0, 0.0}, {2.0, 0.0}}, {{0.0, 0.0}}}, mass)->squares[0], -1.0);
  // By rounding alone.
  const auto modes = tridiagonal_modes({{{-1e-15, 0.0}, {2.0, 0.0}}, {{0.0, 0.0}}}, mass);
  EXPECT_EQ(modes->squares[0], 0.0);
  EXPECT_GE(modes->square_errors[0], 1e-15);
}

// Two bars of one material have the same frequencies, as long as nothing joins them.
TEST(TridiagonalModes, OfMassesThatNothingJoinsMayBeEqual) {
  Tridiagonal k, m;
  for (int i = 0; i < 6; ++i) {
    k.diagonal.push_back({2.0, 0.0});
    m.diagonal.push_back({1.0, 0.0});
    if (i == 5) break;
    k.off_diagonal.push_back({i == 2 ? 0.0 : -1.0, 0.0});
    m.off_diagonal.push_back({0.0, 0.0});
  }
  const auto found = tridiagonal_modes(k, m);
  ASSERT_TRUE(found);
  for (int j = 0; j < 6; ++j) {
    const double s = std::sin((1 + j / 2) * std::numbers::pi / 8.0);
    EXPECT_NEAR(found->squares[j], 4.0 * s * s, 1e-15);
    EXPECT_TRUE(found->shapes.col(j).head(3).isZero(0.0) !=
                found->shapes.col(j).tail(3).isZero(0.0));
  }
  k.off_diagonal[2] = {-1e-40, 0.0};
  EXPECT_FALSE(tridiagonal_modes(k, m));
  k.off_diagonal[2] = {-1e-3, 0.0};
  EXPECT_TRUE(tridiagonal_modes(k, m));
  m.off_diagonal[0] = m.off_diagonal[1] = {0.6, 0.0};
  EXPECT_FALSE(tridiagonal_modes(k, m));
  m.off_diagonal[1] = {0.0, 0.0};
  EXPECT_TRUE(tridiagonal_modes(k, m));
}

}  // namespace
}  // namespace clackers::numerics
