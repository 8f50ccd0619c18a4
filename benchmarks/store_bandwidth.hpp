#pragma once

#include <cstddef>

namespace clackers::benchmarks {

/// Fills four arrays of `count` doubles past the cache, side by side; each begins at a multiple of
/// 32 bytes and count is a multiple of 8. The fastest way known to us to store so many.
void stream_four(double* const (&arrays)[4], std::size_t count);
/// The same, one array after another.
void stream_each(double* const (&arrays)[4], std::size_t count);

}  // namespace clackers::benchmarks
