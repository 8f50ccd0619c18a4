#include <fmt/format.h>
#include <hwy/targets.h>

#include "clackers/record/record.hpp"
#include "cli/command.hpp"

#ifndef CLACKERS_LIBRARIES
#error "the build gives CLACKERS_LIBRARIES, the libraries that it found"
#endif

namespace clackers::cli {
namespace {

// Those that the kernels were compiled for, best first; in brackets what this processor lacks.
std::string vectors() {
  const auto here = hwy::SupportedTargets();
  std::string text;
  for (std::int64_t left = HWY_TARGETS; left != 0; left &= left - 1) {
    const auto target = left & -left;
    const auto* form = (here & target) != 0 ? "{}{}" : "{}({})";
    text += fmt::format(fmt::runtime(form), text.empty() ? "" : " ", hwy::TargetName(target));
  }
  return text;
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
