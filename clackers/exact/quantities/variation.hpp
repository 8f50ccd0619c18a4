#pragma once

#include <Eigen/Core>

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {

/// The first variation Phi(t) of a motion through its impacts: to first order, a change x of (u, v)
/// at the start changes (u, v) at t by Phi(t) x. Square of order 2 dof, displacements of all masses
/// before velocities; Phi(0) = 1. In flight k >= 1 it is (-e)^(k-1) F(t - t_k) (J^k + J^k) F(t_1)
/// with the free flight F and the saltation matrix J; mathematics.md, section 3. Accurate as
/// Sensitivity. At a collision `side` decides. Throws InputError outside [0, end()], and for eta =
/// 0 where something collides.
Eigen::MatrixXd first_variation(const ClosedForm& motion, double t, model::Side side);

}  // namespace clackers::exact
