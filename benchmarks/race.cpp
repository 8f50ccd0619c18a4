#include "benchmarks/race.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "benchmarks/measure.hpp"

namespace clackers::benchmarks {

using numerics::simd::ForcedTarget;
using numerics::simd::Target;

Target Race::best() { return numerics::simd::available_targets().front(); }

void Race::add(std::string name, std::function<void()> call, Target target) {
  runners_.push_back({std::move(name), target, std::move(call), {}, 1, {}});
}

void Race::add_timed(std::string name, std::function<double()> own_time) {
  runners_.push_back({std::move(name), best(), {}, std::move(own_time), 1, {}});
}

double Race::time(const std::string& name) const {
  for (const auto& r : runners_)
    if (r.name == name) return median(r.times);
  throw std::logic_error("benchmark: nobody is called " + name);
}

void Race::run() {
  for (auto& r : runners_) {
    const ForcedTarget forced(r.target);
    if (r.call) r.repeats = calibrate(r.call);
  }
  for (int i = 0; i < runs; ++i)
    for (auto& r : runners_) {
      const ForcedTarget forced(r.target);
      const double t = r.call ? time_of(r.call, r.repeats) : r.own_time();
      r.times.push_back(t / double(samples_));
    }
}

void Race::want_faster(const std::string& name, const std::string& peer, double least) {
  const double ratio = time(peer) / time(name);
  wants_.push_back(
      {name, peer, fmt::format("{:.2f}", ratio), fmt::format(">= {}", least), ratio >= least});
}

void Race::want_within(const std::string& name, const std::string& peer, double most) {
  const double ratio = time(name) / time(peer);
  wants_.push_back(
      {name, peer, fmt::format("{:.3f}", ratio), fmt::format("<= {}", most), ratio <= most});
}

void Race::want_time(const std::string& name, double most) {
  wants_.push_back({name, "", "", fmt::format("<= {}", most), time(name) <= most});
}

void Race::print() const {
  fmt::print("\n{}\n{:>34}  {:<20}{:>7}  {}\n", title_, samples_ > 1 ? "ns/sample" : "ns", "beside",
             "ratio", "wanted");
  for (const auto& r : runners_) {
    fmt::print("{:<24}{:>10.3f}", r.name, median(r.times));
    bool first = true;
    for (const auto& want : wants_) {
      if (want.name != r.name) continue;
      fmt::print("{}  {:<20}{:>7}  {:<10}{}\n", first ? "" : std::string(34, ' '), want.peer,
                 want.ratio, want.limit, want.reached ? "reached" : "MISSED");
      first = false;
    }
    if (first) fmt::print("\n");
  }
}

}  // namespace clackers::benchmarks
