#pragma once

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {

struct FreeMassParameters {
  double xi1 = 0.05;    ///< damping ratio, 0 or 1e-60 <= xi1 < 1
  double t_end = 20.0;  ///< [s]
};

/// u'' + 2 xi1 u' + u = 0, u(0) = 1, u'(0) = -xi1 with no stop: Eq. (3), solved by Eq. (4).
class FreeMass : public ClosedForm {
 public:
  /// Throws InputError for parameters outside their ranges.
  explicit FreeMass(const FreeMassParameters& parameters, std::string_view who = "sdof");
  const FreeMassParameters& parameters() const { return parameters_; }

 private:
  FreeMassParameters parameters_;
};

struct RigidStopParameters {
  double xi1 = 0.05;    ///< damping ratio, 0 or 1e-60 <= xi1 < 1
  double eta = 1.0;     ///< restitution, 0 to 1
  double t_end = 20.0;  ///< [s]
};

/// The same mass above a rigid stop at its equilibrium: Eq. (5), for any restitution.
class RigidStop : public ClosedForm {
 public:
  /// Throws InputError for parameters outside their ranges.
  explicit RigidStop(const RigidStopParameters& parameters, std::string_view who = "stop");
  const RigidStopParameters& parameters() const { return parameters_; }

 private:
  RigidStopParameters parameters_;
};

}  // namespace clackers::exact
