// Which instruction set kernels run on. Highway's library does the same; when a program starts it measures the
// processor's clock besides, for milliseconds. Where these definitions are compiled, it is not linked.
#undef HWY_SHARED_DEFINE  // no symbols of our libraries
#include <hwy/targets.h>

#include <atomic>
#include <cstdint>

namespace hwy {
namespace {

std::atomic<std::int64_t> forced{0};

// Processors with AVX2 have F16C and LZCNT as well.
std::int64_t detect() {
  __builtin_cpu_init();
  std::int64_t targets = HWY_EMU128 | HWY_SCALAR;
  if (!__builtin_cpu_supports("ssse3")) return targets;
  targets |= HWY_SSSE3;
  if (!__builtin_cpu_supports("sse4.1") || !__builtin_cpu_supports("sse4.2") ||
      !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("aes"))
    return targets;
  targets |= HWY_SSE4;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2"))
    return targets;
  targets |= HWY_AVX2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl") ||
      !__builtin_cpu_supports("avx512dq") || !__builtin_cpu_supports("avx512bw"))
    return targets;
  return targets | HWY_AVX3;
}

}  // namespace

std::int64_t SupportedTargets() {
  static const std::int64_t found = detect();
  const auto only = forced.load();
  return only != 0 ? only : found;
}

void SetSupportedTargetsForTest(std::int64_t targets) { forced = targets; }

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
