#pragma once

#include <vector>

#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// Whether a held contact has the force 0 for ever, by fractions of the problem's doubles. `closed` are the contacts of the
/// problem, then its springs, as in a regime; of more than 16 masses the answer is no.
/// In every motion with these contacts held.
bool is_never_pressed(const model::ImpactProblem<>& problem, const std::vector<bool>& closed,
                      std::size_t contact);
/// In the motion that starts with these contacts held: as many derivatives of the force are 0 as its linear equation has
/// solutions. Loads have the phase 0.
bool is_idle_from_start(const model::ImpactProblem<>& problem, const std::vector<bool>& closed,
                        std::size_t contact);

}  // namespace clackers::exact
