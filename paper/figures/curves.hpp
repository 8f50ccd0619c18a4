#pragma once

#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "paper/figure.hpp"

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
/// both limits at every impact.
Series curve(const cases::Case& test_case, int mass, Quantity quantity,
             int points_per_half_turn = 16);

/// The displacement or velocity of all masses, as a panel with time and the quantity for axes, the
/// latter over `range` where that is not empty. The longer the run, the fewer points a half turn.
Panel response_panel(const cases::Case& test_case, Quantity quantity, std::string label,
                     std::string note, std::vector<double> range = {});

/// The response of the same system were there no contact: the flight from the start goes on.
/// Evaluated at the times of `like`, a curve of that mass.
Series without_contact(const cases::Case& test_case, int mass, const Series& like);

/// How far two curves with the same abscissae are apart at most. Throws std::logic_error for others.
double largest_difference(const Series& first, const Series& other);
/// Local maxima of a curve strictly inside (0, before).
int maxima(const Series& curve, double before);

/// A derived constant or an indicator of a case ("omega_D2", "I_OC"). Throws std::logic_error for one
/// it does not have.
double constant(const cases::Case& test_case, const std::string& name);
/// A number in the words of a claim: three significant digits, "2.2e-16".
std::string number(double value);

// Axes that most figures share.
inline Axis time_axis(double from, double to) { return {"time t [s]", from, to}; }
inline Axis displacement_axis() { return {.title = "displacement u [m]"}; }
inline Axis velocity_axis() { return {.title = "velocity v [m/s]"}; }

}  // namespace clackers::paper
