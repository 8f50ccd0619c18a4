#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {

/// How a motion changes with one parameter p: d(u, v, a)/dp at fixed time, in SI units over the unit
/// of p. Impacts mix the masses, so errors are relative to both: with D and D' the largest |du/dp|
/// and |dv/dp| of either mass in the same flight and omega the undamped frequency of a mass, its
/// du/dp is within S = 1e-13 (D + D'/omega), its dv/dp within omega S, its da/dp within omega^2 S and
/// 1e-13 of its largest in that flight. Below 1e-290 no digit is promised, and none of derivatives by
/// raw parameters once the motion itself is that small.
class Sensitivity {
 public:
  virtual ~Sensitivity() = default;
  /// At an impact `side` decides. Throws InputError outside [0, end()].
  virtual model::Kinematics at(double t, model::Side side) const = 0;
};

/// The numbers that a method is given, each free by itself: m1 m2 k1 k2 c1 c2 eta gap u10 u20 v10
/// v20, those of mass 2 for two masses, eta and gap where something collides. The masses touch where
/// u1 - u2 = -gap (u1 = -gap at a stop).
std::vector<std::string> raw_parameters(const ClosedForm& motion);

/// The free parameters of the motion's class that the motion depends on smoothly, all that follows
/// from them (m2, k2, c1, u2(0), ...) following.
std::vector<std::string> class_parameters(const ClosedForm& motion);

/// The derivative with respect to a raw parameter, through the impacts: the times of the impacts
/// move, and the changed motion is no longer synchronized; docs/manual/explanation/derivations/conditioning.md. The motion must outlive it.
/// Throws InputError for an unknown name, and for eta = 0 where something collides.
std::unique_ptr<Sensitivity> raw_sensitivity(const ClosedForm& motion, std::string_view parameter);

/// The derivative within the class. The motion must outlive it. Throws InputError for an unknown
/// name, and for eta at eta = 0.
std::unique_ptr<Sensitivity> class_sensitivity(const ClosedForm& motion,
                                               std::string_view parameter);

}  // namespace clackers::exact
