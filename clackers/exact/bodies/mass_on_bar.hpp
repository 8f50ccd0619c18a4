#pragma once

#include <optional>
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
/// the bar; o = 2 v - a goes out, and a(t) = -+o(t - 2 tau) comes back from a fixed or a free end. While they do
/// not o = a. Between fronts all of them are exp(-z t/M) times a polynomial, whose coefficients are followed in 256
/// bits with running error bounds. Source: A. Barre de Saint-Venant, A. Flamant (1883); derivation:
/// docs/manual/explanation/derivations/bars.md.
class MassOnBar final : public BarMotion {
 public:
  using Wide = numerics::Wide;

  /// Throws InputError unless 0.01 <= M/m <= 100 of the mass m of the bar, for more than 20,000 pieces, and where
  /// it is not certain whether they touch.
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
  /// All contacts that begin up to the end, the first in any case, with the ends of all.
  std::vector<BarContact::Event> events() const;
  /// The velocity of the mass after the last of them [m/s].
  Bounded rebound() const { return numerics::narrowed(phases_.back().speed); }

 private:
  Changes changes() const override;
  using WideReal = numerics::WideReal;
  using Polynomial = std::vector<Wide>;
  // exp(-kappa s) times a polynomial in s/tau, s the time from `origin` on, until the next piece; `before` plus
  // exp(-kappa s) times `integral` is the integral from t = -infinity on.
  struct Piece {
    Wide t, origin;
    Polynomial coefficients, integral;
    Wide before;
  };
  // Until the next one.
  struct Phase {
    Wide t, speed;  // of the mass at t
    bool closed = false;
  };
  // c + b s + exp(-kappa s) p(s/tau)
  struct Course {
    Polynomial p;
    Wide c, b;
  };

  Wide value(const Polynomial& coefficients, const Wide& s) const;
  Wide at(const Course& f, const Wide& s) const { return f.c + f.b * s + value(f.p, s); }
  Polynomial derivative(const Polynomial& p) const;
  Polynomial antiderivative(const Polynomial& p, const Wide& rate) const;
  void follow(std::string_view who);
  void send(const Wide& t, const Wide& origin, Polynomial o, std::string_view who);
  // The first zero after `begin`, where f is not negative, and with `rises` nor is its rate.
  std::optional<Wide> first_fall(const Course& f, const Wide& begin, const Wide& end, bool rises,
                                 std::string_view who) const;
  [[noreturn]] void refuse_soft_touch(const Wide& t, std::string_view who) const;
  Wide outgoing(const Wide& t, model::Side side, const WideReal& slack) const;
  // With its integral from t = -infinity on.
  struct Wave {
    Wide value, sum;
  };
  Wave wave(const Wide& t, model::Side side, const WideReal& slack) const;
  Wide mass_speed(double t) const;

  MassOnBarParameters p_;
  Wide tau_, c_, z_, kappa_;
  double back_ = 0.0;  // of the far end, -1 fixed and 1 free
  Wide start_;
  std::vector<Piece> out_;     // the first before all waves, 0
  std::vector<Phase> phases_;  // the first before contact
};

}  // namespace clackers::exact
