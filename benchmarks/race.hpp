#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clackers/numerics/simd/target.hpp"

namespace clackers::benchmarks {

/// Programs that do the same work, timed in turns: `runs` times each, one after the other, so that
/// what changes on the machine changes for all. What counts is the median of each.
class Race {
 public:
  /// `samples` is what one call does; times are printed for one of them.
  Race(std::string title, std::size_t samples) : title_(std::move(title)), samples_(samples) {}

  /// Who takes part; `call` does the work once, with kernels on `target`.
  void add(std::string name, std::function<void()> call, numerics::simd::Target target = best());
  /// Whose time of one call is told by `own_time` [ns].
  void add_timed(std::string name, std::function<double()> own_time);

  void run();
  /// Median time of a sample [ns].
  double time(const std::string& name) const;

  /// What is asked for, for the table: `peer` takes at least `least` times as long as `name`.
  void want_faster(const std::string& name, const std::string& peer, double least);
  /// `name` takes at most `most` times as long as `peer`.
  void want_within(const std::string& name, const std::string& peer, double most);
  /// A sample of `name` takes at most `most` [ns].
  void want_time(const std::string& name, double most);

  /// After run(): all times and what is reached, in at most 80 columns.
  void print() const;

  /// The fastest target of this processor.
  static numerics::simd::Target best();

 private:
  struct Runner {
    std::string name;
    numerics::simd::Target target;
    std::function<void()> call;
    std::function<double()> own_time;
    int repeats = 1;
    std::vector<double> times;  // [ns] of a sample
  };
  struct Want {
    std::string name, peer, ratio, limit;
    bool reached;
  };

  std::string title_;
  std::size_t samples_;
  std::vector<Runner> runners_;
  std::vector<Want> wants_;
};

}  // namespace clackers::benchmarks
