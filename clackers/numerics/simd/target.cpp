#include "clackers/numerics/simd/target.hpp"

#include "clackers/numerics/simd/wanted.hpp"

#include <fmt/format.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>

#include "clackers/base/error.hpp"

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

ForcedTarget::ForcedTarget(Target target) {
  const auto all = available_targets();
  if (std::find(all.begin(), all.end(), target) == all.end())
    throw InputError(
        fmt::format("simd: target {} was asked for; allowed: those of this processor, {} the best.",
                    target.name(), all.front().name()),
        "out-of-range");
  hwy::SetSupportedTargetsForTest(target.bit);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

ForcedTarget::~ForcedTarget() {
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace clackers::numerics::simd
