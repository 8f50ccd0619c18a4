#include "clackers/numerics/simd/target.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace clackers::numerics::simd {

std::string_view Target::name() const { return hwy::TargetName(bit); }

bool Target::has_fma() const {
#if HWY_ARCH_X86
  return (bit & (HWY_AVX2 | HWY_AVX3 | HWY_AVX3_DL)) != 0;
#else
  return (bit & (HWY_SCALAR | HWY_EMU128)) == 0;
#endif
}

std::vector<Target> available_targets() {
  std::vector<Target> targets;
  for (const auto bit : hwy::SupportedAndGeneratedTargets()) targets.push_back({bit});
  return targets;
}

}  // namespace clackers::numerics::simd
