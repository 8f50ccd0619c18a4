#pragma once

#include <string_view>

#include "clackers/exact/friction/disk_formulas.hpp"
#include "clackers/exact/orbit/wide_flights.hpp"

namespace clackers::exact {

/// The impacts of a disk.
DiskCounts disk_counts(const ObliqueDiskParameters& parameters);

/// The ball of infinitely many impacts with Coulomb friction at each: u1 along the floor, u2 the height, u3 = R times
/// the angle, the slip v1 + v3. An impact of the speed U has the tangential impulse that ends the slip, at most
/// mu (1 + eta) U. It slides through the first impacts, then rolls; or slides on the floor before it rolls.
/// DiskFormulas in 256 bits. The flights that follow each
/// other within an eighth of the spacing of doubles before it comes to rest are left out.
class ObliqueDisk final : public WideFlights<DiskFormulas> {
 public:
  /// Throws InputError unless 0 <= eta <= 0.9995, or where it neither is above the floor nor leaves it.
  ObliqueDisk(const ObliqueDiskParameters& parameters, std::string_view who);

  model::Kinematics envelope(double t) const override;
  long long impact_count(double t) const override;
  std::vector<model::ClosedContact> closed_contacts() const override;
  Eigen::VectorXd contact_forces(double t, model::Side side) const override;

  double speed() const {
    return numerics::narrowed(formulas_.V).nearest();
  }                                                                    ///< before the first impact
  Bounded rest() const { return instant(formulas_.counts.last + 1); }  ///< the impacts are over
  /// Impacts through which it slides, and from when on it rolls; infinite for all and never.
  double slides() const;
  double rolls() const;
  double rolling_speed() const {
    return numerics::narrowed(Wide(formulas_.p.vx0) - formulas_.loss).nearest();
  }

 private:
  Bounded instant(long long k) const override;
  long long near_flight(double t) const override;
};

}  // namespace clackers::exact
