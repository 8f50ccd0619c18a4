#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/files/note.hpp"
#include "clackers/base/parameter.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/mesh.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::exact {
class BarMotion;
}  // namespace clackers::exact

namespace clackers::cases {

/// What is known of a case before its parameters are.
struct CaseEntry {
  std::string name;       ///< never changes its meaning
  std::string summary;    ///< one sentence, with its full stop
  std::string equations;  ///< of the paper: "Eq. (25)-(26)"
  std::vector<Parameter> parameters;
};

using clackers::Settings;

/// A problem together with its reference.
struct Case {
  const CaseEntry* entry = nullptr;
  Settings values;  ///< all parameters, in the entry's order
  model::ImpactProblem<> problem;
  bool is_mesh_only = false;  ///< see make_mesh()
  std::shared_ptr<const model::Motion> motion;
  /// The bars of which the problem is a mesh, and the mesh; nothing for a structure of masses.
  std::shared_ptr<const exact::BarMotion> bars;
  std::optional<model::Mesh> mesh;
  double most_exact_elements = 0.0;  ///< up to so many the exact motion of the mesh is known
  /// Set where u1 and u2 are the coordinates of one body, and u3 its radius times its angle: the radius
  /// of a round wall about the origin [m], 0 without one. A drawing needs it; no row of the problem states it.
  std::optional<double> plane;
  std::vector<Quantity> constants;     ///< derived: m2, k2, omega_D2, r*, margin, ...
  std::vector<Quantity> indicators;    ///< I_ms, T_L, T_S, I_OC, with their threshold
  std::vector<double> damped_periods;  ///< of the free masses [s]
};

/// The threshold of "non-trivially contributing" in Eq. (11), of the spectral peak.
inline constexpr double default_threshold = 0.1;

/// All cases, the default one first.
std::span<const CaseEntry> entries();
std::string_view default_case();

/// The entry of a name; throws InputError with did-you-mean.
const CaseEntry& entry(std::string_view name);

/// Builds a case. Throws InputError for unknown names (with did-you-mean) and for values outside
/// their range. For a mass ratio beyond r*(X) the message says by how much, where and when the
/// masses would touch away from equilibrium, and what to change. `threshold` lies in (0, 1).
Case make(std::string_view name, const Settings& settings = {},
          double threshold = default_threshold);

/// The bars of a case and their mesh, without the exact motion of the mesh and what is derived from it: of up to 4000
/// elements, where make() takes `most_exact_elements`. Throws InputError as make() does, and (no-closed-form) for a case that is no mesh.
Case make_mesh(std::string_view name, const Settings& settings = {});

/// How far the masses of a pair stay apart away from equilibrium (sharp form of Eq. 18).
struct Admissibility {
  double r_star = 0.0;  ///< limit of slow over fast mass; infinity for equal frequencies
  /// Smallest gap between impacts relative to the slow displacement: 1 - r/r*, 1 - 1/(r r*) for
  /// X = 1 over an odd number, 1 + r for X = 1. The closed form holds where it is positive; 0 grazes.
  double margin = 0.0;
};

/// For a frequency ratio X (odd, or 1 over an odd number) and a mass ratio r = m1/m2, admissible or
/// not. Throws InputError for another X, and unless 1e-60 <= r <= 1e60.
Admissibility admissibility(double X, double r);

}  // namespace clackers::cases
