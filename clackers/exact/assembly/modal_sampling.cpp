#include "clackers/exact/assembly/modal_shape.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/assembly/modal_sampling.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "clackers/numerics/simd/double_double-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace simd = numerics::simd::HWY_NAMESPACE;

using simd::constant;
using simd::Doubles;
using simd::Pair;
using simd::Vector;

// What multiplies the amplitudes of a column in displacement, velocity and acceleration.
HWY_INLINE void factors_of(const ModalColumn& column, const numerics::DoubleDouble& w, double sigma,
                           const FlightBlock& block, std::size_t at,
                           double (*factors)[most_in_block]) {
  const Doubles d;
  const auto load = [&](const double* x) HWY_ATTR { return hn::Load(d, x + at); };
  Pair sine, cosine;
  simd::sincospi(simd::multiply({load(block.y_hi), load(block.y_lo)}, constant(column.multiple)),
                 sine, cosine);
  const bool is_cosine = column.function == ModalColumn::Function::cosine;
  Vector scale = load(block.scale);
  if (!is_cosine) scale = Mul(scale, simd::sign_of_power(load(block.flight)));
  const Pair p = is_cosine ? cosine : sine;
  const Pair e{load(block.e_hi), load(block.e_lo)};
  const Pair other = is_cosine ? Pair{Neg(sine.hi), Neg(sine.lo)} : cosine;
  const auto slope = simd::multiply(other, constant(w));
  const auto square = numerics::DoubleDouble{sigma, 0.0} * sigma - w * w;
  const auto put = [&](const Pair& x, double* to) HWY_ATTR {
    // Never -0, which is printed as such.
    hn::Store(Add(Mul(simd::multiply(e, x).hi, scale), hn::Zero(d)), d, to + at);
  };
  put(p, factors[0]);
  put(simd::subtract(slope, simd::multiply(p, constant(sigma))), factors[1]);
  put(simd::subtract(simd::multiply(p, constant(square)),
                     simd::multiply(slope, constant(2.0 * sigma))),
      factors[2]);
}

HWY_INLINE double sum_at(const double* const* columns, const double* factors, std::size_t m,
                         std::size_t i) {
  double sum = factors[0] * columns[0][i];
  for (std::size_t j = 1; j < m; ++j) sum += factors[j] * columns[j][i];
  return sum;
}

// out[i] = factors[0] columns[0][i] + factors[1] columns[1][i] + ... for i < count, added from left
// to right. With `bypass_cache` for an output larger than the caches.
HWY_INLINE void combine(const double* const* columns, const double* factors, std::size_t m,
                        std::size_t count, double* out, bool bypass_cache) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  // Stores that bypass the cache need an aligned address.
  if (bypass_cache)
    for (; i < count && reinterpret_cast<std::uintptr_t>(out + i) % (lanes * sizeof(double)) != 0;
         ++i)
      out[i] = sum_at(columns, factors, m, i);
  for (; i + lanes <= count; i += lanes) {
    auto sum = Mul(constant(factors[0]), hn::LoadU(d, columns[0] + i));
    for (std::size_t j = 1; j < m; ++j)
      sum = Add(sum, Mul(constant(factors[j]), hn::LoadU(d, columns[j] + i)));
    bypass_cache ? hn::Stream(sum, d, out + i) : hn::StoreU(sum, d, out + i);
  }
  for (; i < count; ++i) out[i] = sum_at(columns, factors, m, i);
  if (bypass_cache) hwy::FlushStream();
}

void sample_modes(const ModalShape& shape, const FlightBlock& block, std::size_t rows,
                  const model::SampleBuffers& out) {
  const auto n = shape.dof(), m = shape.columns().size();
  std::vector<double> factors(3 * rows * m);  // quantity, lane, column
  HWY_ALIGN double of_column[3][most_in_block];
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t at = 0; at < rows; at += hn::Lanes(Doubles()))
      factors_of(shape.columns()[j], shape.frequencies()[j], shape.sigma(), block, at, of_column);
    for (std::size_t quantity = 0; quantity < 3; ++quantity)
      for (std::size_t row = 0; row < rows; ++row)
        factors[(quantity * rows + row) * m + j] = of_column[quantity][row];
  }
  // So many masses at a time that their amplitudes stay in the nearest cache for all lanes.
  const std::size_t chunk = 4096 / m + 1;
  constexpr std::size_t larger_than_caches = 1 << 20;
  const bool bypass_cache = n * rows > larger_than_caches;
  std::vector<const double*> columns(m);
  for (std::size_t first = 0; first < n; first += chunk) {
    const auto count = std::min(chunk, n - first);
    for (std::size_t j = 0; j < m; ++j) columns[j] = shape.columns()[j].amplitude.data() + first;
    std::size_t quantity = 0;
    for (const auto& values : {out.u, out.v, out.a}) {
      for (std::size_t row = 0; row < rows && !values.empty(); ++row)
        combine(columns.data(), &factors[(quantity * rows + row) * m], m, count,
                &values[row * n + first], bypass_cache);
      ++quantity;
    }
  }
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(sample_modes);

void ModalShape::sample(const FlightBlock& block, std::size_t count,
                        model::SampleBuffers out) const {
  HWY_DYNAMIC_DISPATCH(sample_modes)(*this, block, count, out);
}

}  // namespace clackers::exact
#endif
