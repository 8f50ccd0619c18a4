#include "clackers/campaign/specification.hpp"

#include <bit>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstdint>

#include "clackers/base/mixed_bits.hpp"

namespace clackers::campaign {
namespace {

std::uint64_t key_of(const Sample& sample, std::size_t dimension) {
  return mixed_bits(mixed_bits(static_cast<std::uint64_t>(sample.seed)) + dimension);
}

// In [0, 1).
double share_of(std::uint64_t bits) { return std::ldexp(double(bits >> 11), -53); }

}  // namespace

// A Feistel network of four rounds permutes the next power of four; what lies beyond `size` goes
// through it again until it does not.
long long permuted(long long i, long long size, unsigned long long key) {
  const auto bits = (std::bit_width(static_cast<std::uint64_t>(size)) + 1) / 2;
  const auto mask = (std::uint64_t{1} << bits) - 1;
  auto x = static_cast<std::uint64_t>(i);
  do {
    auto left = x >> bits, right = x & mask;
    for (std::uint64_t round = 0; round < 4; ++round) {
      const auto next = left ^ (mixed_bits(mixed_bits(key + round) + right) & mask);
      left = right;
      right = next;
    }
    x = left << bits | right;
  } while (x >= static_cast<std::uint64_t>(size));
  return static_cast<long long>(x);
}

std::vector<double> sample_point(const Sample& sample, std::size_t dimensions, long long i) {
  std::vector<double> point(dimensions);
  if (sample.kind == SampleKind::latin_hypercube) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      const auto key = key_of(sample, d);
      const auto place = share_of(mixed_bits(key ^ mixed_bits(static_cast<std::uint64_t>(i))));
      point[d] = (double(permuted(i, sample.points, key)) + place) / double(sample.points);
    }
    return point;
  }
  boost::random::sobol sequence(dimensions);
  sequence.discard(static_cast<std::uint64_t>(i) * dimensions);
  for (std::size_t d = 0; d < dimensions; ++d) {
    point[d] = share_of(sequence());
    if (sample.seed != 0) point[d] = std::fmod(point[d] + share_of(key_of(sample, d)), 1.0);
  }
  return point;
}

}  // namespace clackers::campaign
