#pragma once

#include <cstddef>
#include <vector>

#include "clackers/campaign/specification.hpp"

namespace clackers::campaign {

/// Most dimensions of a sample.
inline constexpr std::size_t most_dimensions = 64;

/// Point i of a sample in [0, 1)^dimensions, computed from its number alone.
///
/// latin-hypercube: each dimension has one point in each of `points` equal intervals, in an order and
/// at a place inside it that follow from seed and dimension (M. D. McKay et al., Technometrics 21,
/// 239-245 (1979)). sobol: S. Joe and F. Y. Kuo's sequence (SIAM J. Sci. Comput. 30, 2635-2654
/// (2008)) as Boost has it, without its first point 0; a seed other than 0 adds a shift modulo 1.
std::vector<double> sample_point(const Sample& sample, std::size_t dimensions, long long i);

/// Entry i of a permutation of 0 ... size - 1 that follows from `key`.
long long permuted(long long i, long long size, unsigned long long key);

}  // namespace clackers::campaign
