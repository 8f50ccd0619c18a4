#pragma once

#include <cstddef>
#include <cstdint>

#include "clackers/exact/pair/flight_constants.hpp"

namespace clackers::exact {

/// How many times sample_block() takes at most: a bit each in its result.
inline constexpr std::size_t most_in_block = 64;

/// Evaluates a motion at `count` times with the widest vectors of the processor, chosen when the
/// program first comes here. Writes row-major (time, mass); `a` may be null. Returns a bit for each
/// time (the first the lowest) that was left out and is to be evaluated alone: outside [0, end], beside
/// a collision, where E < 2^-1000, and at rest. The others hold the bits that the same operations on
/// single numbers give.
std::uint64_t sample_block(const FlightConstants& c, const double* times, std::size_t count,
                           double* u, double* v, double* a);

}  // namespace clackers::exact
