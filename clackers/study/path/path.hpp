#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/base/jobs/progress.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/record/sheet.hpp"
#include "clackers/solvers/solver.hpp"

namespace clackers::study {

/// Methods on finer and finer meshes of bars with steps in proportion to the elements, against the bars themselves.
struct PathRequest {
  /// Specifications; empty, without solvers: the default panel.
  std::vector<std::string> methods;
  std::string case_name;
  cases::Settings settings;      ///< `elements` are those of the coarsest mesh
  std::vector<double> nu{0.45};  ///< c step/h of each path, of the bar where the step is shortest
  int levels = 3;                ///< of meshes, each twice as fine as the one before
  int samples_per_level = 8;     ///< meshes of each
  int jobs = 0;                  ///< threads; 0: one per processor
  /// Programs, judged by the u and v of all masses in their histories, with a row at every step.
  std::vector<solvers::SolverSubject> solvers;
};

struct PathStudy {
  /// Orders, a row a method and path, of u (maximum over x and t) and of v in L1 and L2 over x and t, with those to
  /// expect of data with a kink in u and a jump in v. Then the errors of the finest mesh: e_total against the bars and, where
  /// it is known, e_time against the exact motion of the mesh, e_space between both. Then curves of e_total and
  /// e_space over h, of the first path and eight methods. With several paths a table for each method: e_time of all steps
  /// of a mesh, and the step at which it equals e_space.
  std::vector<record::Sheet> sheets;
  record::Sheet runs;        ///< a row a method, path and mesh
  bool interrupted = false;  ///< not all meshes were run
  bool failed = false;  ///< no method and no program has errors: the first sheet alone says why
};

/// Throws InputError before any work for a case that is no mesh (no-closed-form), unless 1e-3 <= nu <= 100, for steps or
/// meshes that are too many, for adaptive methods and solvers, and as verify() does. A run that fails is a row that says so.
PathStudy follow_path(const PathRequest& request, const Progress& progress = {},
                      const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::study
