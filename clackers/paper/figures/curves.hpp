#pragma once

#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/paper/figure.hpp"

namespace clackers::paper {

/// One mass of a case on its own spring and dashpot, no contact anywhere: Eq. (4) and (27) for any
/// start, from the masses, dampings and stiffnesses that a solver is given. It shares nothing with
/// the evaluation of the exact motion, so the two can be compared.
class FreeFlight {
 public:
  /// Mass 1 or 2 of the case; below critical damping.
  FreeFlight(const cases::Case& test_case, int mass);
  double u(double t) const;  ///< displacement [m]
  double v(double t) const;  ///< velocity [m/s]

 private:
  double sigma_, omega_;  // rate of decay and damped frequency [1/s]
  double a_, b_;          // u = exp(-sigma t) (a cos(omega t) + b sin(omega t)) [m]
};

/// Which of a mass's quantities a curve shows.
enum class Quantity { displacement, velocity };

/// The exact curve of mass 1 or 2 over the whole run: `points_per_half_turn` pieces in each half
/// period of that mass, so that every extremum of a flight is a point to within its damping, and
/// both limits at every collision.
Series curve(const cases::Case& test_case, int mass, Quantity quantity,
             int points_per_half_turn = 16);

/// The displacement or velocity of all masses, as a panel with time and the quantity for axes, the
/// latter over `range` where that is not empty. The longer the run, the fewer points a half turn.
Panel response_panel(const cases::Case& test_case, Quantity quantity, std::string label,
                     std::string note, std::vector<double> range = {});

/// The response of the same system were there no contact: the flight from the start goes on.
/// Evaluated at the times of `like`, a curve of that mass.
Series without_contact(const cases::Case& test_case, int mass, const Series& like);

/// A derived constant of a case by its name. Throws std::logic_error for one it does not have.
double constant(const cases::Case& test_case, const std::string& name);
/// An indicator of a case: "I_ms", "T_L", "T_S", "I_OC".
double indicator(const cases::Case& test_case, const std::string& name);

/// Axes that most figures share.
Axis time_axis();
Axis displacement_axis();
Axis velocity_axis();

}  // namespace clackers::paper
