#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/diagnose/limit.hpp"
#include "clackers/diagnose/observation.hpp"
#include "clackers/judge/convergence/assessment.hpp"

namespace clackers::diagnose {

/// A parameter of a case, in its unit.
struct CaseParameter {
  std::string name;
  double value = 0.0;
  std::string unit{};
  /// Of the case by its name, as --set takes it; not a number of a contact.
  bool is_setting = true;
  int gap_of = -1;  ///< the contact whose gap it is, from 0
};

/// The motion of the case with these parameters in place of its own; nullptr where they are not
/// allowed or make another number of masses.
using MotionOf =
    std::function<std::shared_ptr<const model::Motion>(std::span<const CaseParameter>)>;

/// The motions of a case over its parameters, which have the values of the case here.
struct CaseFamily {
  std::vector<CaseParameter> parameters{};
  MotionOf motion_of{};
};

/// All that a cause may be looked for in.
struct DiagnosisInput {
  const model::ImpactProblem<>& problem;
  const model::Motion& motion;
  /// The finished histories, coarsest first; empty for a method whose runs are not stored.
  std::span<const Observation> histories;
  const measure::Ladder& ladder;         ///< all runs, failed ones as well
  const judge::LadderFit& displacement;  ///< the fit of their errors
  const judge::LadderFit& velocity;
  Limit limit{};              ///< limit_of() the histories
  bool by_tolerance = false;  ///< the ladder is of tolerances, not of steps
  /// The histories are runs of a method on this very system: only what refinement shows is looked for.
  bool is_this_system = false;
  CaseFamily family{};  ///< no parameters: other values of them are not looked for
};

/// The causes that explain the histories, strongest first, each code at most once for a mass, a
/// contact and a text; empty for a correct
/// solver whose steps are fine.
std::vector<Diagnosis> diagnose(const DiagnosisInput& question);

/// The rows at the start of a history that is refused, or not yet compared.
struct FirstRows {
  double step = 0.0;        ///< [s], 0 where it is not known
  model::Trajectory rows;   ///< as read; `v` may be empty
  std::vector<bool> has_u;  ///< one entry a mass
  double printed_floor = 0.0;
  /// Names of the columns in the file's order, as they were read: "t", "u2", "u1", "_" for one that
  /// is left out. Empty: t, u1, v1, u2, v2, ...
  std::vector<std::string> columns{};
};

/// Why a history starts from another state than the case: units, exchanged columns or masses, signs,
/// a start at rest, velocities of half steps, rows of another time. Nothing where none of these
/// explains all numbers of the first row to 1e-6 of the envelope or to its printed digits.
///
/// Where several do, the first of: one unit for all; masses exchanged; signs; columns exchanged; at
/// rest; half steps; a shift by whole steps; a unit of u or of v alone; unit or sign together with an
/// exchange; a shift by any time. Rows up to the first impact decide between readings of the same
/// first row. `value`: of unit-scaled the factor of the file; of time-shifted the time of the file
/// minus the true one in steps (unit "steps") or seconds ("s"); of velocity-at-half-steps +0.5 or
/// -0.5 steps; of an exchange the factor where there is one as well, else NaN. `text`: of
/// unit-scaled "mm", "u mm" or "v mm/s", or "u" or "v" for a factor that is no known unit; of
/// sign-reversed the columns "u2,v2"; of an exchange the value of --columns that mends it.
std::optional<Diagnosis> diagnose_start(const FirstRows& opening,
                                        const model::ImpactProblem<>& problem,
                                        const model::Motion& motion);

}  // namespace clackers::diagnose
