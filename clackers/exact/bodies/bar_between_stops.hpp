#pragma once

#include <string_view>

#include "clackers/exact/bodies/bar_contact.hpp"

namespace clackers::exact {

/// A bar without weight that flies to and fro between two rigid stops.
struct BarBetweenStopsParameters {
  Bar bar;         ///< its v0 has no meaning
  double V = 1.0;  ///< speed towards the left stop at t = 0 [m/s]
  double d = 0.0;  ///< gap there at t = 0 [m]
  double D = 0.0;  ///< both gaps together, D >= d [m]
  double end = 0.0;
};

/// At either stop a wave of the stress -rho c V runs through the bar and back, 2 L/c long, which leaves undeformed with
/// the opposite velocity; so the motion has the period 2 D/V + 4 L/c. Barre de Saint-Venant (1867);
/// docs/manual/explanation/derivations/bars.md.
class BarBetweenStops final : public BarMotion {
 public:
  explicit BarBetweenStops(const BarBetweenStopsParameters& parameters);

  double end() const override { return p_.end; }
  std::vector<double> lengths() const override { return {p_.bar.L}; }
  /// The left end is the contact end.
  Point at(std::size_t bar, double x, double t, model::Side side) const override;
  /// Of the stop that is touched, and of both.
  Bounded force(double t, model::Side side) const override;
  Bounded impulse(double t, model::Side side) const override;
  Energy energy(double t) const override;

  const BarContact::Wave& wave() const { return wave_; }
  /// When the first contact begins and ends [s].
  Bounded begins() const { return start_; }
  Bounded ends() const { return start_ + contact_; }
  Bounded period() const { return Bounded(2.0) * half_; }

 private:
  Changes changes() const override { return {{begins(), ends()}, half_}; }
  // Since a stop was touched, and how many contacts there had been before; the first is at the left one.
  struct Phase {
    Bounded s;
    double before = 0.0;
  };
  Phase phase(double t) const;
  // Whether s has passed a front at `t`; within their errors as `side` says.
  static bool is_after(const Bounded& s, const Bounded& front, double t, model::Side side);

  BarBetweenStopsParameters p_;
  BarContact::Wave wave_;
  Bounded start_, contact_, half_;  // how long a contact and half a period last
};

}  // namespace clackers::exact
