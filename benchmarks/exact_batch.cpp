// The exact pair at many times (PairBatch) beside the naive loop over <cmath>, NumPy and the store
// bandwidth of the machine. All compute u1, u2, v1, v2 of the pair of Eq. (25). Prints medians of
// alternated runs and what is wanted; asserts nothing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "benchmarks/aligned_arrays.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/naive_pair.hpp"
#include "benchmarks/numpy_process.hpp"
#include "benchmarks/race.hpp"
#include "benchmarks/store_bandwidth.hpp"
#include "clackers/exact/batch/batch.hpp"
#include "clackers/exact/pair/synchronized_pair.hpp"

namespace {

using namespace clackers;
using namespace clackers::benchmarks;
using exact::PairBatch;
using numerics::simd::available_targets;
using numerics::simd::ForcedTarget;

exact::SynchronizedPair pair_of(const NaivePair& p, double end) {
  return exact::SynchronizedPair({.xi1 = p.xi1, .X = p.X, .t_end = end});
}

std::string ours(const numerics::simd::Target& target) {
  return fmt::format("ours, {}", target.name());
}

// The largest error in units of 2^-52 of the envelope, against the scalar closed form (0.51).
double units(const exact::SynchronizedPair& reference, const std::vector<double>& times,
             const exact::PairBuffers& found) {
  double worst = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double u[2], v[2];
    reference.sample({&times[i], 1}, model::Side::right, {u, v, {}});
    const auto envelope = reference.envelope(times[i]);
    const double error[4] = {found.u1[i] - u[0], found.u2[i] - u[1], found.v1[i] - v[0],
                             found.v2[i] - v[1]};
    for (int c = 0; c < 4; ++c)
      worst = std::max(
          worst, std::abs(error[c]) * 0x1p52 / (c < 2 ? envelope.u[c % 2] : envelope.v[c % 2]));
  }
  return worst;
}

void race_times(const NaivePair& p, double end, double wanted, NumpyProcess& numpy) {
  constexpr std::size_t count = 4096;
  const auto reference = pair_of(p, end);
  const PairBatch batch(reference.flight());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, end);
  std::vector<double> times(count);
  for (auto& t : times) t = uniform(random);
  const AlignedArrays arrays(count), other(count);

  Race race(fmt::format("Arbitrary times in cache: X = {}, xi1 = {}, t <= {}, {} samples", p.X,
                        p.xi1, end, count),
            count);
  race.add("naive", [&] { naive_sample(p, times.data(), count, other.naive()); });
  const bool has_numpy = !numpy.version().empty();
  const auto numpy_time = [&](const char* way) {
    return std::stod(numpy.ask(fmt::format("{} {} {} {} {} 8", way, p.xi1, p.X, end, count)));
  };
  if (has_numpy) {
    race.add_timed("NumPy, plain", [&] { return numpy_time("plain"); });
    race.add_timed("NumPy, preallocated", [&] { return numpy_time("out"); });
  }
  const auto sample = [&] { batch.sample(times, model::Side::right, arrays.buffers()); };
  for (const auto& target : available_targets()) race.add(ours(target), sample, target);
  race.run();

  const auto best = ours(Race::best());
  race.want_faster(best, "naive", wanted);
  if (has_numpy) {
    race.want_faster(best, "NumPy, plain", 10.0);
    race.want_faster(best, "NumPy, preallocated", 2.5);
  }
  for (const auto& target : available_targets()) {
    if (target.name() == "AVX2") race.want_faster(ours(target), "naive", 9.5);
    if (target.name() == "SSE4") race.want_faster(ours(target), "naive", 4.0);
  }
  race.print();
  fmt::print("largest error, units of 2^-52 of the envelope:");
  for (const auto& target : available_targets()) {
    const ForcedTarget forced(target);
    sample();
    fmt::print(" {} {:.2f}", target.name(), units(reference, times, arrays.buffers()));
  }
  fmt::print("\n");
}

