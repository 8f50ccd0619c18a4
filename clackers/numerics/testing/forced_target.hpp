#pragma once

// For tests and benchmarks: chooses the instruction set that kernels run on. To be included after
// hwy/foreach_target.h where that is.

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace clackers::numerics::simd {

/// An instruction set that kernels were compiled for.
struct Target {
  std::int64_t bit = 0;                                      ///< Highway's number of it
  std::string name() const { return hwy::TargetName(bit); }  ///< "AVX3" (AVX-512), "AVX2", "SSE4"
};

/// Those that were compiled and that this processor can run, the fastest first.
inline std::vector<Target> available_targets() {
  std::vector<Target> targets;
  for (const auto bit : hwy::SupportedAndGeneratedTargets()) targets.push_back({bit});
  return targets;
}

/// While it lives all kernels of the process run on `target`, one of available_targets(). Not safe
/// beside threads that run kernels.
class ForcedTarget {
 public:
  explicit ForcedTarget(Target target) {
    hwy::SetSupportedTargetsForTest(target.bit);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ~ForcedTarget() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
};

}  // namespace clackers::numerics::simd
