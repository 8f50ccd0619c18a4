#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/mesh.hpp"

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
///     stiffness = 400             # N/m, optional: the contact is one of [[springs]] instead
///     [[loads]]                   # any number: amplitude cos(frequency t + phase)
///     dof = 1                     # from 1
///     amplitude = 0.5             # N
///     frequency = 1.1             # rad/s
///     phase = 0                   # rad, optional
///     [[springs]]                 # any number: + stiffness min(direction . u - gap, 0) direction
///     direction = [1, -1]
///     gap = 0                     # m, optional
///     stiffness = 400             # N/m
///     [[nonlinear_springs]]       # any number: x = direction . u
///     direction = [1, 0]
///     law = "sine"                # stiffness length sin(x/length), or cubic: stiffness x^3
///     stiffness = 400             # N/m, of cubic N/m^3
///     length = 2                  # m
///     [[frictions]]               # any number: dry friction along the direction
///     direction = [1, 0]
///     limit = 0.2                 # N, of the static force
///     kinetic = 0.1               # N, optional: the limit
///     velocity = 0                # m/s, optional: direction . v at which nothing slides
///     contact = 1                 # optional: friction of that contact, of [[contacts]] without a stiffness
///     coefficient = 0.25          # of its force, in place of limit and kinetic
///
/// in TOML, as JSON (this object, or one with it as member "problem"), or as the lines of
/// problem_file_text(). A number may be a text with a fraction, "1/3". Of entries of a matrix that differ by
/// rounding (asymmetric_entry()) both become their mean.
///
/// `name` stands in messages, with the line. Throws InputError for other text, unknown keys
/// (with did-you-mean), missing ones, wrong kinds and sizes, matrices that are not symmetric, or of
/// M not positive definite, a start beyond a contact, and numbers that SI units cannot mean.
model::ImpactProblem<> problem_from_text(std::string_view text, const std::string& name);

/// The same of a file. Throws FileError (cannot-read) too.
model::ImpactProblem<> read_problem(const std::string& path);

// A problem as other programs read it. Numbers read back to the same double.

/// The json object `problem`, as `show CASE --format json` has it:
///
///     {"M": [[1, 0], [0, 2]], "C": [[...]], "K": [[...]],
///      "contacts": [{"direction": [1, -1], "gap": 0, "restitution": 1}],
///      "start": {"t": 0, "u": [...], "v": [...]}, "end": 20}
///
/// for M a + C v + K u = 0 from `start` to `end`, g = direction . u - gap >= 0 and
/// dg/dt(+) = -restitution dg/dt(-); SI units. Where the problem has them,
///
///      "loads": [{"dof": 1, "amplitude": 2, "frequency": 3, "phase": 0}],
///      "springs": [{"direction": [1, -1], "gap": 0, "stiffness": 400}],
///      "nonlinear_springs": [{"direction": [1], "law": "sine", "stiffness": 9.8, "length": 1}],
///      "frictions": [{"direction": [1, 0], "limit": 0.2, "kinetic": 0.1, "velocity": 0},
///                    {"direction": [1, 0], "coefficient": 0.25, "velocity": 0, "contact": 1}],
///
/// add the forces amplitude cos(frequency t + phase) on the right, dof from 1, and
/// stiffness min(direction . u - gap, 0) direction and kinetic sgn(s) direction, s = direction . v - velocity,
/// on the left; where s = 0 friction is what keeps it so, up to its limit. With a contact, from 1, both are the
/// coefficient times the force of the contact, and at an impact friction has an impulse: what makes s = 0, at most
/// the coefficient times the impulse of the contact. "unstated" is a law in words that the
/// motion obeys beside these; problem files do not take it. Throws InputError (linear-only) for
/// any other load or nonlinear force.
std::string problem_json(const model::ImpactProblem<>& problem);

/// The object of a mesh:
///
///     {"mass": "lumped",
///      "nodes": [{"body": 1, "x": 0, "dof": 1, "fixed": false}, ...],
///      "elements": [{"nodes": [1, 2], "stiffness": 1, "density": 1}, ...]}
///
/// where bodies, nodes and degrees of freedom count from 1, and dof is null without one.
std::string mesh_json(const model::Mesh& mesh);

/// Both as members of an object: "problem": {...}, and of a mesh "mesh": {...}.
std::string problem_members(const model::ImpactProblem<>& problem,
                            const std::optional<model::Mesh>& mesh);

/// A file of them: {"schema": "clackers/problem/1", "case": name, "problem": {...}}.
std::string problem_file_json(std::string_view case_name, const model::ImpactProblem<>& problem,
                              const std::optional<model::Mesh>& mesh = {});

/// The same as lines key=values, numbers separated by blanks, always in this order:
///
///     dof=2
///     contacts=1
///     t=0
///     end=20
///     u=0.11 0
///     v=0 1
///     M1=1 0        a line for each row of M; then C1, C2, K1, K2
///     direction1=1 -1
///     gap1=0
///     restitution1=1
///
/// with the last three lines for each contact, then lines load1=dof amplitude frequency phase and
/// spring1=direction gap stiffness, sine1= or cubic1=direction stiffness length, friction1=direction limit kinetic velocity and, of a contact,
/// rubbing1=direction coefficient velocity contact for each of them. Throws as problem_json does.
std::string problem_file_text(const model::ImpactProblem<>& problem);

}  // namespace clackers::model
