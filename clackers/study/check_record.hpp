#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "clackers/assess/convergence/assessment.hpp"
#include "clackers/assess/errors/score.hpp"
#include "clackers/base/judgement.hpp"
#include "clackers/study/metric_result.hpp"
#include "clackers/study/record.hpp"

namespace clackers::study {

/// How a column of a history is printed.
struct PrintedColumn {
  std::string name;
  int digits = 0;
  bool single = false;     ///< numbers of single precision
  double half_unit = 0.0;  ///< largest rounding error of printing, in the column's unit
};

/// Where a level's step comes from.
enum class StepSource { data, name, option };
/// Where a history's collisions come from; `unknown`: neither reported nor to be found.
enum class CollisionSource { events, history, unknown };

std::string_view to_string(StepSource source);       ///< "data", "name", "option"
std::string_view to_string(CollisionSource source);  ///< "events", "history", "unknown"

/// One history against the reference.
struct CheckedFile {
  std::string file;
  long long rows = 0;              ///< judged
  long long rows_beyond = 0;       ///< after the end of the case, left out
  double first = 0.0, last = 0.0;  ///< times of the first and the last row judged [s]
  double spacing = 0.0;            ///< median time between rows [s]
  StepSource step_source = StepSource::data;
  std::vector<PrintedColumn> columns;
  /// What printing alone may make of u_error.
  double printed_floor = 0.0;
  std::string printed_by;  ///< the column that makes most of it, empty for none
  /// Between two rows the fast mass may leave the straight line by this part of its amplitude.
  double unseen_bend = 0.0;
  bool has_velocities = false;
  std::vector<bool> has_u;  ///< one entry a mass
  /// Largest distance of the first row from the reference, relative to envelopes of u and v; a row at
  /// the start is the initial state.
  double start_error = 0.0;
  CollisionSource collisions = CollisionSource::unknown;
  bool rows_resolve_collisions = true;  ///< false: rows too far apart to find collisions in them
  double contact_time = 0.0;  ///< median length of the contacts found in it [s], 0 for instants
  assess::RunScore score;     ///< NaN where the history lacks what an error needs
  std::vector<MetricResult> metrics;
  std::vector<std::string> notes;  ///< sentences
  /// For figures, at no more than most_points rows, one entry a mass: the displacements [m] and
  /// their |errors| / initial envelope. Empty without the displacements of all masses.
  Curve history, error_history;
};

/// What `clackers check` found.
struct CheckRecord {
  static constexpr auto schema = "clackers/check/1";
  Provenance provenance;
  CaseSummary problem;
  Curve response;  ///< exact displacements, one row a mass [m]
  std::optional<Claim> expect;
  std::optional<double> tolerance;  ///< of u_error
  std::vector<CheckedFile> files;   ///< coarsest step first
  assess::Assessment assessment;    ///< of several files; of one, what a single level tells
  Verdict verdict = Verdict::not_claimed;
  std::string sentence;  ///< why this verdict
  std::string reason;    ///< code, empty when the verdict needs none
  std::string next;      ///< the command to type next
};

}  // namespace clackers::study
