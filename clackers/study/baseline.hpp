#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::study {

struct VerifyRequest;
struct CheckRequest;

/// A value then and now.
template <class T>
struct Change {
  T before{}, now{};
};

/// What was found of a subject and what it claims.
struct Finding {
  bool refused = false, complete = true;
  Verdict verdict = Verdict::undecided;
  Behaviour behaviour = Behaviour::undecided;
  std::string reason;  ///< code of the behaviour or of the refusal
  Claim claim;
  friend bool operator==(const Finding&, const Finding&) = default;
};

/// Two numbers of runs with the same step.
template <class T>
struct ChangeAtStep {
  double step = 0.0;  ///< [s]
  T before{}, now{};
};

/// ImpactCounts that a run did not find, and those that it found too much.
struct ImpactCounts {
  long long expected = 0, missed = 0, extra = 0;
};

/// What changed of one subject of one case. Everything that stayed is empty.
struct SubjectChange {
  enum class Presence { both, added, gone };
  std::string case_name, name;
  Presence presence = Presence::both;
  std::optional<Change<Finding>> finding;
  /// Order and spread of the displacement error, where the change is larger than both spreads
  /// together and at least `visible_order`.
  std::optional<Change<judge::LadderFit>> order;
  /// Displacement error of the finest step that both finished, where the change is larger than
  /// `visible_error` of the larger and than both rounding floors together.
  std::optional<ChangeAtStep<double>> error;
  /// Of the finest step at which missed or extra impacts differ.
  std::optional<ChangeAtStep<ImpactCounts>> impacts;
  /// Of the finest step at which one run reached its end and the other did not; true: it did.
  std::optional<ChangeAtStep<bool>> finished;
  /// Force evaluations of the finest step that both finished, where they differ by more than
  /// `visible_work` of the larger.
  std::optional<ChangeAtStep<long long>> work;

  bool any() const;
};

/// The order is shown with two decimals.
inline constexpr double visible_order = 0.01;
/// Smaller relative changes are left out: on another machine or with another compiler an error may
/// differ in its last digits, and people read two of them.
inline constexpr double visible_error = 0.01, visible_work = 0.01;

/// What changed between two records.
struct BaselineComparison {
  record::Provenance before;  ///< of the older record
  bool interrupted = false;   ///< the older record was
  /// A row for each subject of the new record in its order, case by case, then those that are gone.
  std::vector<SubjectChange> subjects;

  bool any() const;  ///< something changed
};

/// Throws InputError (other-study), with the settings to repeat it, where the baseline cannot be
/// compared with what is asked for: a record of the other command, no case in common, or a common
/// case with other parameters or other steps; and what verify and check throw before any work.
void require_same_study(const VerifyRequest& request, const record::Record& baseline);
void require_same_study(const CheckRequest& request, const record::Record& baseline);

/// Compares subject by subject, by the names of case and subject. Throws as require_same_study.
BaselineComparison compare(const record::Record& now, const record::Record& before);

}  // namespace clackers::study
