#include "clackers/record/record.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <time.h>

#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"

#ifndef CLACKERS_VERSION
#error "the build gives CLACKERS_VERSION, the version of the project"
#endif

namespace clackers::record {
namespace {

std::string compiler_name() {
#if defined(__clang__)
  return __VERSION__;  // begins with its name already
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

std::string machine_name() {
  utsname name{};
  if (uname(&name) != 0) return "unknown";
  return fmt::format("{} {}, {}, {} processors", name.sysname, name.release, name.machine,
                     std::thread::hardware_concurrency());
}

std::string now_utc() {
  const time_t now = time(nullptr);
  tm parts{};
  char text[32];
  if (gmtime_r(&now, &parts) == nullptr ||
      strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts) == 0)
    return "unknown";
  return text;
}

}  // namespace

std::string processor_name(const std::string& cpuinfo) {
  const auto line = cpuinfo.find("model name");
  if (line == std::string::npos) return "unknown";
  const auto end = cpuinfo.find('\n', line);
  const auto colon = cpuinfo.find(": ", line);
  if (colon == std::string::npos || colon > end) return "unknown";
  return cpuinfo.substr(colon + 2, end == std::string::npos ? end : end - colon - 2);
}

Provenance provenance(std::string command) {
  std::string cpuinfo;
  try {
    cpuinfo = read_file("/proc/cpuinfo");
  } catch (const FileError&) {
    // The name stays unknown.
  }
  return {std::move(command), CLACKERS_VERSION,        compiler_name(),
          machine_name(),     processor_name(cpuinfo), now_utc()};
}

}  // namespace clackers::record
