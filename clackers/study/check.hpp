#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/study/check_record.hpp"

namespace clackers::study {

/// What `clackers check` is asked for.
struct CheckRequest {
  std::vector<std::string> files;  ///< one or more; several are levels of one method
  std::string case_name;           ///< empty: the default case
  cases::Settings settings;
  std::vector<std::string> columns;  ///< names of the columns; empty: those of the files
  std::vector<std::string> events;   ///< files of collisions: none, or one a history
  std::vector<double> steps;         ///< none, or one a history [s]
  std::optional<Claim> expect;
  std::optional<double> tolerance;  ///< largest allowed u_error, 0 < tolerance
  std::string command;              ///< as typed
};

/// Judges histories of any program against the exact motion of a case.
///
/// A level's step is the one of `steps`; else the number behind "h" in the file's name (h0.01.csv,
/// run_h=1e-3.txt); else the median time between rows. A history without times has them from
/// `steps`, its first row at 0 if it is the initial state and at one step otherwise. Rows after the
/// end of the case are left out with a note.
///
/// Verdict: with `expect` that of assess::judge, `undecided` where printed digits hide the errors;
/// with `tolerance` whether the finest history's u_error is within it, `undecided` where the printed
/// digits do not tell; the worse of both. Without either `not claimed`, unless the finest history
/// misses a collision, has one too many, or begins far from the reference: that `disagrees`.
///
/// Throws InputError for what read_history refuses, a history that starts from another state than
/// the case (not-this-case), and options that do not fit the files; FileError for files that cannot
/// be read; Error (interrupted) when `interrupt` becomes true.
CheckRecord check(const CheckRequest& request, const std::atomic<bool>* interrupt = nullptr);

/// "proper:2", "irregular:1", "exact": a behaviour and, where it needs one, an order. Throws
/// InputError for any other text.
Claim claim_from(std::string_view text);

/// 0 agrees or nothing claimed, 1 disagrees, 3 undecided.
int exit_code(const CheckRecord& record);

}  // namespace clackers::study
