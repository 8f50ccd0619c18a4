#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "clackers/input/source.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::study {

/// What `clackers check --against` is asked for: two sets of histories of one motion that nobody knows.
struct AgainstRequest {
  /// Each set a ladder of one solver. The first file is read twice, so it is not standard input.
  std::array<std::vector<input::Source>, 2> sets;
  std::vector<std::string> columns;  ///< names of the columns; empty: those of the files
  std::vector<double> steps;         ///< none, or one a history, over both sets [s]
  std::vector<double> tolerances;    ///< the same, instead of steps
  std::optional<double> tolerance;   ///< largest allowed difference over the largest displacement
  input::ResultChoice results{};     ///< of files that other programs wrote
};

struct AgainstResult {
  /// Of each mass the largest difference and when it exceeds `visible_difference`; of each set the
  /// order with which its own differences fall.
  std::vector<record::Sheet> sheets;
  /// Curves of the relative differences of the first masses; the mark is where the first is visible.
  record::Sheet differences;
  /// Of the tolerance; true without one, nothing where only a part could be compared and is.
  std::optional<bool> is_within = true;
};

/// A difference of displacements over the largest displacement of the mass.
inline constexpr double visible_difference = 1e-3;

/// Compares the finest histories of two sets at the times that both have, and each set with itself.
/// Nothing is interpolated, so nothing is across an impact; displacements have no jumps. Steps are
/// found as check() finds them, without the limits that a case gives.
///
/// Throws InputError for what read_history refuses, an empty set, numbers of masses that differ,
/// fewer than `least_common_times`, and options out of range; FileError for files that cannot be
/// read; Error (interrupted) when `interrupt` becomes true.
AgainstResult check_against(const AgainstRequest& request,
                            const std::atomic<bool>* interrupt = nullptr);
inline constexpr std::size_t least_common_times = 10;

}  // namespace clackers::study
