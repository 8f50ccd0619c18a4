#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/naive_pair.hpp"
#include "clackers/exact/batch/batch.hpp"

namespace clackers::benchmarks {

/// Arrays for u1, u2, v1, v2, each at a multiple of 64 bytes.
class AlignedArrays {
 public:
  explicit AlignedArrays(std::size_t count) : count_(count), memory_(4 * (count + 16) + 8) {
    auto* p = memory_.data();
    while (reinterpret_cast<std::uintptr_t>(p) % 64 != 0) ++p;
    // A line of the cache more, so that equal places do not fall on one set of it.
    const std::size_t apart = (count + 7) / 8 * 8 + 8;
    for (auto*& each : start_) each = p, p += apart;
  }
  exact::PairBuffers buffers() const {
    return {{start_[0], count_}, {start_[1], count_}, {start_[2], count_}, {start_[3], count_}};
  }
  exact::PairValues values() const {
    return {{start_[0], count_}, {start_[1], count_}, {start_[2], count_}, {start_[3], count_}};
  }
  NaiveArrays naive() const { return {start_[0], start_[1], start_[2], start_[3]}; }
  double* const (&starts() const)[4] { return start_; }

 private:
  std::size_t count_;
  std::vector<double> memory_;
  double* start_[4];
};

}  // namespace clackers::benchmarks
