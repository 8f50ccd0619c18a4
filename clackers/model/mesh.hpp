#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace clackers::model {

/// Where the mass of linear elements is: at the nodes, spread (rho A h/6 [2 1; 1 2] an element), or at
/// the nodes without that of the contact nodes, which their neighbours carry (mass redistribution:
/// H. B. Khenous, P. Laborde, Y. Renard, Eur. J. Mech. A 27, 918-932 (2008)).
enum class NodeMass { lumped, consistent, massless };

/// Linear elements along a line, of which the matrices of a problem were made: for programs that make
/// their own. A degree of freedom that no node has is that of a rigid mass.
struct Mesh {
  struct Node {
    std::size_t body = 0;  ///< bar or string
    /// Where nothing is deformed [m]: bars from the contact on, that to its left with x <= 0.
    double x = 0.0;
    std::optional<Eigen::Index> dof{};  ///< none of fixed nodes and of contact nodes without mass
    bool is_fixed = false;
  };
  struct Element {
    std::size_t left = 0, right = 0;  ///< nodes
    double stiffness = 0.0;           ///< E A of a bar, the tension of a string [N]
    double density = 0.0;             ///< mass per length [kg/m]
  };
  NodeMass mass = NodeMass::lumped;
  std::vector<Node> nodes;  ///< of each body, the left one first, ascending
  std::vector<Element> elements;

  std::vector<Node> nodes_with_dof() const {
    auto some = nodes;
    std::erase_if(some, [](const Node& node) { return !node.dof; });
    return some;
  }
};

}  // namespace clackers::model
