#pragma once

#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::cases {

/// Derived constants of a pair in words; r is m1/m2 as given. `which` has its motion and problem
/// already.
std::vector<Quantity> pair_constants(const Case& test_case, const exact::PairConstants& c,
                                     double r);

/// Derived constants of the unit mass of Eq. (3) and (5) with damping ratio xi1.
std::vector<Quantity> single_mass_constants(const Case& test_case, double xi1);

/// Indicators of Eq. (10), (11) and (23) of a motion whose fast frequency is `odd` times the slow
/// one `omega` [rad/s]. Throws InputError unless 0 < threshold < 1.
std::vector<Quantity> indicator_constants(double odd, double omega, double end, double threshold);

}  // namespace clackers::cases
