#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "clackers/exact/bodies/bar_motion.hpp"

namespace clackers::exact {

/// An elastic bar with a free far end, undeformed and of one velocity at t = 0.
struct Bar {
  double L = 1.0;    ///< length [m]
  double E = 1.0;    ///< Young's modulus [N/m^2]
  double rho = 1.0;  ///< density [kg/m^3]
  double A = 1.0;    ///< area [m^2]
  double v0 = 0.0;   ///< velocity at t = 0 along x [m/s]
};

/// Of a bar: L/c [s], its wave speed c [m/s] and its impedance A sqrt(E rho) [N s/m], in numbers of a kind.
template <class Number>
struct WaveOf {
  Number transit, speed, impedance;

  static WaveOf of(const Bar& bar) {
    const Number E(bar.E), rho(bar.rho);
    return {Number(bar.L) * sqrt(rho / E), sqrt(E / rho), Number(bar.A) * sqrt(E * rho)};
  }
};

/// A bar to the right of a rigid wall, or two bars, the left one first, whose ends are apart.
struct BarsParameters {
  std::vector<Bar> bars;
  double gap = 0.0;  ///< at t = 0 [m]
  double end = 0.0;  ///< [s]
  double g = 0.0;    ///< weight per mass, towards the wall [m/s^2]; 0 for two bars
  /// Where positive, instead of the gap: the bar falls for N L/c from rest, from the height
  /// g (N L/c)^2/2. A whole N makes the motion periodic, and known for any time.
  double N = 0.0;
};

/// rho A u_tt = E A u_xx - rho A g of each bar, with contact as a condition on gap and force alone:
/// it needs no coefficient of restitution. With v + c u_x and v - c u_x at the contact end as arriving and
/// outgoing waves a, o, z = A sqrt(E rho) and tau = L/c,
///
///     gap' = a2 - a1 + R (1/z1 + 1/z2),  o1 = a1 - 2R/z1,  o2 = a2 + 2R/z2,  0 <= R _|_ gap >= 0
///     a(t) = o(t - 2 tau) - 2 g tau
///
/// (wall: a1 = 0, 1/z1 = 0). The waves stay linear between events, which are followed one by one in
/// 256 bits with running error bounds; what events closer than their errors leave open is in the
/// bounds. Known: L. Amerio, G. Prouse (1975), M. Schatzman (1980), G. Lebeau, M. Schatzman (1984).
/// Derivation: docs/manual/explanation/derivations/bars.md. Const, safe to share between threads.
class BarContact final : public BarMotion {
 public:
  /// A change of the contact.
  struct Event {
    bool closes = false;
    Bounded t;
  };

  /// Throws InputError for more than 20,000 pieces, and where the contact is touched so softly that it
  /// is not certain whether it closes.
  explicit BarContact(const BarsParameters& parameters, std::string_view who);
  ~BarContact() override;

  const BarsParameters& parameters() const { return p_; }
  double end() const override { return p_.end; }
  std::vector<double> lengths() const override;
  using Wave = WaveOf<Bounded>;
  Wave wave(std::size_t bar) const;
  /// At t = 0, and the time after which the motion repeats itself; 0 where it does not.
  Bounded gap() const;
  Bounded period() const;

  Point at(std::size_t bar, double x, double t, model::Side side) const override;
  Bounded gap(double t) const;
  Bounded force(double t, model::Side side) const override;
  Bounded impulse(double t, model::Side side) const override;
  Energy energy(double t) const override;
  /// Up to the end, of periodic motions those of the first period.
  std::vector<Event> events() const;

 private:
  Changes changes() const override;
  class Waves;
  BarsParameters p_;
  std::unique_ptr<const Waves> waves_;
};

}  // namespace clackers::exact
