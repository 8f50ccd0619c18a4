#pragma once

#include <string>
#include <string_view>

#include "clackers/model/impact_problem.hpp"

// Problems that are read: M a + C v + K u = f(t) with contacts, in SI units.
namespace clackers::model {

/// A problem as an example of the format; what the case `piecewise` is without a file.
extern const std::string_view example_problem;

/// Reads
///
///     M = [[2, 0], [0, 1]]        # kg; K [N/m] and C [N s/m] the same way, C optional
///     end = 20                    # s
///     [start]
///     u = [0.1, 0]                # m; v [m/s] optional
///     [[contacts]]                # any number: g = direction . u - gap >= 0
///     direction = [1, -1]
///     gap = -0.05                 # m, optional
///     restitution = 0.8           # optional, 1
///     [[loads]]                   # any number: amplitude cos(frequency t + phase)
///     dof = 1                     # from 1
///     amplitude = 0.5             # N
///     frequency = 1.1             # rad/s
///     phase = 0                   # rad, optional
///     [[springs]]                 # any number: + stiffness min(direction . u - gap, 0) direction
///     direction = [1, -1]
///     gap = 0                     # m, optional
///     stiffness = 400             # N/m
///
/// in TOML, as JSON (this object, or one with it as member "problem"), or as the lines of
/// problem_file_text(). A number may be a text with a fraction, "1/3".
///
/// `name` stands in messages, with the line. Throws InputError for other text, unknown keys
/// (with did-you-mean), missing ones, wrong kinds and sizes, matrices that are not symmetric, or of
/// M not positive definite, a start beyond a contact, and numbers that SI units cannot mean.
model::ImpactProblem<> problem_from_text(std::string_view text, const std::string& name);

/// The same of a file. Throws FileError (cannot-read) too.
model::ImpactProblem<> read_problem(const std::string& path);

}  // namespace clackers::model
