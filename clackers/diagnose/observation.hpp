#pragma once

#include <limits>
#include <string>
#include <vector>

#include "clackers/base/files/note.hpp"
#include "clackers/measure/errors/comparison.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::diagnose {

/// What is known of a history beside its numbers.
struct FileFacts {
  double step = 0.0;            ///< [s], or the tolerance of an adaptive solver
  double spacing = 0.0;         ///< median time between rows [s]
  double floor = 0.0;           ///< part of u_error that printing alone may make
  double time_half_unit = 0.0;  ///< of printing t [s]
  std::vector<PrintedColumn> columns;
  /// Names of all columns in the file's order, as they were read; empty: t, u1, v1, u2, v2, ...
  std::vector<std::string> order{};
  double contact_time = 0.0;  ///< median length of the contacts in it [s], 0 for instants
};

/// What diagnosis keeps of one history: at most `most_sample_rows` rows of it, so that thousands of
/// histories of a million rows fit into memory and into a second.
struct Observation {
  FileFacts facts;
  long long rows = 0;
  double first = 0.0, last = 0.0;  ///< times of the first and the last row [s]
  /// Rows spread evenly over the history, the first and the last among them; limits of jumps left
  /// out. No time is later than the end of the reference. Its impacts are the first of the history
  /// (reported, or found in it), at most 1000.
  model::Trajectory sample;
  /// Spacings from the first row to each row of `sample`, counted from row to row, so that a time
  /// that drifts off the grid keeps its number; -1 for a row between two places of the grid. Empty
  /// where fewer than nine rows in ten are equally spaced.
  std::vector<long long> sample_steps;
  bool impacts_reported = false;
  /// The first rows, none left out; jumps that the history reports stand there with both limits.
  model::Trajectory opening;
  /// Largest |v - du/dt| over the envelope of v at the rows of `sample`, du/dt by central
  /// differences of fourth order, error (w spacing)^4 / 30 at the frequency w; rows two spacings
  /// from an impact of the history or the reference, or unequally spaced, are left out. What
  /// velocities of another order or half a step away show. NaN without velocities or such rows.
  double velocity_mismatch = std::numeric_limits<double>::quiet_NaN();

  /// The opening where it holds the first impact and what follows, else the sample.
  const model::Trajectory& rows_with_impacts() const {
    const bool has_impact = sample.impacts && !sample.impacts->empty() && !opening.t.empty() &&
                            opening.t.back() > sample.impacts->front().t + 0.5;
    return has_impact ? opening : sample;
  }
};

inline constexpr std::size_t most_sample_rows = 1500, most_opening_rows = 4096,
                             most_sample_impacts = 1000;

/// What diagnosis keeps of a compared history. One pass over its rows: 1e6 rows take a few
/// milliseconds.
Observation observe(const measure::Comparison& comparison, const FileFacts& facts);

}  // namespace clackers::diagnose
