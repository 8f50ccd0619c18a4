#pragma once

#include <vector>

#include "clackers/exact/bodies/bar_motion.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// A string fixed at x = -L/2 and L/2, plucked in the middle and released at t = 0, above a point.
struct StringOverPointParameters {
  double L = 1.0;      ///< length of the whole string [m]
  double T = 1.0;      ///< tension [N]
  double rho = 1.0;    ///< mass per length [kg/m]
  double H = 1.0;      ///< displacement of the middle at t = 0 [m]
  double share = 0.0;  ///< height of the point over H, in [0, 1)
  double end = 0.0;    ///< [s]
};

/// rho u_tt = T u_xx with u(0, t) >= share H, which needs no law of impact. With c^2 = T/rho, tau = L/(2 c), and N(t) the
/// part of (0, t) that lies in the first (1 - share) tau of each (3 - share) tau, the period of the motion,
///
///     u = H (1 - 2 |x|/L) - (H/tau) [N(t - |x|/c) - N(t + |x|/c - 2 tau)]
///
/// H. Cabannes (1984) has the same motion as parabolas; docs/manual/explanation/derivations/strings.md.
class StringOverPoint final : public BarMotion {
 public:
  explicit StringOverPoint(const StringOverPointParameters& parameters);

  bool is_string() const override { return true; }
  double end() const override { return p_.end; }
  /// Of the right half, of which the left one is the mirror image.
  std::vector<double> lengths() const override { return {0.5 * p_.L}; }
  Point at(std::size_t bar, double x, double t, model::Side side) const override;
  /// Of the point on the whole string, and the energy of both halves.
  Bounded force(double t, model::Side side) const override;
  Bounded impulse(double t, model::Side side) const override;
  Energy energy(double t) const override;

  Bounded speed() const { return numerics::narrowed(speed_); }
  Bounded transit() const { return numerics::narrowed(tau_); }
  Bounded contact_force() const { return numerics::narrowed(force_); }
  /// When the first contact begins and ends [s], and the time after which the motion repeats itself.
  Bounded begins() const { return numerics::narrowed(falls_ * tau_); }
  Bounded ends() const { return Bounded(2.0) * transit(); }
  Bounded period() const { return numerics::narrowed(period_ * tau_); }

 private:
  Changes changes() const override { return {{begins(), ends()}, period()}; }
  using Wide = numerics::Wide;
  using WideReal = numerics::WideReal;
  // Since the last period began, and how many there had been before.
  struct Phase {
    Wide s;
    WideReal before = 0;
  };
  Phase phase(const Wide& s) const;
  // Of the wave that leaves the point, in H/tau: -1 for falls_ in each period, then 1.
  double wave(const Wide& s, model::Side side, const WideReal& slack) const;
  // How long it was -1 since 0.
  Wide fallen(const Wide& s) const;

  StringOverPointParameters p_;
  Wide speed_, tau_, force_;
  Wide falls_, period_;  // in tau, as all times of the private functions
};

}  // namespace clackers::exact
