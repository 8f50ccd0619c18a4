#pragma once

#include <optional>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/mesh.hpp"

namespace clackers::record {

/// How a structure is drawn: masses that springs couple stand above each other in one column, in
/// layers by their distance from the ground; what may collide stands side by side. Pendula, a body in
/// the plane and the nodes of a string are drawn where they are instead. Masses are numbered from 0.
struct Schematic {
  struct Block {
    int column = 0;       ///< from 0, left to right
    double height = 1.0;  ///< in (0, 1], of the tallest layer of its structure
  };
  /// A spring between masses, or to the ground where `other` is -1.
  struct Spring {
    int one = 0, other = -1;
  };
  /// A contact of two masses, or of a mass and a wall, which is -1.
  struct Touch {
    int left = -1, right = -1;
    double gap = 0.0;  ///< between the faces at u = 0 [m]
  };
  /// A point of a string, at rest at x [m]; a mass moves across it, -1 is fixed.
  struct Node {
    double x = 0.0;
    int mass = -1;
  };
  std::vector<Block> blocks;
  std::vector<Spring> springs;
  std::vector<Touch> contacts;  ///< one a contact of the problem, in its order
  /// Positive displacements are drawn to the left, so that the first mass stands left of the last.
  bool leftward = false;
  /// Of pendula, one a mass, whose displacements are arcs from the lowest point [m]; else empty.
  std::vector<double> lengths{};
  /// Of one body in the plane as cases::Case has it.
  std::optional<double> plane{};
  /// Of a string from end to end, in both halves where they move alike; else empty.
  std::vector<Node> string{};
};

/// A structure with more masses is not drawn.
inline constexpr int most_blocks = 64;

/// Read from the stiffness matrix, the springs of pendula and the contacts; empty beyond most_blocks, and where a contact
/// joins another combination of masses than two of them or a mass and a wall.
Schematic schematic(const model::ImpactProblem<>& problem);

/// The nodes of a string, and their images where the mesh is the half to the right of x = 0.
std::vector<Schematic::Node> string_nodes(const model::Mesh& mesh);

}  // namespace clackers::record
