#pragma once

// Sources of kernels include this before Highway, so that all agree on the targets: processors with
// SSSE3 and not SSE4 are served by the path without vectors.
#define HWY_DISABLED_TARGETS HWY_SSSE3

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

}  // namespace clackers::numerics::simd
