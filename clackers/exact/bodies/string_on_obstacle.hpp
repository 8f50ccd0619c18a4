#pragma once

#include <vector>

#include "clackers/exact/bodies/bar_motion.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// A string fixed at x = 0 and L, plucked and released at t = 0, above a straight obstacle at its position of rest.
struct StringOnObstacleParameters {
  double L = 1.0;      ///< length [m]
  double T = 1.0;      ///< tension [N]
  double rho = 1.0;    ///< mass per length [kg/m]
  double H = 1.0;      ///< displacement at the pluck [m]
  double place = 0.5;  ///< of the pluck, x over L, in (0, 1)
  double end = 0.0;    ///< [s]
};

/// rho u_tt = T u_xx with u >= 0, whose points come back from the obstacle with the speed they had: u = |w| with the
/// free motion w, for a start that rises and then falls. With c^2 = T/rho, the odd and 2 L-periodic f that is the
/// start on (0, L), and a = place L,
///
///     u = |f(x + c t) + f(x - c t)|/2,    w < 0 between c t = a + (1 - 2 place) x and 2 L - a - (1 - 2 place) x
///
/// within each period 2 L/c. L. Amerio, G. Prouse (1975); A. Haraux, H. Cabannes (1983);
/// docs/manual/explanation/derivations/strings.md.
class StringOnObstacle final : public BarMotion {
 public:
  explicit StringOnObstacle(const StringOnObstacleParameters& parameters);

  bool is_string() const override { return true; }
  double end() const override { return p_.end; }
  std::vector<double> lengths() const override { return {p_.L}; }
  Point at(std::size_t, double x, double t, model::Side side) const override;
  /// Of the whole obstacle. A pluck in the middle has none, but an impulse at an instant.
  Bounded force(double t, model::Side side) const override;
  Bounded impulse(double t, model::Side side) const override;
  Energy energy(double t) const override;

  Bounded speed() const { return numerics::narrowed(speed_); }
  Bounded transit() const { return numerics::narrowed(tau_); }
  /// When the first touch begins, at the nearer end, and ends [s], and the impulse of each [N s].
  Bounded begins() const { return numerics::narrowed(near_ * tau_); }
  Bounded ends() const { return numerics::narrowed((Wide(1.0) - near_) * tau_); }
  Bounded impulse_of_touch() const { return numerics::narrowed(impulse_); }

 private:
  Changes changes() const override { return {{begins(), ends()}, transit()}; }
  using Wide = numerics::Wide;
  using WideReal = numerics::WideReal;
  // A time in tau, and what no one who asks in doubles can tell.
  struct Time {
    Wide s;
    model::Side side;
    WideReal slack;
    bool is_past(const Wide& now, const Wide& instant) const;
  };
  Time time(double t, model::Side side) const;
  Wide shape(const Wide& s) const;                      // f/H, lengths in L
  Wide slope(const Wide& s, const Time& limits) const;  // its slope in H/L

  StringOnObstacleParameters p_;
  Wide speed_, tau_, impulse_;
  Wide place_, rest_, near_;  // place, 1 - place and the smaller of them
};

}  // namespace clackers::exact
