#include "clackers/study/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/exact/bodies/bar_mesh.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/numerics/line_fit.hpp"
#include "clackers/study/run_sinks.hpp"

namespace clackers::study {
namespace {

using model::Side;

constexpr std::size_t most_times = 100, most_nodes = 64;
constexpr double most_work = 1e12;  // steps times squared degrees of freedom

// What a mesh and its bars do at some nodes and times.
struct References {
  cases::Case mesh;
  double elements = 0.0, h = 0.0, step = 0.0, steps = 0.0;
  std::vector<std::size_t> nodes;
  std::vector<double> times;
  struct Point {
    double u = 0.0, u_mesh = 0.0, v_left = 0.0, v_right = 0.0;
  };
  std::vector<Point> points;  // times x nodes
  double size = 0.0, e_space = 0.0;
};

double shortest_transit(const cases::Case& mesh) {
  double shortest = INFINITY;
  for (const auto& constant : mesh.constants)
    if (constant.name == "tau" || constant.name == "tau1" || constant.name == "tau2")
      shortest = std::min(shortest, constant.value);
  return shortest;
}

References references(const PathRequest& request, double elements) {
  References known;
  auto settings = request.settings;
  std::erase_if(settings, [](const auto& setting) { return setting.first == "elements"; });
  settings.emplace_back("elements", elements);
  known.mesh = cases::make(request.case_name, settings);
  const auto& [mesh, motion] = std::tie(*known.mesh.mesh, *known.mesh.motion);
  known.elements = elements;
  known.h = known.mesh.bars->lengths().front() / elements;
  known.steps =
      std::ceil(motion.end() * elements / (request.nu * shortest_transit(known.mesh)) - 1e-9);
  known.step = motion.end() / known.steps;
  const std::size_t stride = (mesh.nodes.size() + most_nodes - 1) / most_nodes;
  for (std::size_t i = 0; i < mesh.nodes.size(); i += stride) known.nodes.push_back(i);
  const auto count = std::size_t(std::min(known.steps, double(most_times)));
  for (std::size_t k = 1; k <= count; ++k) {
    const double t =
        std::min(motion.end(), std::round(double(k) * known.steps / double(count)) * known.step);
    known.times.push_back(t);
    const auto now = motion.at(t, Side::right);
    for (const auto i : known.nodes) {
      const auto& node = mesh.nodes[i];
      const auto right = known.mesh.bars->at(node.bar, node.x, t, Side::right);
      const auto left = known.mesh.bars->at(node.bar, node.x, t, Side::left);
      known.points.push_back({right.u.nearest(), now.u[mesh.first + Eigen::Index(i)],
                              left.v.nearest(), right.v.nearest()});
      const auto& point = known.points.back();
      known.size = std::max(known.size, std::abs(point.u));
      known.e_space = std::max(known.e_space, std::abs(point.u_mesh - point.u));
    }
  }
  known.e_space /= known.size;
  return known;
}

// Kinetic and stored energy, less the work of a constant load.
double energy_of(const model::ImpactProblem<>& problem, const Eigen::VectorXd& u,
                 const Eigen::VectorXd& v) {
  const auto& s = problem.system;
  double sum = 0.5 * (v.dot(s.mass * v) + u.dot(s.stiffness * u));
  if (s.nonlinear) sum += s.nonlinear->potential(u);
  if (s.add_load) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(u.size());
    s.add_load(0.0, {load.data(), std::size_t(load.size())});
    sum -= load.dot(u);
  }
  return sum;
}

struct PathRun {
  double e_total = 0.0, e_time = 0.0, v_l1 = 0.0, v_l2 = 0.0, energy = 0.0;
  std::string failure;
};

// Compares the states at the times of the references as they come.
class PathSink : public model::Sink {
 public:
  explicit PathSink(const References& known) : known_(known) {}

