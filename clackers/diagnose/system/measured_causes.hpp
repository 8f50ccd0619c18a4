#pragma once

#include <optional>
#include <vector>

#include "clackers/diagnose/diagnose.hpp"

namespace clackers::diagnose {

/// From one history to another, of at least this many times its step, a measured value stays.
inline constexpr double least_other_step = 1.8, same_share = 0.1;

/// Causes that histories with a wrong limit show row by row, for any number of masses and for loads:
/// no motion is fitted.
///
/// Flights: a row is moved to the next one by the case's own equations; what is missing there in
/// velocity is fitted by what a change of each stiffness, damper and mass, of each load, of all
/// stiffness, damping or loads, and a constant force would make of it, one or two at once, where is_elsewhere(). Then impact_causes() by
/// the equations that the flights have. A cause has the same value in histories of different steps; what a method does
/// falls with the step.
std::vector<Diagnosis> measured_causes(const DiagnosisInput& question);

/// The part of flights. `solved`: the system of the case, which becomes that of the flights.
std::vector<Diagnosis> flight_causes(const DiagnosisInput& question,
                                     model::SmoothSystem<>* solved = nullptr);

/// Whether the errors stop, or are as large as the motion.
bool is_elsewhere(const DiagnosisInput& question);

/// Restitution and momentum of each contact as locate_impacts() reads them: restitution-threshold,
/// energy-gained-at-impacts, restitution-differs, restitution-varies, restitution-scatters,
/// momentum-not-kept.
std::vector<Diagnosis> impact_causes(const DiagnosisInput& question);

/// The case's own motion at other times, of any system: by whole or half steps, or by one number of
/// seconds, in the two finest files.
std::optional<Diagnosis> shifted_time(const DiagnosisInput& question);

/// The motion of the case with one parameter at another value, as the finest histories show it: of all
/// cases that `question.family` has motions of, where what remains is less than a thirtieth of the distance (of a
/// single history a hundredth, and where flights are others more than a method's error makes) and far less than under any other parameter.
/// Parameters that explain as much are one diagnosis with all of them in its text and without a value; of
/// these and a clock that runs by another factor (time-unit), velocities decide, else the parameters
/// of the case, the numbers of its contacts, the clock, in this order.
std::optional<Diagnosis> other_parameter(const DiagnosisInput& question);

}  // namespace clackers::diagnose
