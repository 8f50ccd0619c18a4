// The peer of python_samples.py: for each line read, samples the default case at N equally spaced times
// into new vectors and prints the processor time of the call in nanoseconds.
//
//     python_samples N
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "benchmarks/measure.hpp"
#include "clackers/cases/case.hpp"

int main(int argc, char** argv) {
  using namespace clackers;
  const auto count = std::size_t(argc > 1 ? std::atoll(argv[1]) : 10'000'000);
  const auto which = cases::make(cases::default_case());
  const auto& motion = *which.motion;
  const auto size = count * std::size_t(motion.dof());
  std::vector<double> times(count);
  for (std::size_t k = 0; k < count; ++k)
    times[k] = motion.end() * double(k) / double(count - 1);
  for (std::string line; std::getline(std::cin, line);) {
    const double begin = benchmarks::processor_time();
    std::vector<double> u(size), v(size), a(size);
    motion.sample(times, model::Side::right, {u, v, a});
    std::cout << benchmarks::processor_time() - begin << '\n' << std::flush;
  }
}
