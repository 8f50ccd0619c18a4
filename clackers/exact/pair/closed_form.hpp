#pragma once

#include "clackers/exact/pair/flight_constants.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::exact {

/// A motion made of flights u_i = b_i E cos(p_i theta) between collisions at t_k = (k - 1/2) T, in
/// which all masses pass equilibrium together. The base of all motions of this module.
///
/// Evaluation: the phase Omega t / pi is formed with 159 bits and reduced exactly, sines, cosines
/// and powers carry 63 bits or more, and the result is rounded once at the end; mathematics.md,
/// section 8. Const, without allocation, safe to share between threads.
class ClosedForm : public model::Motion {
 public:
  int dof() const override { return static_cast<int>(c_.masses.size()); }
  double end() const override { return c_.end; }

  /// With the widest vectors of the processor (sampling.hpp); the same bits on every processor and
  /// however many times there are.
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;

  /// |b| E, |b| E omega and |b| E omega^2 of each mass, omega its undamped frequency. At the
  /// double nearest to a collision E is that of the flight before it, the larger one.
  model::Kinematics envelope(double t) const override;

  /// 0.51 units of 2^-52 of the envelope, and one subnormal spacing (5e-324). Of the first, 1/2 is
  /// the rounding of the result, which never exceeds the envelope; the cosine and sine add
  /// sqrt(2) 2^-63, the power 2^-66, the phase at most pi X 2^-100 < 2^-68, all double-double steps
  /// less than 2^-98 together: below 0.503. The rest covers the rounding of the envelope itself.
  model::Kinematics error_bound(double t) const override;

  /// The k with t_k <= t, decided for the true t_k. With eta = 0 the masses stay at rest after the
  /// first, which is then the only one.
  long long impact_count(double t) const override;

  /// `when` holds two neighbouring doubles (the true instant is transcendental and never a
  /// double). Both limits are those at the true instant: displacements exactly 0, each other value
  /// to 0.51 units of 2^-52 of itself.
  model::MotionImpact impact(long long index) const override;

  /// What a method is given: the system and its start, each number the nearest double.
  model::ImpactProblem<> problem() const { return problem_; }

  /// What evaluating it needs.
  const FlightConstants& flight() const { return c_; }

  /// Flight k, counted as a double to avoid conversions, and theta / pi in it.
  struct Phase {
    double flight = 0.0;
    numerics::DoubleDouble half_turns;
  };
  /// The flight that holds at t, or that `side` means where t is the double nearest to a collision.
  /// theta / pi lies in [-1/2, 1/2], without a stop in [-1, 1]. Throws InputError outside
  /// [0, end()].
  Phase phase(double t, model::Side side) const;

 protected:
  explicit ClosedForm(const WideMotion& motion);

 private:
  Phase phase_at(double t) const;
  Phase flight_at(double t, model::Side side) const;
  numerics::Neighbour instant(double k) const;
  void require_inside(double t) const;
  void sample_one(double t, model::Side side, double* u, double* v, double* a) const;

  FlightConstants c_;
  model::ImpactProblem<> problem_;
};

}  // namespace clackers::exact