  bool take(const model::SampleBlock& block) override {
    const auto dof = std::size_t(block.dof);
    for (std::size_t row = 0; row < block.t.size(); ++row) {
      const bool first = !begun_;
      begun_ = true;
      const bool wanted =
          next_ < known_.times.size() && block.t[row] > known_.times[next_] - 0.5 * known_.step;
      if (!first && !wanted) continue;
      const auto u = block.u.subspan(row * dof, dof), v = block.v.subspan(row * dof, dof);
      note_energy(u, v, first);
      if (wanted) compare(u, v, next_++);
    }
    return true;
  }
  bool take(const model::ReportedImpact&) override { return true; }

  PathRun result(const model::Outcome& outcome) const {
    PathRun run{e_total_ / known_.size,
                e_time_ / known_.size,
                v_error_ / v_size_,
                std::sqrt(v_square_error_ / v_square_),
                (energy_ - energy_0_) / largest_energy_,
                {}};
    if (outcome.failed())
      run.failure = std::string(outcome.reason.name());
    else if (!std::isfinite(run.e_total) || next_ < known_.times.size())
      run.failure = "diverges";
    return run;
  }

 private:
  void note_energy(std::span<const double> u, std::span<const double> v, bool first) {
    const auto vector = [](std::span<const double> x) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size())));
    };
    const auto& problem = known_.mesh.problem;
    energy_ = energy_of(problem, vector(u), vector(v));
    if (first) energy_0_ = energy_;
    largest_energy_ =
        std::max(largest_energy_, 0.5 * vector(v).dot(problem.system.mass * vector(v)));
  }

  void compare(std::span<const double> u, std::span<const double> v, std::size_t k) {
    for (std::size_t j = 0; j < known_.nodes.size(); ++j) {
      const auto& point = known_.points[k * known_.nodes.size() + j];
      const auto i = std::size_t(known_.mesh.mesh->first) + known_.nodes[j];
      e_total_ = worst(e_total_, u[i] - point.u);
      e_time_ = worst(e_time_, u[i] - point.u_mesh);
      // On a front the bar has two velocities; the nearer one counts.
      const double error = std::min(std::abs(v[i] - point.v_left), std::abs(v[i] - point.v_right));
      v_error_ += error;
      v_square_error_ += error * error;
      v_size_ += std::abs(point.v_right);
      v_square_ += point.v_right * point.v_right;
    }
  }
  // That of a run that has become NaN is NaN.
  static double worst(double a, double b) { return std::isnan(b) ? b : std::max(a, std::abs(b)); }

  const References& known_;
  std::size_t next_ = 0;
  bool begun_ = false;
  double e_total_ = 0.0, e_time_ = 0.0;
  double v_error_ = 0.0, v_size_ = 0.0, v_square_error_ = 0.0, v_square_ = 0.0;
  double energy_ = 0.0, energy_0_ = 0.0, largest_energy_ = 0.0;
};

std::vector<double> meshes_of(const PathRequest& request) {
  const auto base = cases::make(request.case_name, request.settings);
  if (!base.mesh)
    throw InputError(
        fmt::format(
            "verify --path: {} has no bars; allowed: a case whose problem is the mesh of a "
            "bar, as bar-wall. Leave --path out, or take such a case (clackers list cases).",
            request.case_name),
        "no-closed-form");
  require_within("verify", "path", request.nu, 1e-3, 100.0);
  const double coarsest = value_of(base.values, "elements");
  std::vector<double> list;
  for (int k = 0; k < request.levels * request.samples_per_level; ++k) {
    const double n = std::round(coarsest * std::exp2(double(k) / request.samples_per_level));
    if (list.empty() || n > list.back()) list.push_back(n);
  }
  if (list.size() < 3)
    refuse("verify", "levels", double(request.levels), "three meshes or more with --path");
  // Before any work what is not allowed of the finest mesh is refused.
  auto finest = request.settings;
  std::erase_if(finest, [](const auto& setting) { return setting.first == "elements"; });
  finest.emplace_back("elements", list.back());
  const auto last = cases::make(request.case_name, finest);
  const double steps = last.motion->end() * list.back() / (request.nu * shortest_transit(last)),
               dof = last.motion->dof();
  if (!(steps * dof * dof < most_work))
    refuse("verify", "steps", steps, "fewer with so many elements",
           "End the run earlier, or take "
           "fewer levels.",
           "too-many-steps");
  return list;
}

