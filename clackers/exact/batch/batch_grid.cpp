#include "clackers/exact/batch/batch.hpp"
#include "clackers/numerics/simd/wanted.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/batch/batch_grid.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "clackers/exact/batch/batch_grid-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {

/// Writes states into arrays; `stream` goes past the cache and needs aligned places.
template <bool stream>
struct Writer {
  // Memory takes two streams faster than four.
  static constexpr bool signs = true, apart = stream;
  double* to[4];  ///< in the kernel's order

  HWY_INLINE explicit Writer(double* const (&arrays)[4]) {
    for (int i = 0; i < 4; ++i) to[i] = arrays[i];
  }
  template <int mass>
  HWY_INLINE HalfWriter<stream> half(std::size_t at) const {
    return {to[mass] + at, to[2 + mass] + at};
  }
  template <int mass>
  HWY_INLINE void keep(const HalfWriter<stream>&) const {}
  void take_some(std::size_t at, const Block& block, std::size_t count) {
    for (std::size_t i = 0; i < 4; ++i) std::copy_n(block.values[i], count, to[i] + at);
  }
};

std::int64_t sample_grid(const PairBatch& batch, const UniformGrid& grid, const PairBuffers& out) {
  const bool swap = batch.constants().exchanged;
  double* const to[4] = {(swap ? out.u2 : out.u1).data(), (swap ? out.u1 : out.u2).data(),
                         (swap ? out.v2 : out.v1).data(), (swap ? out.v1 : out.v2).data()};
  constexpr std::size_t bytes = 64;  // a line of the cache
  const auto place = [](const double* p) { return reinterpret_cast<std::uintptr_t>(p) % bytes; };
  const auto first = place(to[0]);
  const bool alike = place(to[1]) == first && place(to[2]) == first && place(to[3]) == first &&
                     first % sizeof(double) == 0;
  constexpr std::size_t stream_from = (8u << 20) / (4 * sizeof(double));
  if (alike && grid.count >= stream_from) {
    const std::size_t head = (bytes - first) % bytes / sizeof(double);
    Writer<false> few(to);
    run_direct(batch, grid, 0, head, few);
    Writer<true> rest(to);
    run_grid(batch, grid, head, rest);
    hwy::FlushStream();
  } else {
    Writer<false> all(to);
    run_grid(batch, grid, 0, all);
  }
  return HWY_TARGET;
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(sample_grid);

numerics::simd::Target PairBatch::sample(const UniformGrid& grid, const PairBuffers& out) const {
  require_size(out, grid.count);
  require_grid(grid, constants_.end);
  return {HWY_DYNAMIC_DISPATCH(sample_grid)(*this, grid, out)};
}

}  // namespace clackers::exact
#endif
