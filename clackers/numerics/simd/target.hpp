#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace clackers::numerics::simd {

/// An instruction set that kernels were compiled for; the fastest one of the processor is chosen
/// when the first kernel runs.
struct Target {
  std::int64_t bit = 0;  ///< Highway's number of it

  /// "AVX3" (AVX-512), "AVX2", "SSE4", "SSSE3", or what is left without vectors: "SCALAR",
  /// "EMU128".
  std::string_view name() const;
  /// A product and a sum with one rounding are one instruction.
  bool has_fma() const;

  friend bool operator==(const Target&, const Target&) = default;
};

/// Those that were compiled and that this processor can run, the fastest first.
std::vector<Target> available_targets();

/// While it lives all kernels of the process run on `target`, which must be available. For tests
/// and benchmarks: not safe beside threads that run kernels.
class ForcedTarget {
 public:
  explicit ForcedTarget(Target target);
  ~ForcedTarget();
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
};

}  // namespace clackers::numerics::simd
