#pragma once

#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "paper/figure.hpp"

namespace clackers::paper {

/// Which of a mass's quantities a curve shows.
enum class Quantity { displacement, velocity };

/// The exact curve of mass 1 or 2 over the whole run: `points_per_half_turn` pieces in each half
/// period of that mass, so that every extremum of a flight is a point to within its damping, and
/// both limits at every impact.
Series curve(const cases::Case& test_case, int mass, Quantity quantity,
             int points_per_half_turn = 16);

/// The displacement or velocity of all masses, as a panel with time and the quantity for axes, the
/// latter over `range` where that is not empty. The longer the run, the fewer points a half turn.
Panel response_panel(const cases::Case& test_case, Quantity quantity, std::string label,
                     std::string note, std::vector<double> range = {});

/// The response of the same system were there no contact: the flight from the start goes on.
/// From m, c, k
/// at the times of `like`, a curve of that mass, without the evaluation of the exact motion.
Series without_contact(const cases::Case& test_case, int mass, const Series& like);

/// A derived constant or an indicator of a case ("omega_D2", "I_OC"). Throws std::logic_error for one
/// it does not have.
double constant(const cases::Case& test_case, const std::string& name);

// Axes that most figures share.
inline Axis time_axis(double from, double to) { return {"time t [s]", from, to}; }
inline Axis displacement_axis() { return {.title = "displacement u [m]"}; }
inline Axis velocity_axis() { return {.title = "velocity v [m/s]"}; }

}  // namespace clackers::paper
