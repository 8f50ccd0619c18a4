#pragma once

#include <string_view>
#include <vector>

#include "clackers/exact/bodies/bar_contact.hpp"
#include "clackers/exact/bodies/string_on_obstacle.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/mesh.hpp"

namespace clackers::exact {

/// What is meshed: the bars of a BarContact, one that a rigid mass strikes, one between stops, or half a plucked string.
struct MeshedBars {
  std::vector<Bar> bars;
  double gap = 0.0, end = 0.0, g = 0.0;  ///< the gap where nothing is deformed
  double striker = 0.0, speed = 0.0;  ///< mass left of the bar and its velocity [kg, m/s]; 0: none
  bool is_fixed = false;              ///< the far end of the bar
  double clearance = 0.0;             ///< of a bar between two stops, both gaps [m]; 0: one stop
  double pluck = 0.0;  ///< of the contact end at t = 0, linear to 0 at the far end [m]
};

/// The bars in linear elements of one length: what an integrator gets. A mass that strikes is the first
/// degree of freedom.
struct BarMesh {
  model::ImpactProblem<> problem;
  model::Mesh mesh;
};

/// `elements` in each bar. Massless contact nodes are eliminated: what is left of them is a one-sided
/// spring, the element at the contact. Throws InputError, `who` first, unless 1 <= elements <= 4000, a
/// whole number, at least 2 where contact nodes are massless; and for a restitution of those.
BarMesh bar_mesh(const MeshedBars& meshed, double elements, model::NodeMass mass, double eta,
                 std::string_view who);

/// The nodes of a StringOnObstacle between its ends, of mass rho h, each above a stop at u = 0 with restitution 1.
/// Throws InputError, `who` first, unless 2 <= elements <= 4000, a whole number.
BarMesh string_mesh(const StringOnObstacleParameters& meshed, double elements,
                    std::string_view who);

}  // namespace clackers::exact
