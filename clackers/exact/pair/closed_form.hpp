#pragma once

#include <string_view>

#include "clackers/exact/pair/high_precision.hpp"
#include "clackers/exact/pair/sampling.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/numerics/exp2.hpp"

namespace clackers::exact {

/// Flight k, counted as a double to avoid conversions, and theta / pi in it.
struct Phase {
  double flight = 0.0;
  numerics::DoubleDouble theta_over_pi;
};

/// The flight that truly holds at t >= 0, whether anything collides or not; theta / pi lies in
/// [-1/2, 1/2], with an error below 2^-100.
Phase natural_phase(const FlightConstants& c, double t);

/// The same, but where t is the double nearest to an impact, the flight that `side` means. Without
/// impacts the flight is 0 and theta / pi lies in [-1, 1].
Phase phase_at(const FlightConstants& c, double t, model::Side side);

/// t_k [s] of impact k = 1, 2, ...
numerics::Neighbour impact_instant(const FlightConstants& c, double k);

/// 2^halvings; 0 below 2^-4000, where every product with a constant (all below 1e300) is nearer to
/// 0 than to the smallest subnormal.
numerics::Scaled power(const numerics::DoubleDouble& halvings);

/// A motion made of flights u_i = b_i E cos(p_i theta) between impacts at t_k = (k - 1/2) T, in
/// which all masses pass equilibrium together. The base of all motions of this module.
///
/// Evaluation: the phase Omega t / pi is formed with 159 bits and reduced exactly, sines, cosines
/// and powers carry 63 bits or more, and the result is rounded once at the end;
/// docs/manual/explanation/derivations/evaluation.md. Const, without allocation, safe to share between threads.
class ClosedForm : public model::Motion {
 public:
  int dof() const override { return static_cast<int>(c_.masses.size()); }
  double end() const override { return c_.end; }

  /// With the widest vectors of the processor; the same bits on every processor and however many
  /// times there are (sampling.hpp). But 320 times or more that begin equidistant, to rounding, are
  /// evaluated by steps where they stay so (step_sampling.cpp), in a quarter of the time: one value
  /// in ten thousand then has another last bit than that of the time by itself.
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;

  /// |b| E, |b| E omega and |b| E omega^2 of each mass, omega its undamped frequency. At the
  /// double nearest to an impact E is that of the flight before it, the larger one.
  model::Kinematics envelope(double t) const override;
  /// The envelope at t = 0: it never grows.
  model::Kinematics peak() const override { return envelope(0.0); }

  /// 0.51 units of 2^-52 of the envelope, and one subnormal spacing (5e-324). Of the first, 1/2 is
  /// the rounding of the result, which never exceeds the envelope; the cosine and sine add
  /// sqrt(2) 2^-63, the power 2^-66, the phase at most pi X 2^-100 < 2^-68, all double-double steps
  /// less than 2^-98 together: below 0.503, by steps as well. The rest covers the rounding of the envelope itself.
  model::Kinematics error_bound(double t) const override;

  /// The k with t_k <= t, decided for the true t_k. With eta = 0 the masses stay at rest after the
  /// first, which is then the only one.
  long long impact_count(double t) const override;

  /// `when` holds two neighbouring doubles (the true instant is transcendental and never a
  /// double). Both limits are those at the true instant: displacements exactly 0, each other value
  /// to 0.51 units of 2^-52 of itself.
  model::MotionImpact impact(long long index) const override;

  /// What a method is given: the system and its start, each number the nearest double.
  const model::ImpactProblem<>& problem() const { return problem_; }

  /// What evaluating it needs.
  const FlightConstants& flight() const { return c_; }

  /// The free parameters, and what follows from those of two masses.
  const Parameters& parameters() const { return parameters_; }
  const std::optional<PairConstants>& pair() const { return pair_; }

  /// The flight that holds at t, or that `side` means where t is the double nearest to an impact.
  /// theta / pi lies in [-1/2, 1/2], without a stop in [-1, 1]. Throws InputError outside
  /// [0, end()].
  Phase phase(double t, model::Side side) const;

 protected:
  /// Throws InputError as derive() does.
  ClosedForm(const Parameters& parameters, std::string_view who);

 private:
  ClosedForm(const Parameters& parameters, Derived derived);
  void sample_one(double t, model::Side side, double* u, double* v, double* a) const;

  Parameters parameters_;
  FlightConstants c_;
  model::ImpactProblem<> problem_;
  std::optional<PairConstants> pair_;
};

/// The motion as one in closed form, or null.
const ClosedForm* as_closed_form(const model::Motion& motion);

/// u'' + 2 xi1 u' + u = 0, u(0) = 1, u'(0) = -xi1 with no stop: Eq. (3), solved by Eq. (4).
class FreeMass : public ClosedForm {
 public:
  explicit FreeMass(const FreeMassParameters& parameters, std::string_view who = "sdof")
      : ClosedForm(parameters, who) {}
};

/// The same mass above a rigid stop at its equilibrium: Eq. (5), for any restitution.
class RigidStop : public ClosedForm {
 public:
  explicit RigidStop(const RigidStopParameters& parameters, std::string_view who = "stop")
      : ClosedForm(parameters, who) {}
};

/// The exact motion of two masses, each on its own spring and dashpot, that collide only at their
/// common equilibrium: Eq. (9), (12), (13), (15)-(17) with any mass ratio, restitution and odd X.
/// It is exact for the binary64 values of the parameters, and X = 1/odd stands for that fraction.
/// u1(0) = A and u2(0) = -s r A/X with s = (-1)^((odd-1)/2), except for X = 1/odd, where they are
/// s A and -r A/X: mass 2 is the slow one then and starts below.
class SynchronizedPair : public ClosedForm {
 public:
  explicit SynchronizedPair(const PairParameters& parameters,
                            std::string_view who = "synchronized-pair")
      : ClosedForm(parameters, who) {}
  const PairConstants& constants() const { return *pair(); }
};

/// A synchronized pair all of whose model inputs (masses, dampings, stiffnesses, initial state) are
/// exactly binary64 numbers, so that a method receives the true system: m1 = r m2, c_i = 2 m_i
/// sigma, k1 = m1 (Omega^2 + sigma^2), k2 = m2 (X^2 Omega^2 + sigma^2), u1(0) = X (A/X), u2(0) =
/// -s r (A/X), v_i(0) = -sigma u_i(0). Any rounding of k2 alone would move the phase by X Omega t
/// times 5e-17. Throws InputError (not-exact-data) for parameters with which some input is no binary64
/// number, naming the input.
class ExactDataPair : public ClosedForm {
 public:
  explicit ExactDataPair(const ExactDataParameters& parameters,
                         std::string_view who = "exact-data-pair")
      : ClosedForm(parameters, who) {}
  const PairConstants& constants() const { return *pair(); }
};

}  // namespace clackers::exact
