#pragma once

#include <span>
#include <string>
#include <vector>

#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

// How the columns of a file stand to the quantities of a motion. Quantities are numbered u1, u2, ...
// and then v1, v2, ...; a file without velocities has the first half.
namespace clackers::diagnose {

/// One way to read a file: quantity q stands in the column that is labelled `column[q]`, and the
/// number there is factor[q] times the quantity.
struct Reading {
  std::string code;  ///< what is wrong with the file if this reading is the right one
  std::vector<std::size_t> column;
  std::vector<double> factor;

  /// The file as it is.
  static Reading plain(std::size_t quantities);
  bool permutes() const;
  std::vector<double> applied(std::span<const double> numbers) const;
};

/// The rows under the reading; impacts and accelerations are left out.
model::Trajectory read_as(const Reading& reading, const model::Trajectory& rows);

/// Exchanges of columns in the order in which they are believed: masses, then others with few moved
/// columns first. All permutations for up to two masses, pairs of masses beyond. Without the plain
/// one.
std::vector<Reading> exchanges(std::size_t masses, bool has_v);

/// Reversed signs in the order in which they are believed: all, one mass, all v, all u, one column.
std::vector<Reading> reversals(std::size_t masses, bool has_v);

/// "u1", "v2": the name of a quantity.
std::string quantity_name(std::size_t quantity, std::size_t masses);

/// What --columns needs so that the reading holds: `columns` with the names in other places. Empty
/// `columns`: t, u1, v1, u2, v2, ...
std::string columns_option(const Reading& reading, const std::vector<std::string>& columns,
                           std::size_t masses);

/// The names of the quantities with a negative factor: "u2,v2".
std::string reversed_columns(const Reading& reading, std::size_t masses);

/// The factor of numbers over those of the reference in the sense of least squares.
double factor_of(std::span<const double> numbers, std::span<const double> reference);

/// The motion at these times, right limits; times outside [0, end] are moved to its ends.
model::Trajectory reference_rows(const model::Motion& motion, std::span<const double> times,
                                 bool with_v = true);

}  // namespace clackers::diagnose