void race_grid(const NaivePair& p, double end, std::size_t count) {
  const auto reference = pair_of(p, end);
  const PairBatch batch(reference.flight());
  const exact::UniformGrid grid{0.0, end / double(count), count};
  const AlignedArrays arrays(count), other(count);
  const std::string about = fmt::format("X = {}, xi1 = {}, t <= {}, {} samples on {}", p.X, p.xi1,
                                        end, count, Race::best().name());

  Race storing("Uniform grid in L2: " + about, count);
  storing.add("naive", [&] { naive_grid(p, 0.0, grid.step, count, other.naive()); });
  storing.add("ours", [&] { batch.sample(grid, arrays.buffers()); });
  storing.run();
  storing.want_faster("ours", "naive", 50.0);
  storing.print();

  // Kept, so that no side can leave its results uncomputed.
  double kept = 0.0;
  Race reducing("Reduced, not stored: " + about, count);
  reducing.add("naive norms", [&] { kept += naive_norms(p, 0.0, grid.step, count).squares[0]; });
  reducing.add("our norms", [&] { kept += batch.norms(grid).squares.u1; });
  reducing.add("naive errors",
               [&] { kept += naive_errors(p, 0.0, grid.step, count, other.naive()).largest[0]; });
  reducing.add("our errors", [&] { kept += batch.errors(grid, other.values()).largest.u1; });
  reducing.run();
  reducing.want_faster("our norms", "naive norms", 75.0);
  reducing.want_faster("our errors", "naive errors", 75.0);
  reducing.print();
  // The naive loop wrote `other`: at times rounded to doubles, and off by X t ulp.
  const auto worst = batch.errors(grid, other.values()).largest;
  fmt::print("largest errors of the naive loop: u1 {:.1e}, u2 {:.1e}, v1 {:.1e}, v2 {:.1e}{}\n",
             worst.u1, worst.u2, worst.v1, worst.v2, kept == 0.0 ? " " : "");

  // The shortest grid that fills a table of turns, less what its samples take in a long one.
  constexpr std::size_t few = 128;
  const exact::UniformGrid shortest{0.0, grid.step, few};
  const AlignedArrays small(few);
  const auto samples = [&] { return double(few) * storing.time("ours"); };
  Race start(
      fmt::format("Set-up of a motion's grid on {}, without its samples", Race::best().name()), 1);
  start.add("PairBatch", [&] { kept += PairBatch(reference.flight()).constants().end; });
  start.add_timed("PairBatch and grid", [&] {
    const auto both = [&] { PairBatch(reference.flight()).sample(shortest, small.buffers()); };
    return time_of(both, 1000) - samples();
  });
  start.run();
  start.want_time("PairBatch and grid", 1000.0);
  start.print();
}

void race_stream(const NaivePair& p, double end, std::size_t count) {
  const auto reference = pair_of(p, end);
  const PairBatch batch(reference.flight());
  const exact::UniformGrid grid{0.0, end / double(count), count};
  const AlignedArrays arrays(count);
  Race race(fmt::format("Uniform grid into memory: X = {}, xi1 = {}, t <= {}, {} MiB", p.X, p.xi1,
                        end, count * 32 >> 20),
            count);
  const std::string stores[] = {"stores side by side", "stores by array", "memset by array"};
  race.add(stores[0], [&] { stream_four(arrays.starts(), count); });
  race.add(stores[1], [&] { stream_each(arrays.starts(), count); });
  race.add(stores[2], [&] {
    for (double* array : arrays.starts()) std::memset(array, 1, count * sizeof(double));
  });
  race.add("ours", [&] { batch.sample(grid, arrays.buffers()); });
  race.run();
  const auto& fastest =
      *std::min_element(std::begin(stores), std::end(stores),
                        [&](const auto& a, const auto& b) { return race.time(a) < race.time(b); });
  race.want_within("ours", fastest, 1.2);
  race.print();
  fmt::print("store bandwidth {:.2f} GB/s, ours {:.2f} GB/s\n", 32.0 / race.time(fastest),
             32.0 / race.time("ours"));
}

}  // namespace

int main() {
  NumpyProcess numpy(CLACKERS_NUMPY_SCRIPT);
  fmt::print("{}, {}\n", processor(), compiler());
  fmt::print("targets of this processor:");
  for (const auto& target : available_targets()) fmt::print(" {}", target.name());
  if (Race::best().name() == "AVX2") fmt::print("; AVX3 (AVX-512) is compiled and cannot run here");
  fmt::print("\nNumPy {}\n",
             numpy.version().empty() ? "is missing: scripts/setup bench" : numpy.version());
  fmt::print("u1, u2, v1, v2 of Eq. (25); median of {} alternated runs; processor time\n", runs);
  // Damping such that e^-20 is left at the end: far from subnormal numbers.
  race_times({0.05, 81.0}, 400.0, 15.0, numpy);
  race_times({2e-5, 400001.0}, 1e6, 38.0, numpy);
  race_grid({0.05, 81.0}, 400.0, 8192);
  race_stream({0.05, 81.0}, 400.0, std::size_t(1) << 23);
}
