#include "clackers/study/path/mesh_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/exact/bodies/bar_mesh.hpp"
#include "clackers/input/history.hpp"
#include "clackers/solvers/work_folder.hpp"
#include "clackers/study/check/history/prepared_history.hpp"

namespace clackers::study {
namespace {

using model::Side;

constexpr std::size_t most_times = 100, most_nodes = 64;

double shortest_transit(const cases::Case& mesh) {
  double shortest = INFINITY;
  for (const auto& constant : mesh.constants)
    if (constant.name == "tau" || constant.name == "tau1" || constant.name == "tau2")
      shortest = std::min(shortest, constant.value);
  return shortest;
}

// The larger size; that of a run that has become NaN is NaN.
double worst(double a, double b) { return std::isnan(b) ? b : std::max(a, std::abs(b)); }

}  // namespace

cases::Settings with_elements(cases::Settings settings, double elements) {
  std::erase_if(settings, [](const auto& setting) { return setting.first == "elements"; });
  settings.emplace_back("elements", elements);
  return settings;
}

double steps_along_path(const cases::Case& mesh, double elements, double nu) {
  return std::ceil(mesh.problem.end * elements / (nu * shortest_transit(mesh)) - 1e-9);
}

MeshReference mesh_reference(cases::Case made, double elements, double nu) {
  MeshReference known;
  known.mesh = std::move(made);
  const auto* motion = known.mesh.motion.get();
  const double end = known.mesh.problem.end;
  const auto nodes = known.mesh.mesh->nodes_with_dof();
  const double steps = steps_along_path(known.mesh, elements, nu);
  known.h = known.mesh.bars->lengths().front() / elements;
  known.step = end / steps;
  const std::size_t stride = (nodes.size() + most_nodes - 1) / most_nodes;
  for (std::size_t i = 0; i < nodes.size(); i += stride) known.nodes.push_back(nodes[i]);
  const auto count = std::size_t(std::min(steps, double(most_times)));
  known.kinetic = known.mesh.bars->energy(0.0).kinetic.nearest();
  for (std::size_t k = 1; k <= count; ++k) {
    const double t = std::min(end, std::round(double(k) * steps / double(count)) * known.step);
    known.kinetic = std::max(known.kinetic, known.mesh.bars->energy(t).kinetic.nearest());
    known.times.push_back(t);
    const Eigen::VectorXd u_mesh =
        motion == nullptr ? Eigen::VectorXd::Constant(known.mesh.problem.dof(), std::nan(""))
                          : motion->at(t, Side::right).u;
    for (const auto& node : known.nodes) {
      const auto right = known.mesh.bars->at(node.body, std::abs(node.x), t, Side::right);
      const auto left = known.mesh.bars->at(node.body, std::abs(node.x), t, Side::left);
      const MeshReference::Point point{right.u.nearest(), u_mesh[*node.dof], left.v.nearest(),
                                       right.v.nearest()};
      known.points.push_back(point);
      known.size = std::max(known.size, std::abs(point.u));
      known.e_space = worst(known.e_space, point.u_mesh - point.u);
    }
  }
  known.e_space /= known.size;
  return known;
}

MeshSink::MeshSink(const MeshReference& known)
    : known_(known),
      mechanical_(known.mesh.problem.system),
      load_(Eigen::VectorXd::Zero(known.mesh.problem.dof())) {
  if (const auto& add_load = known.mesh.problem.system.add_load)
    add_load(0.0, {load_.data(), std::size_t(load_.size())});
}

bool MeshSink::take(const model::SampleBlock& block) {
  const auto dof = std::size_t(block.dof);
  for (std::size_t row = 0; row < block.t.size(); ++row) {
    const bool first = !std::exchange(begun_, true);
    const bool wanted =
        next_ < known_.times.size() && block.t[row] > known_.times[next_] - 0.5 * known_.step;
    const double *u = &block.u[row * dof], *v = &block.v[row * dof];
    if (first || wanted) energy_ = energy_of(u, v);
    if (first) energy_0_ = energy_;
    if (wanted) compare(u, v);
  }
  return true;
}

double MeshSink::energy_of(const double* u, const double* v) const {
  return mechanical_.kinetic(v) + mechanical_.potential(u) -
         load_.dot(Eigen::Map<const Eigen::VectorXd>(u, load_.size()));
}

void MeshSink::compare(const double* u, const double* v) {
  const auto* point = &known_.points[next_++ * known_.nodes.size()];
  for (const auto& node : known_.nodes) {
    const auto i = std::size_t(*node.dof);
    e_total_ = worst(e_total_, u[i] - point->u);
    e_time_ = worst(e_time_, u[i] - point->u_mesh);
    // On a front the bar has two velocities; the nearer one counts.
    const double error = std::min(std::abs(v[i] - point->v_left), std::abs(v[i] - point->v_right));
    v_error_ += error;
    v_square_error_ += error * error;
    v_size_ += std::abs(point->v_right);
    v_square_ += point->v_right * point->v_right;
    ++point;
  }
}

MeshErrors MeshSink::errors(const model::Outcome& outcome) const {
  MeshErrors found{e_total_ / known_.size,
                   e_time_ / known_.size,
                   v_error_ / v_size_,
                   std::sqrt(v_square_error_ / v_square_),
                   (energy_ - energy_0_) / known_.kinetic,
                   {}};
  if (outcome.failed())
    found.failure = std::string(outcome.reason.name());
  else if (!std::isfinite(found.e_total + found.v_l1 + found.v_l2 + found.energy) ||
           next_ < known_.times.size())
    found.failure = "diverges";
  return found;
}

namespace {

MeshErrors failed(std::string_view sentence, std::string_view code) {
  MeshErrors errors;
  errors.failure = fmt::format("{} [{}]", sentence, code);
  return errors;
}

// Compares the rows at the times of the reference; those between are passed over.
MeshErrors compared(const input::History& history, const MeshReference& known) {
  constexpr double apart = 1e-3;  // of a step: what printing leaves
  const auto& [dof, t, u, v, a, impacts] = history.motion;
  const auto n = std::size_t(dof);
  if (v.empty() || std::ranges::count(history.has_u, false) > 0)
    return failed("Its history has not u and v of all masses.", "no-column");
  MeshSink sink(known);
  const auto& start = known.mesh.problem.start;
  sink.take(
      model::SampleBlock{dof, std::span(&start.t, 1), {start.u.data(), n}, {start.v.data(), n}});
  for (const double time : known.times) {
    const auto after = std::ranges::lower_bound(t, time - apart * known.step);
    if (after == t.end() || *after > time + apart * known.step)
      return failed(fmt::format("Its history has no row at t = {:.9g} s, after a whole number of "
                                "steps.",
                                time),
                    "time-outside");
    const auto row = std::size_t(after - t.begin());
    sink.take(model::SampleBlock{dof, std::span(&time, 1), {&u[row * n], n}, {&v[row * n], n}});
  }
  return sink.errors({});
}

}  // namespace

std::optional<MeshErrors> errors_of(const solvers::SolverSubject& solver,
                                    const MeshReference& known,
                                    const std::atomic<bool>* interrupt) {
  const auto& problem = known.mesh.problem;
  const solvers::SolverRun run{known.step, std::llround(problem.end / known.step)};
  const auto prepared = solver.prepare(known.mesh);
  prepared->expect({run});
  const auto output = prepared->run(run, interrupt);
  if (output.interrupted) return {};
  if (!output.history) return failed(output.failure, output.failure_code);
  try {
    const auto history = input::read_history(
        *output.history, {.dof = int(problem.dof()), .step = known.step, .interrupt = interrupt});
    require_masses(input::name_of(*output.history), history);
    return compared(history, known);
  } catch (const Error& error) {
    if (error.code() == Code("interrupted")) return {};
    const std::filesystem::path file = input::path_of(*output.history);
    return failed(file.empty() ? std::string(error.what())
                               : solvers::without_folder(error.what(), file.parent_path()),
                  error.code().name());
  }
}

}  // namespace clackers::study
