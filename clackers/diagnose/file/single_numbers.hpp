#pragma once

#include <cstddef>
#include <vector>

namespace clackers::diagnose {

/// Every number values[first], values[first + stride], ... is one of single precision, as it stands,
/// in its shortest decimal form or in nine digits, and at least 20 of them need eight digits or more
/// in that form, so that printing alone cannot be the cause: of eight-digit decimals one in six is
/// the shortest form of a number of single precision, of numbers of double precision one in 2^29 is
/// one of single.
bool are_single(const std::vector<double>& values, std::size_t first = 0, std::size_t stride = 1);

}  // namespace clackers::diagnose
