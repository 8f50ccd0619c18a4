#pragma once

#include <string_view>

#include "clackers/exact/friction/disk_formulas.hpp"
#include "clackers/exact/orbit/bouncing_ball.hpp"

namespace clackers::exact {

/// The impacts of a disk.
DiskCounts disk_counts(const ObliqueDiskParameters& parameters);

/// The ball of infinitely many impacts with Coulomb friction at each: u1 along the floor, u2 the height, u3 = R times
/// the angle, the slip v1 + v3. An impact of the speed U has the tangential impulse that ends the slip, at most
/// mu (1 + eta) U. It slides through the first impacts, then rolls; or slides on the floor before it rolls.
class ObliqueDisk final : public Bouncing<DiskFormulas> {
 public:
  /// Throws InputError unless eta <= 0.9995, and as require_bouncing().
  ObliqueDisk(const ObliqueDiskParameters& parameters, std::string_view who);

  model::Kinematics envelope(double t) const override;
  Eigen::VectorXd contact_forces(double t, model::Side side) const override;
  /// Impacts through which it slides, and from when on it rolls; infinite for all and never.
  double slides() const;
  double rolls() const;
  double rolling_speed() const {
    return numerics::narrowed(Wide(formulas_.p.vx0) - formulas_.loss).nearest();
  }
};

}  // namespace clackers::exact
