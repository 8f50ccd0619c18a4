#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/exact/orbit/ball_formulas.hpp"
#include "clackers/exact/orbit/wide_flights.hpp"

namespace clackers::exact {

/// How often eta has to be multiplied until a share is left, give or take one.
long long powers(const numerics::Wide& share, double eta);

/// The last impact more than an eighth of the spacing of doubles before rest.
long long last_impact(const BallParameters& ball);

/// Throws InputError unless 0 <= eta < 1, and the ball is above the floor or leaves it.
const BallParameters& require_bouncing(const BallParameters& ball, std::string_view who);

/// A height like that of a bouncing ball, in 256 bits: FormulasOf extends BallFormulas. Flights between the last
/// impact and rest are left out.
template <template <class> class FormulasOf>
class Bouncing : public WideFlights<FormulasOf> {
 public:
  long long impact_count(double t) const override {
    model::require_inside("motion", t, this->end());
    return t >= rest_ ? formulas_.last : Flights::impact_count(t);
  }
  std::vector<model::ClosedContact> closed_contacts() const override {
    const double reach = rest().nearest_error(), end = this->end();
    if (rest_ > end) return {};
    return {{0,
             rest_,
             end,
             {rest_ - reach, rest_ + reach},
             false,
             formulas_.ball.eta > 0.0,
             instant(formulas_.last).nearest()}};
  }
  Eigen::VectorXd contact_forces(double t, model::Side side) const override {
    return Eigen::VectorXd::Constant(
        1, this->flight_at(t, side) > formulas_.last ? formulas_.ball.g : 0.0);
  }

  /// Before the first impact [m/s], and its instant [s].
  double speed() const { return numerics::narrowed(formulas_.V).nearest(); }
  double first_impact() const { return instant(1).nearest(); }
  /// The impacts are over [s].
  numerics::Bounded rest() const { return instant(formulas_.last + 1); }

 protected:
  using typename WideFlights<FormulasOf>::Wide;
  Bouncing(const FlightsParameters& parameters, FormulasOf<Wide> formulas)
      : WideFlights<FormulasOf>(parameters, std::move(formulas)), rest_(rest().nearest()) {}
  using WideFlights<FormulasOf>::formulas_;

  numerics::Bounded instant(long long k) const override {
    return k > formulas_.last_flight() ? numerics::Bounded(HUGE_VAL)
                                       : WideFlights<FormulasOf>::instant(k);
  }
  long long near_flight(double t) const override {
    const double eta = formulas_.ball.eta;
    const auto left = (formulas_.rest() - Wide(t)) / formulas_.unit;
    return left.value > 0 ? std::clamp(powers(left, eta), 0LL, formulas_.last) : formulas_.last + 1;
  }

 private:
  double rest_ = 0.0;
};

/// A ball that bounces until it rests on the floor.
class BouncingBall final : public Bouncing<BallFormulas> {
 public:
  /// Throws InputError as require_bouncing().
  BouncingBall(const BallParameters& ball, std::string_view who);

  model::Kinematics envelope(double t) const override;

 private:
  Bounded instant(long long k) const override;
  Bounded since(long long k, double t) const override;
  States state(long long k, const Bounded& s) const override;
  Limits limits(long long k) const override;
  long long near_flight(double t) const override;

  /// Where flight 0, 1, ... begins, at t + more, and its velocity there: of the first ones, in 64 bits.
  struct Start {
    Bounded t, more, v;
  };
  std::vector<Start> starts_;
};

}  // namespace clackers::exact
