#include "benchmarks/measure.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>

namespace clackers::benchmarks {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::string name = "unknown", numbers;
  for (std::string line; std::getline(file, line) && !line.empty();) {
    const auto value = [&] { return line.substr(std::min(line.find(':') + 2, line.size())); };
    if (line.starts_with("model name")) name = value();
    if (line.starts_with("cpu family")) numbers += " family " + value();
    if (line.starts_with("model\t")) numbers += " model " + value();
  }
  return name + numbers;
}

std::string compiler() {
#if defined(__clang__)
  return std::string("Clang ") + __clang_version__;
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * double(now.tv_sec) + double(now.tv_nsec);
}

}  // namespace clackers::benchmarks
