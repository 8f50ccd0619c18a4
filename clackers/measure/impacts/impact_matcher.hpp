#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "clackers/measure/errors/score.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::measure {

/// A true impact and the report that is its match.
struct ImpactPair {
  long long reference = 0;  ///< index of the true impact, 1 for the first
  std::size_t report = 0;   ///< zero-based number of the call of ImpactMatcher::take
};

/// Reports of one contact less than this many steps apart are one impact: a little less than
/// two, so that reports two whole steps apart stay two.
inline constexpr double one_impact = 2.0 - 1e-6;

/// Whether the reference rests in contact number `contact` just after time t [s]: its gap and the
/// rate of it are zero, as after an impact without restitution. A time outside the motion stands
/// for the nearer end. Throws InputError unless `contact` is an index into `contacts`.
bool rests_in_contact(const model::Motion& reference, const std::vector<model::Contact<>>& contacts,
                      int contact, double t);

/// Matches the impacts that a run reports, as they come, with those of the reference, contact by
/// contact.
///
/// - A report less than two steps after the one before it belongs to the same impact: a method
///   that applies impacts in adjacent steps has found one impact, timed at its first report. A
///   chain of such reports is one impact, too.
/// - A reported impact belongs to the nearest true one if their times differ by at most a quarter of
///   the time to that impact's nearer true neighbour (a quarter of the run if it has none). Of
///   several impacts around one true impact the nearest is its match, the others are extra.
/// - A report while the reference rests in contact (after an impact without restitution) that is
///   no match is neither found nor extra: a lasting contact is no impact, and a method may
///   close it again and again. Nor is one around a closing without an impact or around an opening, as
///   far off as a match may be.
/// - A true impact in the last two steps may come too late to be seen: it is expected only if
///   found. So is the last one before a run that starts late.
/// - Where impacts accumulate to a contact that stays closed, the last one expected for certain is
///   that with a flight of `apart` steps after it, followed by one of `delays` steps for each impact
///   so far; half a contact of a compliant law counts as a step. From the middle of the flight after
///   it on, impacts are expected only if found, and no report is extra until the contact opens. So it is
///   from an impact on that is found with an error of half of what the next one, of a shorter flight,
///   may have: a method of first order is later each time.
class ImpactMatcher {
 public:
  /// `step` [s] of the run, its first time `start` [s], the number of the problem's contacts, and how
  /// long a contact lasts [s], 0 for impacts at an instant. The motion must outlive the matcher.
  ImpactMatcher(const model::Motion& reference, double step, double start = 0.0, int contacts = 1,
                double contact_time = 0.0);

  /// From a time on [s] impacts are expected only if found, and no report is extra. Before any report.
  void expect_until(double t) { expected_until_ = t; }
  /// Makes pairs() possible, at the price of memory that grows with the matches. Before any report.
  void keep_pairs() { keeps_pairs_ = true; }

  /// Takes a report at time t [s]; reports of one contact come in order of time. `resting`: the
  /// reference rests in this contact at that time.
  void take(double t, bool resting = false, int contact = 0);
  /// The matching of a run that ended at time `end` [s]. `rounding` is the rounding error of a
  /// displacement relative to its envelope; the matcher turns it into one of time, no less than
  /// the uncertainty of the true instants.
  ImpactScore score(double end, double rounding) const;
  /// The matches of a run that ended at `end` [s], in order of time; empty without keep_pairs().
  std::vector<ImpactPair> pairs(double end) const;

 private:
  struct Target {
    long long index = 0;
    double t = 0.0, reach = 0.0;  ///< true instant; how far from it a match may be
    double uncertainty = 0.0;     ///< of the true instant
  };
  struct Report {
    double t = 0.0;
    std::size_t number = 0;
  };
  /// The impacts of one contact.
  struct Track {
    std::optional<Target> target;   ///< the earliest true impact that may still find a match
    std::optional<Report> nearest;  ///< the best impact for it so far
    std::optional<double> last_report;
  };
  std::optional<model::MotionImpact> impact_of(int contact, long long from, int direction) const;
  std::optional<Target> target(int contact, long long from) const;
  /// Where impacts of a contact follow each other too fast for the steps.
  struct Accumulation {
    int contact = 0;
    double from = 0.0, until = 0.0;  ///< [s]
  };
  // Steps between impacts that a run resolves. A method whose impact takes two steps is late by as
  // much an impact; one that takes it at the end of a step leaves the penetration of that step with eta
  // of the speed, 1/eta of a step early or late. The flight after the next is eta times the next one.
  static constexpr double apart = 32.0, delays = 12.0;
  // A lasting contact, with the times around it in which a method may close it without an impact.
  struct Lasting {
    int contact = 0;
    double from = 0.0, until = 0.0;  ///< [s]
  };
  void allow_around(const model::ClosedContact& closed);
  bool accumulates(int contact, double t) const;
  bool lasts(int contact, double t) const;
  void settle(int contact, const Track& track);
  void advance(int contact, double t);
  ImpactMatcher ended(double end) const;

  const model::Motion& reference_;
  double step_, start_;
  long long known_;  ///< number of true impacts
  std::vector<Track> tracks_;
  std::vector<Accumulation> accumulations_;
  std::vector<Lasting> lasting_;
  std::size_t reports_ = 0;  ///< taken so far
  double expected_until_ = std::numeric_limits<double>::infinity();
  bool keeps_pairs_ = false;
  std::vector<ImpactPair> pairs_;
  ImpactScore sum_;  ///< of all true impacts before the targets
};

}  // namespace clackers::measure
