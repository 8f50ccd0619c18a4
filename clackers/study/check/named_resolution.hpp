#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace clackers::study {

/// What a file's name says of the step or the tolerance of its run: the number behind a word, with
/// "=", "_" or "-" between them or nothing, and "p" for its decimal point: h0.01.csv,
/// run-dt=1e-3.txt, step_0p005.out, N400.dat, rtol1e-06.csv. Upper case is lower case. Folders do
/// not count.
struct NamedResolution {
  std::optional<double> step;       ///< [s], > 0; behind h, dt, step, timestep
  std::optional<double> count;      ///< of steps, 10 or more; behind n, nt, steps, nsteps
  std::optional<double> tolerance;  ///< in (0, 1/10]; behind tol, rtol, atol, reltol, abstol, eps
};

/// Of several numbers of one kind the first counts.
NamedResolution named_resolution(std::string_view path);

/// A history of a set as its name and its rows describe it.
struct NamedHistory {
  NamedResolution named;
  double spacing = 0.0;  ///< median time between rows [s]
};

/// What names say of a set.
struct NamedSteps {
  bool by_tolerance = false;  ///< `steps` are tolerances
  /// One a history: the step [s] or the tolerance; nothing where the time between rows counts.
  std::vector<std::optional<double>> steps;
};

/// Whether the numbers in names are steps. Where every name has a tolerance, they differ, and steps
/// do not, it is a ladder of tolerances. Steps are taken of a whole set where all differ, none
/// exceeds the fast period, and a history with a longer step has no closer rows: then rows that are
/// closer than the step are dense or resampled output. Otherwise a history has the step in its name
/// unless that is longer than the time between its rows.
///
/// `fast_period` and `end` of the case [s]; a number of steps n stands for end / n.
NamedSteps named_steps(std::span<const NamedHistory> set, double fast_period, double end);

}  // namespace clackers::study
