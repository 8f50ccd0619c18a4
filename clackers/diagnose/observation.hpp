#pragma once

#include <string>
#include <vector>

#include "clackers/assess/errors/comparison.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::diagnose {

/// How a column of a history is printed.
struct ColumnDigits {
  std::string name;  ///< "t", "u1", "v2"
  int digits = 0;
  bool single = false;     ///< every number is one of single precision
  double half_unit = 0.0;  ///< largest rounding error of printing, in the column's unit
};

/// What is known of a history beside its numbers.
struct FileFacts {
  double step = 0.0;            ///< [s], or the tolerance of an adaptive solver
  double spacing = 0.0;         ///< median time between rows [s]
  double floor = 0.0;           ///< part of u_error that printing alone may make
  double time_half_unit = 0.0;  ///< of printing t [s]
  std::vector<ColumnDigits> columns;
  double contact_time = 0.0;  ///< median length of the contacts in it [s], 0 for instants
};

/// What diagnosis keeps of one history: at most `most_sample_rows` rows of it, so that thousands of
/// histories of a million rows fit into memory and into a second.
struct Observation {
  FileFacts facts;
  long long rows = 0;
  double first = 0.0, last = 0.0;  ///< times of the first and the last row [s]
  /// Rows spread evenly over the history, the first and the last among them; limits of jumps left
  /// out. Its impacts are those of the history (reported, or found in it), at most 1000.
  model::Trajectory sample;
  bool impacts_reported = false;
  /// The first rows as they stand, none left out.
  model::Trajectory opening;
  /// Largest |v - du/dt| over the envelope of v, du/dt by central differences of the rows away from
  /// impacts, against the spacing: what velocities of another order or half a step away show.
  /// NaN without velocities.
  double velocity_mismatch = 0.0;
};

inline constexpr std::size_t most_sample_rows = 1500, most_opening_rows = 4096;

/// What diagnosis keeps of a compared history.
Observation observe(const assess::Comparison& comparison, const FileFacts& facts);

}  // namespace clackers::diagnose
