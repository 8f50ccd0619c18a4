#include "benchmarks/store_bandwidth.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#else
#include <algorithm>
#endif

namespace clackers::benchmarks {
namespace {

#ifdef __SSE2__
// One line of the cache, 64 bytes.
inline void stream_line(double* to, __m128d x) {
  for (int i = 0; i < 8; i += 2) _mm_stream_pd(to + i, x);
}
#else
inline void stream_line(double* to, double x) { std::fill_n(to, 8, x); }
#endif

}  // namespace

#ifdef __SSE2__
static const auto value = _mm_set1_pd(1.5);
static void finish() { _mm_sfence(); }
#else
static const double value = 1.5;
static void finish() {}
#endif

void stream_four(double* const (&arrays)[4], std::size_t count) {
  double* const to[4] = {arrays[0], arrays[1], arrays[2], arrays[3]};
  for (std::size_t i = 0; i < count; i += 8)
    for (double* array : to) stream_line(array + i, value);
  finish();
}

void stream_each(double* const (&arrays)[4], std::size_t count) {
  for (double* array : arrays)
    for (std::size_t i = 0; i < count; i += 8) stream_line(array + i, value);
  finish();
}

}  // namespace clackers::benchmarks
