#pragma once

#include <cstddef>

#include "clackers/exact/pair/sampling.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::exact {

/// How all masses move between two impacts: displacements are E p(theta), where p solves the undamped
/// equation of motion. Because damping is C = 2 sigma M and sigma^2 M is part of K, the velocities
/// are E (p' - sigma p) and the accelerations E (p'' - 2 sigma p' + sigma^2 p).
class FlightShape {
 public:
  virtual ~FlightShape() = default;
  virtual std::size_t dof() const = 0;
  /// Evaluates the first `count` lanes with the widest vectors of the processor: the same bits on all.
  /// Writes row-major (lane, mass); `out.a` may be empty.
  virtual void sample(const FlightBlock& block, std::size_t count,
                      model::SampleBuffers out) const = 0;
  /// Largest |u|, |v|, |a| of each mass over a flight with E = 1 without decay, or a little more.
  virtual model::Kinematics amplitude() const = 0;
  /// Bound on the errors of sample() over E, as long as E is normal.
  virtual model::Kinematics error() const = 0;
};

}  // namespace clackers::exact
