#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/files/note.hpp"
#include "clackers/base/judgement.hpp"
#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/limit.hpp"
#include "clackers/judge/convergence/assessment.hpp"
#include "clackers/judge/convergence/step_ladder.hpp"
#include "clackers/measure/errors/score.hpp"
#include "clackers/record/profile.hpp"
#include "clackers/record/schematic.hpp"
#include "clackers/record/self_result.hpp"

namespace clackers::judge {
/// "", "behaviour", "lower-order", "higher-order", "floor-reason", "evidence".
std::string_view to_string(Mismatch mismatch);
}  // namespace clackers::judge

// The one record of every study: verify and check fill it, for one case or for several; every
// output format, --report and --baseline reads it.
namespace clackers::record {

/// A metric of one history.
struct MetricResult {
  std::string name, unit;
  double value = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> masses;  ///< mass by mass, empty for a metric of the whole structure
  std::string reason;          ///< why it was not measured
  /// false: it need not tend to zero for a history that converges, since its velocities jump.
  bool across_jumps = true;
};

/// What was run, where and by what: enough to run it again.
struct Provenance {
  std::string command;                             ///< as typed
  std::string version;                             ///< of clackers
  std::string compiler, machine, processor, date;  ///< date in UTC, ISO 8601
};

/// A curve for a figure.
struct Curve {
  std::vector<double> t;               ///< [s]
  std::vector<std::vector<double>> y;  ///< one row a mass
};

/// The problem of a case and its reference solution.
struct CaseSummary {
  std::string name, summary, equations;
  std::vector<Quantity> parameters, constants;
  double end = 0.0;                  ///< [s]
  double fast_period = 0.0;          ///< shortest damped period of the free masses [s]
  std::vector<double> impact_times;  ///< at most the first 1000 [s]
  std::vector<int> impact_contacts;  ///< the contact of each, from 0
  Schematic drawing;
  long long impact_count = 0;
  Curve
      contact_forces{};  ///< of those that stay closed [N], one row a contact; empty where none does
};

using judge::RefinementPlan;

/// Why refinement beyond the plan ended.
enum class RefinementEnd {
  decided,
  budget,
  rounding_floor,
  too_many_steps,
  run_failed,
  interrupted
};
/// "decided", "budget", "rounding-floor", "too-many-steps", "run-failed", "interrupted"
std::string_view to_string(RefinementEnd end);

/// What was run of a subject beyond the plan of its case, because the plan left it undecided.
struct Refinement {
  int finer_levels = 0, coarser_levels = 0;  ///< added at either end
  int samples_per_level = 0;                 ///< now
  RefinementEnd end = RefinementEnd::decided;
  double next_seconds = 0.0;  ///< expected time of what did not fit into the budget [s], else 0
};

enum class StepSource { data, name, option };          ///< where a history's step comes from
enum class ImpactSource { events, history, unknown };  ///< unknown: neither reported nor found

std::string_view to_string(StepSource source);    ///< "data", "name", "option"
std::string_view to_string(ImpactSource source);  ///< "events", "history", "unknown"

/// What a history file holds beside its errors.
struct HistoryFile {
  std::string file;                ///< as given
  long long rows = 0;              ///< assessed
  long long rows_beyond = 0;       ///< after the end of the case, left out
  double first = 0.0, last = 0.0;  ///< times of the first and the last row assessed [s]
  double spacing = 0.0;            ///< median time between rows [s]
  StepSource step_source = StepSource::data;
  std::vector<PrintedColumn> columns;
  double printed_floor = 0.0;  ///< part of u_error that printing alone may make
  std::string printed_by;      ///< the column that makes most of it, empty for none
  double unseen_bend = 0.0;    ///< departure of the fast mass from a line between rows / amplitude
  bool has_velocities = false;
  std::vector<bool> has_u;   ///< one entry a mass
  double start_error = 0.0;  ///< of the first row, relative to envelopes of u and v
  ImpactSource impact_source = ImpactSource::unknown;
  bool rows_resolve_impacts = true;  ///< false: rows too far apart to find impacts in them
  double contact_time = 0.0;         ///< median length of the contacts in it [s], 0 for instants
  std::vector<Note> notes;
  Curve history;  ///< displacements for a figure [m]; empty without those of all masses
};

/// One run against the reference solution: a run of a method, or a history somebody's program wrote.
struct Run {
  measure::RunScore score;            ///< NaN where a history lacks what an error needs
  std::optional<HistoryFile> file;    ///< of a history
  std::vector<MetricResult> metrics;  ///< empty where none were measured
  Curve error_history;    ///< |error in u| / envelope against time; empty where none was kept
  Curve motion{};         ///< displacements of the method's run that is shown [m]
  std::string printed{};  ///< last lines that a program printed whose run failed
};

/// Runs with steps around one nominal step.
struct Level {
  double step = 0.0;      ///< nominal h [s]
  std::vector<Run> runs;  ///< coarsest first
};

/// What is assessed: a method of the catalogue, a set of histories, or a solver that makes them: a
/// program, or a callable (of Python).
enum class SubjectKind { method, histories, program, callable };
std::string_view to_string(SubjectKind kind);  ///< "method", "histories", "program", ...
constexpr bool is_solver(SubjectKind kind) { return kind >= SubjectKind::program; }

/// What the levels of a subject refine: steps [s], or the tolerances of an adaptive solver, which
/// then stand in every `step`.
enum class RefinementParameter { step, tolerance };
std::string_view to_string(RefinementParameter parameter);  ///< "step", "tolerance"

/// What a user says of a subject beside its name: "precision" = "single".
using Labels = std::map<std::string, std::string>;
/// "precision=single, springs=force"; empty without any.
std::string labels_text(const Labels& labels);

struct Subject {
  SubjectKind kind = SubjectKind::method;
  /// The one name in every output. A method as one would type it, without "+event-driven", which is
  /// what a name without "+contact" means; "histories" for histories.
  std::string name;
  /// Of a method that joins them, with their parameters; empty for a scheme and for others.
  std::string integrator{}, treatment{};
  Labels labels{};
  Claim claim;                        ///< of the method, or what --expect says of the histories
  std::optional<double> tolerance;    ///< largest allowed u_error, where one was asked for
  double contact_time = 0.0;          ///< [s], 0 for rigid contact
  std::string refusal, refusal_code;  ///< why a method cannot take the case; empty when it can
  bool complete = true;               ///< false: interrupted before its last level
  RefinementParameter refined_by = RefinementParameter::step;
  std::vector<Level> levels;             ///< coarsest first
  std::optional<Refinement> refinement;  ///< nothing where the plan of the case was enough
  /// Behaviour, verdict, reason (a code) and numbers; `assessment.verdict` is the verdict.
  judge::Assessment assessment;
  /// Without the reference solution; nothing where no level was finished, or where no order is
  /// claimed that differences could be compared with.
  std::optional<SelfResult> self_convergence;
  /// Causes of what the runs show, strongest first; empty where nothing was found or looked for.
  std::vector<diagnose::Diagnosis> diagnoses;
  /// Where the finest history leaves the exact motion; nothing for one that is not of another motion.
  std::optional<diagnose::Departure> departure;
  /// The first impacts of the finest history, as its rows show them; empty where they do not.
  std::vector<diagnose::LocatedImpact> impacts;

