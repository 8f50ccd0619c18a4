#include <fmt/format.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string_view>
#include <utility>

#include "clackers/record/record.hpp"
#include "cli/command.hpp"

#ifndef CLACKERS_LIBRARIES
#error "the build gives CLACKERS_LIBRARIES, the libraries that it found"
#endif

namespace clackers::cli {
namespace {

// hwy::TargetName() is in Highway's library, which is not loaded.
constexpr std::pair<std::int64_t, std::string_view> vector_names[] = {
    {HWY_AVX3_DL, "AVX3_DL"}, {HWY_AVX3, "AVX3"},   {HWY_AVX2, "AVX2"},
    {HWY_SSE4, "SSE4"},       {HWY_SSSE3, "SSSE3"}, {HWY_NEON, "NEON"},
};

// Those that the kernels were compiled for, best first; in brackets what this processor lacks.
std::string vectors() {
  const auto here = hwy::SupportedTargets();
  std::string text;
  for (const auto& [target, name] : vector_names)
    if ((HWY_TARGETS & target) != 0)
      text += fmt::format(fmt::runtime((here & target) != 0 ? "{} " : "({}) "), name);
  return text + "baseline";
}

}  // namespace

std::string version_text() {
  const auto here = record::provenance("");
#ifdef NDEBUG
  const auto* checks = "without assertions";
#else
  const auto* checks = "with assertions";
#endif
  return fmt::format(
      "clackers {}\ncompiler   {}, {}\nvectors    {}\nlibraries  {}\nmachine    {}\nprocessor  {}\n",
      here.version, here.compiler, checks, vectors(), CLACKERS_LIBRARIES, here.machine,
      here.processor);
}

}  // namespace clackers::cli
