// The peer of python_samples.py: samples the default case at N equally spaced times, once for each line
// read, into new vectors ("new") or into those that are there ("kept"). Prints the processor time of
// each in nanoseconds.
//
//     python_samples N
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "benchmarks/measure.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::benchmarks {
namespace {

struct States {
  explicit States(std::size_t size) : u(size), v(size), a(size) {}
  std::vector<double> u, v, a;

  void sample(const model::Motion& motion, const std::vector<double>& times) {
    motion.sample(times, model::Side::right, {u, v, a});
  }
};

void serve(std::size_t count) {
  const auto test_case = cases::make(cases::default_case());
  const auto& motion = *test_case.motion;
  const auto size = count * std::size_t(motion.dof());
  std::vector<double> times(count);
  for (std::size_t k = 0; k < count; ++k) times[k] = motion.end() * double(k) / double(count - 1);
  States kept(size);
  for (std::string line; std::getline(std::cin, line);) {
    const double begin = processor_time();
    if (line == "new")
      States(size).sample(motion, times);
    else
      kept.sample(motion, times);
    std::cout << processor_time() - begin << '\n' << std::flush;
  }
}

}  // namespace
}  // namespace clackers::benchmarks

int main(int argc, char** argv) {
  clackers::benchmarks::serve(std::size_t(argc > 1 ? std::atoll(argv[1]) : 10'000'000));
}
