#pragma once

#include <string_view>
#include <vector>

#include "clackers/exact/bodies/bar_contact.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// A rigid mass that flies against the end of a bar at rest.
struct MassOnBarParameters {
  Bar bar;                ///< its v0 has no meaning
  double M = 1.0;         ///< [kg]
  double V = 1.0;         ///< [m/s]
  double gap = 0.0;       ///< at t = 0 [m]
  bool is_fixed = false;  ///< the far end; otherwise free
  double end = 0.0;       ///< [s]
};

/// While they touch M v' = -z (v - a) with the velocity v of both, the arriving wave a and the impedance z of
/// the bar; o = 2 v - a goes out, and a(t) = -+o(t - 2 tau) comes back from a fixed or a free end. Between
/// multiples of 2 tau all of them are exp(-z t/M) times a polynomial, whose coefficients are followed in 256
/// bits with running error bounds. Source: A. Barre de Saint-Venant, A. Flamant (1883); derivation:
/// docs/manual/explanation/derivations/bars.md.
class MassOnBar final : public BarMotion {
 public:
  using Wide = numerics::Wide;

  /// Throws InputError unless 0.01 <= M/m <= 100 of the mass m of the bar, for more than 20,000 pieces, and
  /// where they would meet once more before the end.
  MassOnBar(const MassOnBarParameters& parameters, std::string_view who);

  double end() const override { return p_.end; }
  std::vector<double> lengths() const override { return {p_.bar.L}; }
  Point at(std::size_t bar, double x, double t, model::Side side) const override;
  Bounded force(double t, model::Side side) const override;
  Bounded impulse(double t, model::Side side) const override;
  Energy energy(double t) const override;

  BarContact::Wave wave() const {
    return {numerics::narrowed(tau_), numerics::narrowed(c_), numerics::narrowed(z_)};
  }
  /// When the contact begins and ends [s]; the velocity of the mass after it.
  Bounded begins() const { return numerics::narrowed(start_); }
  Bounded ends() const { return numerics::narrowed(end_of_contact_); }
  Bounded rebound() const { return numerics::narrowed(last_speed_); }

 private:
  Changes changes() const override { return {{begins(), ends()}, {}}; }
  using WideReal = numerics::WideReal;
  // exp(-kappa s) times a polynomial in s/tau, s the time from `origin` on, until the next piece.
  struct Piece {
    Wide t, origin;
    std::vector<Wide> coefficients;
    Wide integral;  // of all pieces before
  };

  Wide value(const std::vector<Wide>& coefficients, const Wide& s) const;
  std::vector<Wide> antiderivative(const std::vector<Wide>& coefficients) const;
  void follow_contact(std::string_view who);
  void reflect(std::string_view who);
  void require_one_contact(std::string_view who) const;
  Wide outgoing(const Wide& t, model::Side side, const WideReal& slack) const;
  Wide sum_of_out(const Wide& t) const;
  Wide mass_speed(const Wide& t, model::Side side) const;

  MassOnBarParameters p_;
  Wide tau_, c_, z_, kappa_, back_;  // back_: of the far end, -1 fixed and 1 free
  Wide start_, end_of_contact_, last_speed_;
  std::vector<Piece> out_;  // the first before all waves, 0
};

}  // namespace clackers::exact