  /// The run that error history and metrics of the subject are taken from: the finest one that has
  /// them; nullptr where none has.
  const Run* shown_run() const;
};

/// The verdicts of a case or of a record, counted.
struct Counts {
  int agrees = 0, disagrees = 0, not_claimed = 0, undecided = 0, refused = 0, interrupted = 0;
  int total() const { return agrees + disagrees + not_claimed + undecided + refused + interrupted; }
};

/// One case with everything that was assessed on it.
struct CaseRecord {
  CaseSummary problem;
  RefinementPlan plan;  ///< of methods on this case, before refinement; levels = 0 for histories
  Curve response;       ///< exact displacements, one row a mass [m]
  std::vector<Subject> subjects;
  std::vector<Profile> profiles;  ///< of this case alone
};

struct Record {
  static constexpr auto schema = "clackers/record/1";
  std::string command = "verify";  ///< "verify" or "check"
  Provenance provenance;
  std::vector<CaseRecord> cases;
  std::vector<Profile> profiles;  ///< over all cases; empty for one case
  bool interrupted = false;
};

/// The numbers of a level that tables show: of every number the worst over the runs that finished
/// (largest error, largest work and time, the impact score with most missed and extra). One rule
/// for failed runs: they count in `failed` and nowhere else; a level without a finished run has NaN
/// errors and no impacts.
struct LevelScore {
  double step = 0.0;  ///< nominal [s]
  measure::RunScore worst;
  int runs = 0, failed = 0;
};
LevelScore worst(const Level& level);
/// Of the finest level that has runs; NaN without one.
LevelScore worst_of_finest(const Subject& subject);
/// The scores alone, as assess reads them.
measure::Ladder ladder_of(const Subject& subject);

Counts counts(const CaseRecord& record);
Counts counts(const Record& record);
/// The verdict as text, or "refused" or "interrupted" where there is none.
std::string_view verdict_word(const Subject& subject);

/// A solver none of whose runs on a case finished.
struct FailedSolver {
  const CaseRecord* problem;
  const Subject* subject;
  const Run* first;  ///< its coarsest run
};
std::vector<FailedSolver> failed_solvers(const Record& record);

/// The word of a whole record, the first that holds of: interrupted, disagrees, undecided, agrees, not
/// claimed. A method that refused the case counts for nothing.
std::string_view verdict_word(const Record& record);
/// Of that word: interrupted 130, disagrees 1, undecided 3, else 0; 4 where every run of
/// a solver on a case failed.
int exit_code(const Record& record);

/// Who computes here and now: version, compiler, machine, processor, date. What the machine
/// does not provide stays "unknown".
Provenance provenance(std::string command);

/// The processor's name in the text of /proc/cpuinfo, or "unknown".
std::string processor_name(const std::string& cpuinfo);

}  // namespace clackers::record
