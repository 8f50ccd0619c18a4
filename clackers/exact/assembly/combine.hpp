#pragma once

#include <cstddef>

namespace clackers::exact {

/// out[i] = factors[0] columns[0][i] + factors[1] columns[1][i] + ... for i < count, added from left
/// to right: the same bits on every processor. With `bypass_cache` for an output larger than the
/// caches. At least one column.
void combine(const double* const* columns, const double* factors, std::size_t column_count,
             std::size_t count, double* out, bool bypass_cache);

}  // namespace clackers::exact
