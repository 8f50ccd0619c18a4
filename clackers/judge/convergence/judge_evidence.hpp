#pragma once

#include <vector>

#include "clackers/judge/convergence/assessment.hpp"
#include "clackers/judge/convergence/judge.hpp"

namespace clackers::judge {

/// Half the distance between two claimed orders: a velocity whose order lies further below that of
/// the displacement has a lower one.
inline constexpr double lower_velocity_order = 0.5;

/// A history that ends before this share of the case has not shown it.
inline constexpr double early_end = 0.9;

/// The last run of the finest level; runs come coarsest first.
const measure::RunScore& finest_run(const measure::Ladder& ladder);

/// What the verdict rests on beside the fits: `of_behaviour` is the verdict of the displacement's
/// behaviour alone. Empty for no levels.
std::vector<Evidence> evidence_of(const Assessment& fits, Verdict of_behaviour,
                                  const measure::Ladder& ladder, const Claim& claim,
                                  const Facts& facts);

}  // namespace clackers::judge
