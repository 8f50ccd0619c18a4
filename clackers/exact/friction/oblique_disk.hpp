#pragma once

#include <string_view>

#include "clackers/exact/orbit/flights.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// A disk or ball of unit mass that is thrown on a rough floor, turning.
struct ObliqueDiskParameters {
  double h0 = 1.0, v0 = 0.0;    ///< height above the floor and velocity upwards at t = 0 [m, m/s]
  double vx0 = 1.0, w0 = 0.0;   ///< velocity along the floor, and R times that of rotation [m/s]
  double g = 9.81, eta = 0.8;   ///< gravity [m/s^2], restitution
  double mu = 0.1, beta = 0.5;  ///< coefficient of friction; moment of inertia over m R^2
  double end = 5.0;             ///< [s]
};

/// The ball of infinitely many impacts with Coulomb friction at each: u1 along the floor, u2 the height, u3 = R times
/// the angle, the slip v1 + v3. An impact of the speed U has the tangential impulse that ends the slip, at most
/// mu (1 + eta) U. It slides through the first impacts, then rolls; or slides on the floor before it rolls.
/// Closed sums in 256 bits: docs/manual/explanation/derivations/friction.md. The flights that follow each
/// other within an eighth of the spacing of doubles before it comes to rest are left out.
class ObliqueDisk final : public Flights {
 public:
  /// Throws InputError unless 0 <= eta <= 0.9995, or where it neither is above the floor nor leaves it.
  ObliqueDisk(const ObliqueDiskParameters& parameters, std::string_view who);

  model::Kinematics envelope(double t) const override;
  long long impact_count(double t) const override;
  std::vector<model::ClosedContact> closed_contacts() const override;
  Eigen::VectorXd contact_forces(double t, model::Side side) const override;

  double speed() const { return numerics::narrowed(V_).nearest(); }  ///< before the first impact
  Bounded rest() const { return instant(last_ + 1); }                ///< the impacts are over
  /// Impacts through which it slides, and from when on it rolls; infinite for all and never.
  double slides() const;
  double rolls() const;
  double rolling_speed() const { return numerics::narrowed(Wide(p_.vx0) - loss_).nearest(); }

 private:
  using Wide = numerics::Wide;
  // Flight k begins with impact k up to last_; then come slip on the floor, if only for an instant, and rolling.
  Bounded instant(long long k) const override;
  States state(long long k, const Bounded& s) const override;
  long long near_flight(double t) const override;
  Limits limits(long long k) const override;

  Wide power(long long k) const;  // of eta; 0 after the last
  Wide start(long long k) const;
  Wide lost(long long k) const;    // of the velocity along the floor at the beginning of flight k
  Wide behind(long long k) const;  // what that amounts to [m]
  MassState along(long long k, const Wide& share, double velocity) const;

  ObliqueDiskParameters p_;
  Wide V_, first_, once_;  // once_ = 1 - eta
  Wide friction_, loss_;   // lost at the first impact while it slides, and in all when it rolls
  Wide slip_end_;          // seconds of slip on the floor
  long long last_ = 0, slides_ = 0;
};

}  // namespace clackers::exact
