#pragma once

#include <atomic>
#include <span>

#include "paper/figure.hpp"

namespace clackers::paper {

/// Whether the errors of a refinement study, coarsest first, fall to a tenth of their largest, and no
/// coarser one is better than the last by more than the factor 2 by which methods scatter that do not
/// locate impacts. False without errors.
bool converges(const Series& line);

/// The figure `validation` for these N, at most six: errors of six methods against the step on the
/// three-parameter system, a panel and a claim for each N. What it costs grows with N. Incomplete when
/// `interrupt` became true.
Figure convergence(std::span<const int> Ns, const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::paper
