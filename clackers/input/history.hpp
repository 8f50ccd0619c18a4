#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "clackers/base/files/note.hpp"
#include "clackers/input/source.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::input {

/// What is known of a source before it is read.
struct HistoryOptions {
  int dof = 1;                         ///< masses; columns of others are left out
  std::vector<std::string> columns{};  ///< names that replace or stand for a header; "_" skips one
  /// Of a file without a time column [s]: row n = 0, 1, ... is at n step. 0: there must be one.
  double step = 0.0;
  /// The first NaN or infinite number ends the history, if two times stand above it.
  bool until_not_finite = false;
  const std::atomic<bool>* interrupt = nullptr;  ///< ends the reading with Error (interrupted)
  /// Called now and then with the share that is read, in [0, 1]; never for a file of unknown size.
  std::function<void(double share)> progress{};
  ResultChoice results{};
};

/// What a source says of its cost, in a comment below its rows: "# seconds 0.12 steps 20000 evaluations
/// 80000". 0: not said.
struct StatedCost {
  double seconds = 0.0;  ///< processor time without the start of the program [s]
  double steps = 0.0;
  double evaluations = 0.0;  ///< of forces
};

/// A time history as it stands in its source.
struct History {
  /// Masses without a column u: their u is 0 and means nothing. v and a are empty unless there is a
  /// column for every mass. Impacts are not reported.
  model::Trajectory motion;
  std::vector<bool> has_u;             ///< one entry a mass
  bool has_time = true;                ///< false: times are n step
  std::vector<std::string> names;      ///< of all columns in their order, "_" for a skipped one
  std::vector<PrintedColumn> columns;  ///< those that were used, time first if there is one
  /// Rounding error of the times by printing [s]; 0 when they are equally spaced to the last digit,
  /// since such times were hardly rounded.
  double time_half_unit = 0.0;
  double spacing = 0.0;    ///< median time between rows [s]
  std::string not_finite;  ///< where the first such number stands, a sentence; empty for none
  StatedCost cost;
  std::vector<Note> notes;
};

/// Reads a history from a text file, a NumPy file (.npy, known by its first bytes) or columns in
/// memory, or a result file of another program (results/result_table.hpp), known by its first bytes too:
/// columns t (or time), u1, v1, a1, u2, ... (u, v, a alone for one mass), in any order and
/// case, others left out. Two rows of one time are the left and right limits of a jump, as a column
/// side may say: "-" or -1, "+" or 1.
///
/// Of text: fields separated by commas, semicolons, tabs or blanks; names from a header, from a
/// comment above the rows, or from the options; comments behind # or %. Of a NumPy file: fields of a
/// structured array, or the columns of a plain one with names from the options.
///
/// Throws InputError with source, row and column for what is no number, not finite or has a decimal
/// comma, rows of another length, times that descend or stand more than twice, missing columns (t
/// unless options.step is given, and one u), fewer than two different times, and what is no NumPy
/// file of numbers (not-an-array); FileError when a file cannot be read.
History read_history(const Source& source, const HistoryOptions& options);

/// Reads a list of impacts from any source: a column t and, where they are known, impulse, u1,
/// v1-, v1+, u2, ... (v-, v+ for one mass); one column alone needs no name. Other columns are left
/// out. What is not given of an impact is NaN; a quantity that no mass has is an empty vector. No
/// rows: there were no impacts. With several `contacts` a column contact names one of them, from
/// 0.
///
/// Throws InputError as read_history does, for times that descend, and for contacts that are missing
/// or none of the problem's; FileError when a file cannot be read.
std::vector<model::Impact> read_events(const Source& source, int dof, int contacts = 1,
                                       const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::input
