#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "clackers/assess/errors/score.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::assess {

/// A true impact and the report that is its match.
struct ImpactPair {
  long long reference = 0;  ///< index of the true impact, 1 for the first
  std::size_t report = 0;   ///< zero-based number of the call of ImpactMatcher::take
};

/// Matches the impacts that a run reports, as they come, with those of the true motion.
///
/// - A report less than two steps after the one before it belongs to the same collision: a method
///   that fires in adjacent steps has found one impact, timed at its first report. A chain of such
///   reports is one collision, too.
/// - A collision belongs to the nearest true impact if their times differ by at most a quarter of
///   the time to that impact's nearer true neighbour (a quarter of the run if it has none). Of
///   several collisions around one true impact the nearest is its match, the others are extra.
/// - A report while the true motion rests in contact (after an impact without restitution) that is
///   no match is neither found nor extra: a contact that lasts is no collision, and a method may
///   close it again and again.
/// - A true impact in the last two steps may come too late to be seen: it is expected only if
///   found. So is the last one before a run that starts late.
class ImpactMatcher {
 public:
  /// `step` [s] of the run and its first time `start` [s]. The motion must outlive the matcher.
  ImpactMatcher(const model::Motion& reference, double step, double start = 0.0);

  /// Makes pairs() possible, at the price of memory that grows with the matches. Before any report.
  void keep_pairs() { keeps_pairs_ = true; }

  /// Takes a report at time t [s]; reports come in order of time. `resting`: the true motion rests
  /// in this contact at that time.
  void take(double t, bool resting = false);
  /// The matching of a run that ended at time `end` [s]. `rounding` is the rounding error of a
  /// displacement relative to its envelope; the matcher turns it into one of time.
  ImpactScore score(double end, double rounding) const;
  /// The matches of a run that ended at `end` [s], in order of time; empty without keep_pairs().
  std::vector<ImpactPair> pairs(double end) const;

 private:
  struct Target {
    long long index = 0;
    double t = 0.0, reach = 0.0;  ///< true instant; how far from it a match may be
  };
  struct Report {
    double t = 0.0;
    std::size_t number = 0;
  };
  Target target(long long index) const;
  void settle();
  void move_on();
  ImpactMatcher ended(double end) const;

  const model::Motion& reference_;
  double step_, start_;
  long long known_;                ///< number of true impacts
  Target now_;                     ///< the earliest true impact that may still find a match
  bool more_;                      ///< now_ is meaningful
  std::optional<Report> nearest_;  ///< the best collision for now_ so far
  std::optional<double> last_report_;
  std::size_t reports_ = 0;  ///< taken so far
  bool keeps_pairs_ = false;
  std::vector<ImpactPair> pairs_;
  ImpactScore sum_;  ///< of all true impacts before now_
};

}  // namespace clackers::assess
