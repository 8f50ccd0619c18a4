#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/study/path/mesh_run.hpp"
#include "clackers/study/path/path.hpp"

namespace clackers::study {

/// What the rows of the sheets are of, methods before solvers.
struct Judged {
  std::string name;
  double smooth_order = 0.0;
};

/// A mesh that was run with the step of one path, with the errors of all methods.
struct MeshRuns {
  double nu = 0.0, elements = 0.0, h = 0.0, step = 0.0, e_space = 0.0;
  std::vector<MeshErrors> errors;
};

/// Orders in h that a method of this order in smooth motion has along a path, by what spreads a jump of the velocity:
/// dispersion, 2/3, 1/2 and 1/3 in u, v in L1 and v in L2, which linear elements have themselves; dissipation of first
/// order, 1/2, 1/2 and 1/4. P. Brenner, V. Thomee, L. B. Wahlbin (1975).
struct PathOrders {
  double u = 0.0, v_l1 = 0.0, v_l2 = 0.0;
  std::string_view text;  ///< the three as fractions
};
PathOrders expected_along_path(double smooth_order);

/// The sheets of a path: orders, errors of the finest mesh, curves, crossings and all runs. Each mesh has the errors
/// of all that is judged, in its order.
PathStudy path_study(const PathRequest& request, const std::vector<Judged>& list,
                     const std::vector<MeshRuns>& meshes);

}  // namespace clackers::study
