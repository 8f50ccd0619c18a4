#include "clackers/methods/stepping/step_powers.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/methods/stepping/step_powers.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace clackers::methods::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, StepPowers::steps>;

// What the compiler does not know, it finds in the arguments: Dof = 0.
template <std::size_t Dof, std::size_t Size>
HWY_INLINE void multiply(const double* table, std::size_t dof, std::size_t rows, std::size_t size,
                         const double* x, double* y) {
  const Lanes d;
  constexpr std::size_t count = StepPowers::steps;
  if constexpr (Dof > 0) dof = Dof, rows = size = Size;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(d)) {
      const double* p = table + row * size * count + lane;
      auto even = hn::Mul(hn::Set(d, x[0]), hn::Load(d, p));
      auto odd = hn::Mul(hn::Set(d, x[1]), hn::Load(d, p + count));
      std::size_t j = 2;
      for (; j + 1 < size; j += 2) {
        even = hn::Add(even, hn::Mul(hn::Set(d, x[j]), hn::Load(d, p + j * count)));
        odd = hn::Add(odd, hn::Mul(hn::Set(d, x[j + 1]), hn::Load(d, p + (j + 1) * count)));
      }
      if (j < size) even = hn::Add(even, hn::Mul(hn::Set(d, x[j]), hn::Load(d, p + j * count)));
      auto sum = hn::Add(even, odd);
      if (row < 2 * dof) sum = hn::Add(hn::Set(d, x[row]), sum);
      hn::Store(sum, d, y + row * count + lane);
    }
}

// How many of the first states, `stride` apart, are so far from all contacts that steps from them and to
// them are quiet: both inner control points of their cubics, g + h/3 g' and g - h/3 g', are open.
template <class D>
HWY_INLINE std::size_t count_far(D d, const Gaps& gaps, double third, std::size_t dof,
                                 const double* y, std::size_t stride) {
  auto is_far = hn::Eq(hn::Zero(d), hn::Zero(d));
  std::size_t i = 0;
  for (std::size_t contact = 0; contact < gaps.ends.size(); ++contact) {
    auto gap = hn::Set(d, -gaps.gaps[contact]), rate = hn::Zero(d);
    for (; i < gaps.ends[contact]; ++i) {
      const auto factor = hn::Set(d, gaps.entries[i].factor);
      const double* at = y + gaps.entries[i].mass * stride;
      gap = hn::Add(gap, hn::Mul(factor, hn::Load(d, at)));
      rate = hn::Add(rate, hn::Mul(factor, hn::Load(d, at + dof * stride)));
    }
    is_far = hn::And(is_far, hn::Ge(gap, hn::Mul(hn::Set(d, third), hn::Abs(rate))));
  }
  const auto first = hn::FindFirstTrue(d, hn::Not(is_far));
  return first < 0 ? hn::Lanes(d) : static_cast<std::size_t>(first);
}

HWY_INLINE void deliver(std::size_t dof, const double* y, double* out) {
  const Lanes d;
  constexpr std::size_t count = StepPowers::steps;
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(d)) {
    const auto row = [&](std::size_t i) HWY_ATTR { return hn::Load(d, y + i * count + lane); };
    if (dof == 1) hn::StoreU(row(0), d, out + lane);
    if (dof == 2) hn::StoreInterleaved2(row(0), row(1), d, out + 2 * lane);
  }
  if (dof > 2)
    for (std::size_t lane = 0; lane < count; ++lane)
      for (std::size_t i = 0; i < dof; ++i) out[lane * dof + i] = y[i * count + lane];
}

// The unknowns after `made` > 0 states: the last of them, and the differences that end with it.
HWY_INLINE void keep(std::size_t dof, std::size_t rows, std::size_t size, const double* y,
                     std::size_t made, double* x) {
  constexpr std::size_t count = StepPowers::steps;
  const std::size_t pair = 2 * dof;
  // From the oldest on: none is read after it is written.
  for (std::size_t past = (size - rows) / pair; past > 0; --past)
    for (std::size_t i = 0; i < pair; ++i) {
      double* const differences = x + rows + i - pair;
      const double* const made_ones = y + i * count;
      if (past > made)
        differences[past * pair] = differences[(past - made) * pair];
      else
        differences[past * pair] =
            made_ones[made - past] - (past == made ? x[i] : made_ones[made - past - 1]);
    }
  for (std::size_t i = 0; i < rows; ++i) x[i] = y[i * count + made - 1];
}

template <std::size_t Dof, std::size_t Size>
std::size_t advance_sized(const double* table, std::size_t dof, std::size_t rows, std::size_t size,
                          double* x, double* y, const Gaps& gaps, double third, std::size_t most,
                          double* u, double* v) {
  constexpr std::size_t count = StepPowers::steps;
  if constexpr (Dof > 0) dof = Dof, rows = size = Size;
  const Lanes d;
  std::size_t made = 0;
  if (count_far(hn::CappedTag<double, 1>(), gaps, third, dof, x, 1) == 0) return 0;
  while (made + count <= most) {
    multiply<Dof, Size>(table, dof, rows, size, x, y);
    deliver(dof, y, u + made * dof);
    deliver(dof, y + dof * count, v + made * dof);
    std::size_t quiet = 0;
    for (std::size_t lane = 0; lane == quiet && lane < count; lane += hn::Lanes(d))
      quiet += count_far(d, gaps, third, dof, y + lane, count);
    if (quiet > 0) keep(dof, rows, size, y, quiet, x);
    made += quiet;
    if (quiet < count) break;
  }
  return made;
}

std::size_t advance(const double* table, std::size_t dof, std::size_t rows, std::size_t size,
                    double* x, double* y, const Gaps& gaps, double third, std::size_t most,
                    double* u, double* v) {
  const auto sized = [&]<std::size_t Dof, std::size_t Size>() {
    return advance_sized<Dof, Size>(table, dof, rows, size, x, y, gaps, third, most, u, v);
  };
  if (rows < size) return sized.template operator()<0, 0>();
  if (dof == 1 && size == 2) return sized.template operator()<1, 2>();
  if (dof == 1 && size == 3) return sized.template operator()<1, 3>();
  if (dof == 2 && size == 4) return sized.template operator()<2, 4>();
  if (dof == 2 && size == 6) return sized.template operator()<2, 6>();
  return sized.template operator()<0, 0>();
}

}  // namespace clackers::methods::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::methods {

HWY_EXPORT(advance);

void StepPowers::assign(std::size_t dof, std::size_t made, const Eigen::MatrixXd& first) {
  dof_ = dof;
  rows_ = made;
  size_ = std::size_t(first.rows());
  table_.resize(rows_ * size_);
  y_.resize(rows_);
  const auto kept = Eigen::Index(2 * dof);
  Eigen::MatrixXd more = first, next(first.rows(), first.cols());
  for (std::size_t power = 0; power < steps; ++power) {
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < size_; ++column)
        table_[row * size_ + column].powers[power] = more(Eigen::Index(row), Eigen::Index(column));
    next.noalias() = first * more;
    next.topRows(kept) += more.topRows(kept);
    next.leftCols(kept) += first.leftCols(kept);
    more.swap(next);
  }
}

std::size_t StepPowers::advance(std::span<double> x, const Gaps& gaps, double h, std::size_t most,
                                double* u, double* v) {
  return HWY_DYNAMIC_DISPATCH(advance)(table_[0].powers, dof_, rows_, size_, x.data(), y_[0].powers,
                                       gaps, h / 3.0, most, u, v);
}

}  // namespace clackers::methods
#endif
