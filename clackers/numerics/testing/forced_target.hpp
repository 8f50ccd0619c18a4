#pragma once

// For tests and benchmarks: chooses what kernels run on.

#include "clackers/numerics/simd/target.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace clackers::numerics::simd {

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