struct Columns {
  std::vector<double> h, e_total, v_l1, v_l2;
};

record::Cell order_of(const Columns& runs, const std::vector<double>& errors) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (errors[i] > 0.0) x.push_back(std::log(runs.h[i])), y.push_back(std::log(errors[i]));
  if (x.size() < 3) return {};
  // Two digits are more than scatter leaves.
  return std::round(1000.0 * numerics::fit_line(x, y).slope) / 1000.0;
}

std::string reading_of(const record::Cell& u, const record::Cell& v, const PathOrders& expected,
                       const std::string& failure) {
  constexpr double least_part = 0.75, still = 0.1;
  const double order_u = record::number_in(u), order_v = record::number_in(v);
  if (std::isnan(order_u)) return "failed: " + failure;
  if (order_u < still) return "stagnates";
  if (order_v < still) return "velocities stagnate";
  return order_u >= least_part * expected.u && order_v >= 0.6 * expected.v_l1 ? "as expected"
                                                                              : "slower";
}

std::vector<record::Column> error_columns() {
  return {{"e_total", "", "largest error of u against the bar, over the largest u"},
          {"e_time", "", "of it the integrator's: against the exact motion of the mesh"},
          {"e_space", "", "of it the mesh's: known before anything runs"},
          {"v_l1", "", "error of v over x and t, in L1"},
          {"v_l2", "", "error of v over x and t, in L2"},
          {"energy", "", "gained up to the end, over the largest kinetic energy"}};
}

}  // namespace

PathOrders expected_along_path(double smooth_order) {
  if (smooth_order < 1.5) return {1.0 / 2.0, 1.0 / 2.0, 1.0 / 4.0};
  return {2.0 / 3.0, 1.0 / 2.0, 1.0 / 3.0};
}

