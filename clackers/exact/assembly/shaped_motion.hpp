#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clackers/exact/assembly/flight_shape.hpp"
#include "clackers/exact/assembly/shaped_parameters.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/numerics/exp2.hpp"

namespace clackers::exact {

/// One contact of an impact instant.
struct ContactImpulse {
  int contact = 0;       ///< row of ImpactProblem::contacts
  double impulse = 0.0;  ///< for E = 1 before the impact [N s]
};

/// What happens at every impact instant.
struct ImpactPattern {
  /// The contacts that close at the first, second, ... instant, over and over; all lists of one
  /// length, each in ascending order.
  std::vector<std::vector<ContactImpulse>> contacts;
  double energy = 0.0;  ///< of the structure at an impact, for E = 1 [J]
};

/// A motion of any number of masses that is one flight, repeated: every T all relative velocities of
/// the contacts that close are multiplied by -eta, and the flight that follows is the last one times
/// eta e^(-sigma T). docs/manual/explanation/derivations/assemblies.md.
///
/// Contacts that close together are impacts of their own, with equal times, in ascending order of
/// contacts; each has the state and energy of the structure before and after all of them.
class ShapedMotion : public model::Motion {
 public:
  /// Throws InputError (out-of-range) for more than 2^62 impacts.
  ShapedMotion(const ShapedParameters& parameters, FlightConstants constants,
               std::unique_ptr<const FlightShape> shape, ImpactPattern pattern,
               std::string_view who);

  int dof() const override { return static_cast<int>(shape_->dof()); }
  double end() const override { return c_.end; }
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;
  /// The largest value over a flight, times E at t; 0 at rest.
  model::Kinematics envelope(double t) const override;
  /// The envelope at t = 0: it never grows.
  model::Kinematics peak() const override { return envelope(0.0); }
  /// E times FlightShape::error(); three units of 2^-53 of the envelope for phase, E and the rounding
  /// of the envelope itself; and, where E is subnormal, some spacings of such numbers.
  model::Kinematics error_bound(double t) const override;
  long long impact_count(double t) const override;
  model::MotionImpact impact(long long index) const override;

  const ShapedParameters& parameters() const { return parameters_; }
  const FlightConstants& flight() const { return c_; }
  const ImpactPattern& pattern() const { return pattern_; }

 private:
  struct Instant {
    Phase phase;
    numerics::Scaled decay;  // E = eta^k exp(-sigma t)
  };
  Instant instant(const Phase& phase, const numerics::DoubleDouble& halvings) const;
  Instant instant_at(double t, model::Side side) const;
  static void put(const Instant& now, std::size_t lane, FlightBlock& block);
  model::Kinematics state(const Instant& now) const;
  long long contacts_at_once() const {
    return static_cast<long long>(pattern_.contacts.front().size());
  }

  ShapedParameters parameters_;
  FlightConstants c_;
  std::unique_ptr<const FlightShape> shape_;
  ImpactPattern pattern_;
};

}  // namespace clackers::exact
