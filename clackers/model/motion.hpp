#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>
#include <vector>

namespace clackers::model {

/// Which of two flights is meant where they meet.
enum class Side { left, right };

/// Displacement [m], velocity [m/s] and acceleration [m/s^2] of every mass at one time. Also used
/// for bounds and envelopes of them.
struct Kinematics {
  Eigen::VectorXd u, v, a;
};

/// Where `Motion::sample` writes: row-major (time, mass), each of size times x dof. `a` may be
/// empty when accelerations are not wanted.
struct SampleBuffers {
  std::span<double> u, v, a;
};

/// Throws InputError (wrong-size), `who` first, unless the buffers hold u and v, and a or nothing, of
/// as many masses at as many times.
void require_buffers(std::string_view who, const SampleBuffers& out, std::size_t times,
                     std::size_t masses);
/// Throws InputError (time-outside), `who` first, unless 0 <= t <= end [s].
void require_inside(std::string_view who, double t, double end);
/// Throws InputError (beyond-last-impact), `who` first, unless 1 <= index <= count, those up to end [s].
void require_impact(std::string_view who, long long index, long long count, double end);

/// The interval [lo, hi] in seconds that certainly holds the true instant.
struct TimeEnclosure {
  double lo = 0.0, hi = 0.0;
};

/// One impact of a motion.
struct MotionImpact {
  long long index = 0;                             ///< 1 for the first
  double t = 0.0;                                  ///< the double nearest to the true instant [s]
  TimeEnclosure when;                              ///< hi - lo is the whole uncertainty
  int contact = 0;                                 ///< row of ImpactProblem::contacts
  Kinematics before;                               ///< left limits
  Kinematics after;                                ///< right limits
  double impulse = 0.0;                            ///< along the contact's direction [N s]
  double energy_before = 0.0, energy_after = 0.0;  ///< kinetic and elastic, of everything [J]
};

/// A contact that stays closed for a while and carries a force.
struct ClosedContact {
  int contact = 0;                 ///< row of ImpactProblem::contacts
  double from = 0.0, until = 0.0;  ///< [s]; until the end of the motion where it does not open
  TimeEnclosure begins;            ///< certainly hold the true instants
  bool opens = false;
  /// Infinitely many impacts precede it. Those after `resolved` [s] are not given one by one, but
  /// allowed for in the error bound.
  bool accumulates = false;
  double resolved = 0.0;
};

/// A reference solution: the motion itself, with a bound on its error.
/// It may have 3e8 impacts, so they are asked for one by one.
class Motion {
 public:
  virtual ~Motion() = default;

  virtual int dof() const = 0;
  /// The instant up to which the motion is known [s].
  virtual double end() const = 0;

  /// The states at `times` (any order, each within [0, end()]). Where a time is the double nearest
  /// to an impact, `side` says which of the two flights is evaluated there; everywhere else the
  /// flight that truly holds. Throws InputError outside.
  virtual void sample(std::span<const double> times, Side side, SampleBuffers out) const = 0;
  /// One state; the same rules.
  Kinematics at(double t, Side side) const {
    const auto n = dof();
    Kinematics now{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    const auto size = static_cast<std::size_t>(n);
    sample({&t, 1}, side, {{now.u.data(), size}, {now.v.data(), size}, {now.a.data(), size}});
    return now;
  }

  /// The amplitude that each component has around t.
  virtual Kinematics envelope(double t) const = 0;
  /// The largest envelope of each component over the run, what errors are divided by: positive for
  /// a mass that starts at rest, too. Taken at 1024 equal parts of [0, end()]; a solution that has
  /// it in closed form overrides.
  virtual Kinematics peak() const;
  /// Bound on |computed - true| of each component at t. Each solution says how it is derived.
  virtual Kinematics error_bound(double t) const = 0;

  /// Number of impacts in [0, t].
  virtual long long impact_count(double t) const = 0;
  /// Impact `index` = 1, 2, ... Throws InputError beyond impact_count(end()).
  virtual MotionImpact impact(long long index) const = 0;

  /// The contacts that stay closed, ascending by `from`. Impacts that accumulate before are not
  /// among those counted.
  virtual std::vector<ClosedContact> closed_contacts() const { return {}; }
  /// The force of each contact and then of each row of friction at t [N], along its direction; empty where
  /// no contact stays closed and nothing rubs.
  virtual Eigen::VectorXd contact_forces(double t, Side) const {
    require_inside("contact forces", t, end());
    return {};
  }
};

}  // namespace clackers::model
