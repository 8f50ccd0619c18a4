#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/input/source.hpp"
#include "clackers/record/record.hpp"

namespace clackers::study {

/// Histories of one solver; several are levels of one ladder.
struct NamedHistories {
  std::vector<input::Source> files;
  std::string name = "histories";
};

/// What `clackers check` is asked for.
struct CheckRequest {
  /// Each with its own name and one history or more. "-" is standard input, one of all files at most.
  std::vector<NamedHistories> subjects = std::vector<NamedHistories>(1);
  std::string case_name;  ///< empty: the default case
  cases::Settings settings;
  std::vector<std::string> columns;  ///< names of the columns; empty: those of the files
  input::ResultChoice results{};     ///< of files that other programs wrote
  // Over the histories of all subjects, in their order:
  std::vector<input::Source> events;  ///< impacts: none, or one a history
  std::vector<double> steps;          ///< none, or one a history [s]
  std::vector<double> tolerances;     ///< none, or one a history instead of a step, of (0, 1)
  std::optional<Claim> expect;        ///< of every subject
  record::Labels labels{};            ///< the same
  std::optional<double> tolerance;    ///< largest allowed u_error, 0 < tolerance
  std::string command;                ///< as typed
};

/// Assesses histories of any program against the exact motion of a case: a record of one case. Of
/// several subjects the numbers of steps are their work.
///
/// A run's step is the one of `steps`; else the one in the source's name (h0.01.csv, dt=1e-3.npy,
/// N400.csv; named_steps()); else the median time between rows. `tolerances`, or names like
/// rtol1e-06.csv, make a ladder of tolerances. A history without times has them from `steps`, its
/// first row at 0 if it is the initial state and at one step otherwise. Rows after the end of the
/// case are left out with a note. Steps of one octave are one level. A history that NaN or infinity
/// ends is a failed run of its level.
///
/// judge::judge gives behaviour and verdict. Its claim is `expect`; without it the verdict goes by
/// the tolerance; without both the finest history disagrees where it misses an impact, has one too
/// many, or begins far from the reference.
///
/// Throws InputError for what read_history refuses, subjects without a finite history, one that
/// starts from another state than the case (not-this-case), and options that do not fit the files;
/// FileError for files that cannot be read; Error (interrupted) when `interrupt` becomes true.
record::Record check(const CheckRequest& request, const Progress& progress = {},
                     const std::atomic<bool>* interrupt = nullptr);

/// "proper:2", "irregular:1", "exact", "stagnating:contact-stiffness": a behaviour and, where it
/// needs one, an order, or the reason of a floor; "velocity:1" or "proper:2,velocity:1":
/// the order of the velocities. Throws InputError for any other text.
Claim claim_from(std::string_view text);

}  // namespace clackers::study
