#pragma once

#include <optional>
#include <vector>

#include "clackers/diagnose/observation.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::diagnose {

/// Polynomials between the states of a solver's own steps, as the rows of a history show them.
struct Interpolation {
  int degree = 1;                  ///< 1 or 3
  double spacing = 0.0;            ///< of the nodes, mean [s]
  double error = 0.0;              ///< largest error between nodes, of u over its scale
  int mass = 0;                    ///< whose displacement shows it most, from 0
  std::vector<std::size_t> nodes;  ///< rows of the opening nearest to nodes, ascending
};

/// Looks for them in the opening rows. Differences of order degree + 1 of equally spaced rows vanish
/// within a polynomial, up to rounding, and do not around its nodes. Told where at least a quarter of
/// the differences vanish, in a displacement that moves, there are far more nodes than impacts, and
/// half of the nodes have differences of at least 30 times what rounding or printing makes. So the
/// intervals between nodes have more than two rows (linear) or five (cubic).
///
/// The error follows from the jumps J of the derivative of order `degree` at nodes H apart: J H / 8
/// of straight lines, J H^3 / 384 of Hermite's cubics.
std::optional<Interpolation> interpolation_of(const Observation& history,
                                              const model::Kinematics& scale);

}  // namespace clackers::diagnose
