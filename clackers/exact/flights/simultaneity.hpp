#pragma once

#include <cstddef>

#include "clackers/model/impact_problem.hpp"

namespace clackers::exact {

/// Whether the numbers of a problem, as they stand, prove that two contacts close at the same instants
/// whenever they close. Either of
///
///  - a symmetry: degrees of freedom exchanged among themselves, with signs, so that M, C, K, the start,
///    the harmonic loads and the set of contacts with their laws stay what they are, and the first contact becomes
///    the second. A motion that is unique has the symmetries of its problem.
///  - one frequency: K and C multiples of M, no load, every contact at b . u = 0, and a start without
///    displacements or without velocities. All gaps are then the same function of time, each times a number.
///
/// False where neither is found; the search for a symmetry ends after 1e5 trials.
bool close_together(const model::ImpactProblem<>& problem, std::size_t first, std::size_t second);

}  // namespace clackers::exact