PathStudy follow_path(const PathRequest& request, const Progress& progress,
                      const std::atomic<bool>* interrupt) {
  std::vector<std::shared_ptr<const methods::Method>> list;
  for (const auto& name : request.methods.empty() ? methods::default_panel() : request.methods) {
    list.push_back(methods::method(name));
    if (list.back()->facts().is_adaptive)
      throw InputError(fmt::format("verify --path: {} chooses its steps; allowed: methods with a "
                                   "step in proportion to the elements. Leave it or --path out.",
                                   name),
                       "not-admissible");
  }
  const auto meshes = meshes_of(request);
  double total = 0.0;
  for (const double n : meshes) total += n * n * n;
  ProgressMeter meter(total, progress);
  const auto is_interrupted = [&] { return interrupt != nullptr && *interrupt; };

  // The finest, which lasts longest, first.
  std::vector<std::optional<References>> known(meshes.size());
  std::vector<std::vector<PathRun>> runs(meshes.size());
  run_all(meshes.size(), thread_count(request.jobs), [&](std::size_t k) {
    const auto at = meshes.size() - 1 - k;
    if (is_interrupted()) return;
    TaskShare share(meter, std::pow(meshes[at], 3));
    auto now = references(request, meshes[at]);
    std::vector<PathRun> results;
    for (const auto& method : list) {
      if (const auto objection = method->objection(now.mesh.problem)) {
        results.push_back({.failure = std::string(objection->code.name())});
        continue;
      }
      PathSink sink(now);
      TaskShare none(meter, 0.0);
      WatchedSink watched(&sink, none, 0.0, interrupt);
      const auto outcome = method->prepare(now.mesh.problem, now.step)->advance(watched);
      if (outcome.stopped_by_sink) return;
      results.push_back(sink.result(outcome));
    }
    runs[at] = std::move(results);
    known[at] = std::move(now);
  });

  PathStudy study;
  study.interrupted = is_interrupted();
  const auto nu = fmt::format("step = {:g} h/c", request.nu);
  record::Sheet orders{
      "clackers/path/1",
      fmt::format("{} along the path {}, {:g} to {:g} elements{}", request.case_name, nu,
                  meshes.front(), meshes.back(),
                  request.nu == 1.0 ? ": the characteristic step, no ranking" : ""),
      {{"method", "", "under test"},
       {"u", "", "order in h of the largest error of u, over all meshes"},
       {"v_l1", "", "order of v in L1 over x and t"},
       {"v_l2", "", "order of v in L2 over x and t"},
       {"expected", "", "orders of u, v in L1 and v in L2 of such data"},
       {"reading", "", "of these orders, or why there are none"}},
      {}};
  record::Sheet finest{
      "clackers/path-errors/1", "Errors of the finest mesh", {{"method", "", "under test"}}, {}};
  record::Sheet curves{"clackers/path-curves/1",
                       "Largest error of u against the bar",
                       {{"h", "m", "length of an element"}, {"e_space", "", "error of the mesh"}},
                       {},
                       record::Axes{.log_x = true, .log_y = true, .y = "error of u"}};
  record::Sheet all{"clackers/path-runs/1",
                    "All runs",
                    {{"method", "", "under test"},
                     {"elements", "", "of the mesh"},
                     {"h", "m", "length of an element"},
                     {"step", "s", "of the integrator"}},
                    {}};
  for (const auto& now : known)
    if (now) curves.rows.push_back({now->h, now->e_space});
  for (auto* sheet : {&finest, &all})
    for (auto& column : error_columns()) sheet->columns.push_back(std::move(column));
  all.columns.push_back({"failure", "", "why a run has no errors"});
  for (std::size_t m = 0; m < list.size(); ++m) {
    const auto facts = list[m]->facts();
    const auto name = methods::short_name(facts.name);
    Columns columns;
    std::vector<record::Cell> last;
    std::string failure;
    curves.columns.push_back({name, "", "error of " + name});
    for (std::size_t k = 0, point = 0; k < meshes.size(); ++k) {
      if (!known[k]) continue;
      const auto& run = runs[k][m];
      std::vector<record::Cell> cells{run.e_total, run.e_time, known[k]->e_space,
                                      run.v_l1,    run.v_l2,   run.energy};
      if (!run.failure.empty()) cells = std::vector<record::Cell>(cells.size());
      std::vector<record::Cell> row{name, static_cast<long long>(meshes[k]), known[k]->h,
                                    known[k]->step};
      row.insert(row.end(), cells.begin(), cells.end());
      row.push_back(run.failure);
      all.rows.push_back(std::move(row));
      curves.rows[point++].push_back(cells.front());
      if (!run.failure.empty()) {
        failure = run.failure;
        continue;
      }
      columns.h.push_back(known[k]->h);
      columns.e_total.push_back(run.e_total);
      columns.v_l1.push_back(run.v_l1);
      columns.v_l2.push_back(run.v_l2);
      last = std::move(cells);
    }
    const auto expected = expected_along_path(facts.smooth_order);
    const auto u = order_of(columns, columns.e_total), v1 = order_of(columns, columns.v_l1),
               v2 = order_of(columns, columns.v_l2);
    orders.rows.push_back({name, u, v1, v2,
                           std::string(facts.smooth_order < 1.5 ? "1/2 1/2 1/4" : "2/3 1/2 1/3"),
                           reading_of(u, v1, expected, failure)});
    if (last.empty()) continue;
    last.insert(last.begin(), name);
    finest.rows.push_back(std::move(last));
  }
  study.sheets = {std::move(orders), std::move(finest), std::move(curves)};
  study.runs = std::move(all);
  return study;
}

}  // namespace clackers::study
