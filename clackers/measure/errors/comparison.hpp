#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/measure/errors/score.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::measure {

class Meter;

/// An impact of the history and the true one it belongs to.
struct MatchedImpact {
  std::size_t found = 0;  ///< index into Comparison::impacts()
  model::MotionImpact reference;
};

/// Where the impacts of a comparison come from.
enum class ImpactSource { reported, found_in_history };

/// What is known of a run beside its history: for the metrics that give a cause of its error.
struct RunFacts {
  /// Growth of a disturbance per impact and unit of detuning; 0 where none grows or the case is no
  /// pair. The constant "detuning_rate" of the case.
  double detuning_rate = 0.0;
  std::shared_ptr<const model::Motion> penalized{};  ///< exact, with the run's contact spring
  double contact_time = 0.0;  ///< of a compliant contact [s], as an ErrorSink has it
  std::string no_penalized = "No contact spring of the run is known.";  ///< why it is not known
};

/// A stored history and the reference at its times: what several metrics need, computed once.
/// History, motion and problem must outlive it. Not for several threads at once.
class Comparison {
 public:
  /// Throws InputError unless the history has the problem's number of masses, at least two times,
  /// finite numbers, times that do not descend and lie within [0, reference.end()] (or beyond it by
  /// a rounding), and at most two rows a time. `history.v` may be empty: velocities are not known.
  Comparison(const model::Trajectory& history, const model::Motion& reference,
             const model::ImpactProblem<>& problem, RunFacts facts = {});

  /// The history; where its rows lack the limits of jumps that it reports whole, with these rows
  /// (see with_jump_limits()).
  const model::Trajectory& history() const { return widened_ ? *widened_ : given_; }
  const model::Motion& reference() const { return reference_; }
  const model::ImpactProblem<>& problem() const { return problem_; }
  const RunFacts& facts() const { return facts_; }
  std::size_t dof() const { return static_cast<std::size_t>(given_.dof); }
  std::size_t rows() const { return history().t.size(); }
  bool has_velocities() const { return !given_.v.empty(); }
  /// Why what needs velocities is not measured without them.
  static constexpr const char* no_velocities = "The history has no velocities.";
  bool has_accelerations() const { return !given_.a.empty(); }
  /// Median of the given history's differences between times, without zeros [s].
  double step() const { return step_; }
  /// The time T that distances in time are divided by [s]: between the first two instants of true
  /// impacts, or the whole motion where it has fewer.
  double impact_period() const;
  /// The result of make(*this), computed at the first call and kept: what several metrics share.
  template <class Result>
  const Result& shared(Result (*make)(const Comparison&)) const {
    auto& kept = shared_[reinterpret_cast<void (*)()>(make)];
    if (!kept) kept = std::make_shared<const Result>(make(*this));
    return *static_cast<const Result*>(kept.get());
  }
  /// Why a history is too sparse to be compared flight by flight: far fewer rows than true impacts
  /// in its time, each of which needs several rows. A sentence, or empty.
  std::string objection_to_sparse_rows() const;
  /// The given rows and the impacts that they report with both velocities, taken as a run delivers
  /// them. Two rows of one time are the limits of a jump, at the ends of the history a state as well.
  const Meter& meter() const;
  /// The score that a run with these states and impacts has. `step` [s] is the level's.
  RunScore score(double step) const;
  /// First row of two with one time: the left limit of a jump.
  bool is_left_limit(std::size_t row) const {
    return row + 1 < rows() && history().t[row + 1] == history().t[row];
  }
  /// Second row of two with one time: the right limit of a jump.
  bool is_right_limit(std::size_t row) const {
    return row > 0 && history().t[row - 1] == history().t[row];
  }

  /// True states at the times of history(), row-major (time, mass). Of two rows with one time the
  /// first is the left limit, the second the right one; elsewhere the flight that truly holds, and
  /// the right limit at the double nearest to an impact.
  std::span<const double> reference_u() const { return reference_u_; }
  std::span<const double> reference_v() const { return reference_v_; }
  /// Empty unless the history has accelerations.
  std::span<const double> reference_a() const { return reference_a_; }
  /// What relative errors are divided by, one a mass: the peak() of the reference.
  std::span<const double> u_envelope() const { return u_envelope_; }
  std::span<const double> v_envelope() const { return v_envelope_; }
  std::span<const double> a_envelope() const { return a_envelope_; }

  /// The history's impacts in order of time: those it reports, or else those found in it.
  /// Reports of adjacent steps are one impact with the time and the limits before of the first,
  /// the limits after of the last and the sum of impulses. What is not known of one stands as an
  /// empty vector, and NaN for the impulse.
  const std::vector<model::Impact>& impacts() const { return impacts_; }
  /// When each of them was over [s]: the last report, the end of a compliant contact.
  std::span<const double> impact_ends() const { return impact_ends_; }
  ImpactSource impact_source() const { return source_; }
  /// Pairs in order of time; the rule is ImpactMatcher's.
  const std::vector<MatchedImpact>& matches() const { return matches_; }
  /// Numbers of matched, missed and extra impacts, as ImpactMatcher counts.
  const ImpactScore& impact_score() const { return score_; }
  /// True impacts that the history should have: up to its last time.
  long long expected() const { return score_.expected; }

 private:
  static Meter fill_meter(const Comparison& comparison);
  void sample_reference();
  void collect_impacts();
  double last_seen_impact() const;
  void match_impacts(double step);

  const model::Trajectory& given_;
  std::optional<model::Trajectory> widened_;
  const model::Motion& reference_;
  const model::ImpactProblem<>& problem_;
  RunFacts facts_;
  double step_ = 0.0;
  mutable double impact_period_ = 0.0;  ///< 0 until asked for
  std::vector<double> reference_u_, reference_v_, reference_a_, u_envelope_, v_envelope_,
      a_envelope_;
  std::vector<model::Impact> reports_;  ///< in order of time
  std::vector<model::Impact> impacts_;
  std::vector<double> impact_ends_;
  ImpactSource source_ = ImpactSource::reported;
  std::vector<MatchedImpact> matches_;
  ImpactScore score_;
  mutable std::map<void (*)(), std::shared_ptr<const void>> shared_;
};

/// Throws InputError unless the history can be compared with the reference: both and the problem
/// have the same number of masses, all lists have the size that its times ask for (velocities may
/// be missing, accelerations too), there are at least two different times, numbers are finite,
/// times do not descend and lie within [0, reference.end()], and at most two rows share a time. A
/// time may pass the end by the rounding of a product and a sum, 4 units of 2^-52 of it.
void require_comparable(const model::Trajectory& history, const model::Motion& reference,
                        const model::ImpactProblem<>& problem);

/// The largest time that passes for the end of the motion [s].
double latest_time(const model::Motion& reference);

}  // namespace clackers::measure
