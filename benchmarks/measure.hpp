#pragma once

#include <string>
#include <vector>

namespace clackers::benchmarks {

inline constexpr int runs = 15;

/// As the operating system calls it.
std::string processor();
/// What this program was compiled by.
std::string compiler();

double median(std::vector<double> x);

/// Processor time of this process [ns]: what else runs on the machine does not count.
double processor_time();

/// Repeats `work` until it takes `at_least` [ns] in one go. Returns the number of repetitions.
template <class Work>
int calibrate(const Work& work, double at_least = 1e6) {
  for (int n = 1;; n *= 2) {
    const double begin = processor_time();
    for (int i = 0; i < n; ++i) work();
    if (processor_time() - begin >= at_least || n >= 1 << 24) return n;
  }
}

/// Mean processor time of one of n calls [ns].
template <class Work>
double time_of(const Work& work, int n) {
  const double begin = processor_time();
  for (int i = 0; i < n; ++i) work();
  return (processor_time() - begin) / n;
}

}  // namespace clackers::benchmarks
