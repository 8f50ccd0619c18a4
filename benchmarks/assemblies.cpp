#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

#include "benchmarks/banded_newmark.hpp"
#include "benchmarks/measure.hpp"
#include "clackers/exact/assembly/assemblies.hpp"
#include "clackers/exact/assembly/assembly.hpp"

// Motions of many masses beside what a step of a method, or a cosine, costs:
// clackers_benchmark_assemblies.
namespace clackers::benchmarks {
namespace {

using exact::AssemblyData;
using exact::AssemblyParameters;

// The chain, S^T M S with S bidiagonal, one row of S after the other.
BandedNewmark peer_of(const AssemblyParameters& p, const model::Motion& motion, double h) {
  const AssemblyData data(p);
  const std::size_t n = data.dof();
  Tridiagonal mass(n), stiffness(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [m2, r, A] = data.pair(i / 2);
    const double m = i % 2 == 0 ? r * m2 : m2;
    const double k = i % 2 == 0 ? m : m * (1.0 + (p.X * p.X - 1.0) * (1.0 - p.xi1 * p.xi1));
    const double entry = i == 0 ? 0.0 : data.entry(i, i - 1);
    for (auto [matrix, value] : {std::pair{&mass, m}, {&stiffness, k}}) {
      matrix->diagonal[i] += value;
      matrix->below[i] = value * entry;
      if (i > 0) matrix->diagonal[i - 1] += value * entry * entry;
    }
  }
  std::vector<double> u(n), v(n);
  const double start = 0.0;
  motion.sample({&start, 1}, model::Side::right, {u, v, {}});
  return {std::move(mass), std::move(stiffness), p.xi1, h, std::move(u), std::move(v)};
}

void race_assembly() {
  const AssemblyParameters p{.pairs = 1e7, .t_end = 200.0};
  const auto motion = exact::make_assembly(p);
  const auto n = static_cast<std::size_t>(motion->dof());
  constexpr std::size_t at_once = 8;
  constexpr int turns = 5;
  const double h = 0.01;
  auto peer = std::make_unique<BandedNewmark>(peer_of(p, *motion, h));
  std::vector<double> times(at_once), u(at_once * n), v(u);
  std::vector<double> one, many, step;
  for (int turn = 0; turn < turns; ++turn) {
    for (double& t : times)
      t = p.t_end * std::fmod(0.618033988749895 * double(turn + &t - times.data()), 1.0);
    step.push_back(time_of([&] { peer->step(); }, 2) * 1e-9);
    one.push_back(time_of(
                      [&] {
                        motion->sample({times.data(), 1}, model::Side::right,
                                       {{u.data(), n}, {v.data(), n}, {}});
                      },
                      2) *
                  1e-9);
    many.push_back(time_of(
                       [&] {
                         motion->sample(times, model::Side::right, {u, v, {}});
                       },
                       1) *
                   1e-9 / double(at_once));
  }
  fmt::print("\nassembly of 1e7 pairs, chain: u, v of 2e7 masses\n{:<52} {:>9}  {:>6}\n", "",
             "s/time", "ratio");
  const double peer_time = median(step);
  fmt::print("{:<52} {:>9.3f}\n", "one banded Newmark step, no impacts", peer_time);
  const auto print = [&](const char* name, double seconds) {
    fmt::print("{:<52} {:>9.3f}  {:>6.1f}  <= 0.2 s {}, >= 15x {}\n", name, seconds,
               peer_time / seconds, seconds <= 0.2 ? "reached" : "missed",
               peer_time / seconds >= 15.0 ? "reached" : "missed");
  };
  print("Motion::sample, one time a call", median(one));
  print("Motion::sample, eight times a call", median(many));
}

void race_buildings() {
  const exact::BuildingsParameters p{.left = 100.0, .right = 100.0, .t_end = 400.0};
  const auto motion = exact::make_buildings(p);
  const auto n = static_cast<std::size_t>(motion->dof());
  constexpr std::size_t samples = 1000000, block = 1000;
  std::vector<double> times(block), u(block * n), v(u), angles(block * n);
  for (std::size_t i = 0; i < block; ++i)
    times[i] = p.t_end * std::fmod(0.618033988749895 * double(i), 1.0);
  for (std::size_t i = 0; i < angles.size(); ++i)
    angles[i] = 1000.0 * std::fmod(0.618033988749895 * double(i), 1.0);
  const auto repeated = [&](const auto& work) {
    return time_of(work, int(samples / block)) * double(samples / block) * 1e-9;
  };
  const double cosines = repeated([&] {
    for (std::size_t i = 0; i < angles.size(); ++i) u[i] = std::cos(angles[i]);
  });
  const double states = repeated([&] { motion->sample(times, model::Side::right, {u, v, {}}); });
  fmt::print(
      "\nbuildings of 100 storeys each at 1e6 times: u, v of 200 masses\n{:<52} {:>9}  {:>6}\n", "",
      "s", "ratio");
  fmt::print("{:<52} {:>9.2f}\n", "std::cos, one a mass and time", cosines);
  fmt::print("{:<52} {:>9.2f}  {:>6.2f}  <= 5 {}\n", "Motion::sample", states, states / cosines,
             states <= 5.0 * cosines ? "reached" : "missed");
}

}  // namespace
}  // namespace clackers::benchmarks

int main() {
  using namespace clackers::benchmarks;
  fmt::print("{}, {}\nprocessor time\n", processor(), compiler());
  race_buildings();
  race_assembly();
}
