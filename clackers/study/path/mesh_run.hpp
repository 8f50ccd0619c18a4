#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/model/run.hpp"
#include "clackers/solvers/solver.hpp"

namespace clackers::study {

/// A mesh of bars, and what it and the bars do at some nodes and times. Not to be moved while a run is compared.
struct MeshReference {
  struct Point {
    double u = 0.0, u_mesh = 0.0;        ///< the latter NaN where the mesh's motion is not known
    double v_left = 0.0, v_right = 0.0;  ///< both limits of the bar
  };

  cases::Case mesh;
  double h = 0.0, step = 0.0;            ///< of an element [m], and of the integrator [s]
  std::vector<model::Mesh::Node> nodes;  ///< with a degree of freedom, at most 64
  std::vector<double> times;             ///< multiples of the step, at most 100 [s]
  std::vector<Point> points;             ///< of each time all nodes
  double size = 0.0;                     ///< the largest |u| of the bar [m]
  double kinetic = 0.0;                  ///< the largest kinetic energy of the bar [J]
  /// The largest difference of mesh and bar, over it; NaN where the mesh's motion is not known.
  double e_space = 0.0;
};

/// The settings with so many elements.
cases::Settings with_elements(cases::Settings settings, double elements);

/// How many steps of nu h/c, c and h of the bar where that is shortest, the run has.
double steps_along_path(const cases::Case& mesh, double elements, double nu);

MeshReference mesh_reference(cases::Case mesh, double elements, double nu);

/// Errors of a run on a mesh, as columns say them.
struct MeshErrors {
  double e_total = 0.0, e_time = 0.0, v_l1 = 0.0, v_l2 = 0.0, energy = 0.0;
  std::string failure;  ///< a code, or why there is no run; empty where there are errors
};

/// Compares the states at the times of the reference as they come.
class MeshSink : public model::Sink {
 public:
  /// The reference must outlive the sink.
  explicit MeshSink(const MeshReference& known);

  bool take(const model::SampleBlock& block) override;
  bool take(const model::ReportedImpact&) override { return true; }
  MeshErrors errors(const model::Outcome& outcome) const;

 private:
  double energy_of(const double* u, const double* v) const;
  void compare(const double* u, const double* v);

  const MeshReference& known_;
  measure::MechanicalEnergy mechanical_;
  Eigen::VectorXd load_;  // constant
  std::size_t next_ = 0;
  bool begun_ = false;
  double e_total_ = 0.0, e_time_ = 0.0;
  double v_error_ = 0.0, v_size_ = 0.0, v_square_error_ = 0.0, v_square_ = 0.0;
  double energy_ = 0.0, energy_0_ = 0.0;
};

/// Of a solver's run on the mesh; nothing when interrupted.
std::optional<MeshErrors> errors_of(const solvers::SolverSubject& solver,
                                    const MeshReference& known, const std::atomic<bool>* interrupt);

}  // namespace clackers::study
