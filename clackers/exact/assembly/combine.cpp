#include "clackers/exact/assembly/modal_shape.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/assembly/combine.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE double sum_at(const double* const* columns, const double* factors, std::size_t m,
                         std::size_t i) {
  double sum = factors[0] * columns[0][i];
  for (std::size_t j = 1; j < m; ++j) sum += factors[j] * columns[j][i];
  return sum;
}

void combine(const double* const* columns, const double* factors, std::size_t m, std::size_t count,
             double* out, bool bypass_cache) {
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  // Stores that bypass the cache need an aligned address.
  if (bypass_cache)
    for (; i < count && reinterpret_cast<std::uintptr_t>(out + i) % (lanes * sizeof(double)) != 0;
         ++i)
      out[i] = sum_at(columns, factors, m, i);
  for (; i + lanes <= count; i += lanes) {
    auto sum = hn::Mul(hn::Set(d, factors[0]), hn::LoadU(d, columns[0] + i));
    for (std::size_t j = 1; j < m; ++j)
      sum = hn::Add(sum, hn::Mul(hn::Set(d, factors[j]), hn::LoadU(d, columns[j] + i)));
    bypass_cache ? hn::Stream(sum, d, out + i) : hn::StoreU(sum, d, out + i);
  }
  for (; i < count; ++i) out[i] = sum_at(columns, factors, m, i);
  if (bypass_cache) hwy::FlushStream();
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(combine);

void combine(const double* const* columns, const double* factors, std::size_t column_count,
             std::size_t count, double* out, bool bypass_cache) {
  HWY_DYNAMIC_DISPATCH(combine)(columns, factors, column_count, count, out, bypass_cache);
}

}  // namespace clackers::exact
#endif
