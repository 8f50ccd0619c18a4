#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::measure {

/// An instant at which contacts that share masses close together, or one closes while another is held closed: an impulse
/// at one changes the gap rate of another.
struct SharedInstant {
  double t = 0.0;    ///< [s]
  int contacts = 0;  ///< how many close or are closed
};

/// Those of the reference, ascending, as far as they are among its first 1000 impacts. Impacts are of one instant where
/// their enclosures overlap.
std::vector<SharedInstant> shared_instants(const model::Motion& reference,
                                           const model::ImpactProblem<>& problem);

/// The shortest time between an impact and the next one at another contact that shares masses with it, of those impulses
/// that are a tenth of the largest or more [s]: longer steps may take them in another order. 0 without any among the first
/// 1000 impacts.
double closest_impacts(const model::Motion& reference, const model::ImpactProblem<>& problem);

/// What the error does at such an instant, in the finest run that is known in time.
struct SharedImpacts {
  SharedInstant instant;
  double error_before = 0.0;  ///< largest until then, of u over its scale
  double error_after = 0.0;   ///< largest in as much time after it, at most until the next one
};

/// At the first instant from which the error comes (comes_from_shared_impacts), else at the first one: from the largest
/// errors of each mass in equal intervals with the middles `times`, one row a mass. Nothing where no interval ends before
/// it, or none lies between it and the next one.
std::optional<SharedImpacts> at_shared_instants(std::span<const SharedInstant> instants,
                                                double start, std::span<const double> times,
                                                std::span<const std::vector<double>> errors);

/// Whether the error comes from the impacts of that instant. A phase error of steps that are too large
/// grows with time, twofold over these times, and by a few of the factors by which impacts magnify it.
bool comes_from_shared_impacts(const SharedImpacts& found);

}  // namespace clackers::measure
