#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "clackers/model/motion.hpp"

namespace clackers::measure {

/// The reference at the instants of a run: right limits, row-major (time, mass).
struct GridStates {
  std::vector<double> t, u, v;

  /// Whether `times` are t[first], t[first + 1], ..., to the bit.
  bool holds(std::size_t first, std::span<const double> times) const;

  /// Fills rows from `row` on, and drops those behind, with the states at start + k h of up to `most` steps from
  /// k = `first` on; the last of `steps` steps ends at the end of the motion to the bit. A value may depend in its last bit on
  /// the times sampled with it: all who ask for multiples of `most` have the same bits.
  void fill(const model::Motion& reference, double start, double h, std::size_t steps,
            std::size_t first, std::size_t row);
  static constexpr std::size_t most = 2048;
};

/// The reference at the instants start + k h of those steps that the candidates of a study share, each
/// computed once. They are kept up to a bound; what does not fit is not shared. From any thread.
class SharedStates {
 public:
  /// From `start`, where runs begin, to the end of the motion [s].
  SharedStates(std::shared_ptr<const model::Motion> reference, double start)
      : reference_(std::move(reference)), start_(start) {}

  /// For `steps` steps of h [s], the last of which ends at the end to the bit; null where they do not
  /// fit. Valid as long as this is.
  const GridStates* of(double h, long long steps);

  /// The default ladder of the default case needs three quarters.
  static constexpr std::size_t most_numbers = std::size_t(1) << 23;

 private:
  struct Entry {
    std::once_flag once;
    GridStates states;
  };
  GridStates make(double h, std::size_t steps) const;

  std::shared_ptr<const model::Motion> reference_;
  double start_;
  std::mutex guard_;
  std::map<std::pair<double, long long>, Entry> kept_;
  std::size_t numbers_ = 0;
};

}  // namespace clackers::measure
