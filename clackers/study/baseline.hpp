#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clackers/study/verify.hpp"

namespace clackers::study {

/// A value then and now.
template <class T>
struct Change {
  T before{}, now{};
};

/// What was found of a method and what it claims.
struct Standing {
  bool refused = false, complete = true;
  Verdict verdict = Verdict::undecided;
  Behaviour behaviour = Behaviour::undecided;
  std::string reason;  ///< code of the behaviour or of the refusal
  Claim claim;
  friend bool operator==(const Standing&, const Standing&);
};

/// Two numbers of runs with the same step.
template <class T>
struct ChangeAtStep {
  double step = 0.0;  ///< [s]
  T before{}, now{};
};

/// Collisions that a run did not find, and those that it found too much.
struct Collisions {
  long long expected = 0, missed = 0, extra = 0;
};

/// What became of one method. Everything that stayed is empty.
struct MethodChange {
  enum class Presence { both, added, gone };
  std::string name;
  Presence presence = Presence::both;
  std::optional<Change<Standing>> standing;
  /// Order and spread of the displacement error, where the change is larger than both spreads
  /// together and at least `visible_order`.
  std::optional<Change<assess::LadderFit>> order;
  /// Displacement error of the finest step that both finished, where the change is larger than
  /// `visible_error` of the larger and than both rounding floors together.
  std::optional<ChangeAtStep<double>> error;
  /// Of the finest step at which missed or extra collisions differ.
  std::optional<ChangeAtStep<Collisions>> collisions;
  /// Of the finest step at which one run reached its end and the other did not; true: it did.
  std::optional<ChangeAtStep<bool>> finished;
  /// Force evaluations of the finest step that both finished, where they differ by more than
  /// `visible_work` of the larger.
  std::optional<ChangeAtStep<long long>> work;

  bool any() const;
};

/// The order is shown with two decimals.
inline constexpr double visible_order = 0.01;
/// A change of less than one in the third digit is not told: on another machine or with another
/// compiler an error may differ in its last digits, and people read two of them.
inline constexpr double visible_error = 0.01, visible_work = 0.01;

/// What changed between two studies of the same case and ladder.
struct BaselineComparison {
  Provenance before;         ///< of the older study
  bool interrupted = false;  ///< the older study was
  /// A row for each method of the new study in its order, then those that are gone.
  std::vector<MethodChange> methods;

  bool any() const;  ///< something changed
};

/// Throws InputError, with the settings to repeat it, where the baseline is of another case, other
/// parameters or another ladder of steps than what is asked for; and what plan_of throws.
void require_same_study(const VerifyRequest& request, const Record& baseline);

/// Compares method by method, by name. Throws as require_same_study.
BaselineComparison compare(const Record& now, const Record& baseline);

}  // namespace clackers::study
