#include "clackers/study/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/numerics/line_fit.hpp"
#include "clackers/study/path/mesh_run.hpp"
#include "clackers/study/run_sinks.hpp"

namespace clackers::study {
namespace {

constexpr double most_work = 1e12;  // steps times squared degrees of freedom

std::vector<double> meshes_of(const PathRequest& request) {
  const auto base = cases::make_mesh(request.case_name, request.settings);
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
  const auto finest =
      cases::make_mesh(request.case_name, with_elements(request.settings, list.back()));
  const double steps = steps_along_path(finest, list.back(), request.nu),
               dof = double(finest.problem.dof());
  if (!(steps * dof * dof < most_work))
    refuse("verify", "steps", steps, "fewer with so many elements",
           "End the run earlier, or take fewer levels.", "too-many-steps");
  return list;
}

// Of runs over meshes, and of their finest that did not fail.
struct Ladder {
  std::vector<double> h, e_total, v_l1, v_l2;
  std::vector<record::Cell> finest;
  std::string failure;
};

record::Cell order_of(const std::vector<double>& h, const std::vector<double>& errors) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (errors[i] > 0.0) x.push_back(std::log(h[i])), y.push_back(std::log(errors[i]));
  if (x.size() < 3) return {};
  // Two digits are more than scatter leaves.
  return std::round(1000.0 * numerics::fit_line(x, y).slope) / 1000.0;
}

std::string reading_of(double u, double v_l1, const PathOrders& expected,
                       const std::string& failure) {
  constexpr double still = 0.1, part_of_u = 0.75, part_of_v = 0.6;
  if (std::isnan(u)) return "failed: " + failure;
  if (u < still) return "stagnates";
  if (v_l1 < still) return "velocities stagnate";
  return u >= part_of_u * expected.u && v_l1 >= part_of_v * expected.v_l1 ? "as expected"
                                                                          : "slower";
}

std::vector<record::Column> error_columns() {
  return {{"e_total", "", "largest error of u against the bar, over the largest u"},
          {"e_time", "",
           "of it the integrator's: against the exact motion of a mesh of 200 elements or fewer"},
          {"e_space", "", "of it the mesh's: known before anything runs"},
          {"v_l1", "", "error of v over x and t, in L1"},
          {"v_l2", "", "error of v over x and t, in L2"},
          {"energy", "", "gained up to the end, over the largest kinetic energy"}};
}

}  // namespace

PathOrders expected_along_path(double smooth_order) {
  if (smooth_order < 1.5) return {1.0 / 2.0, 1.0 / 2.0, 1.0 / 4.0, "1/2 1/2 1/4"};
  return {2.0 / 3.0, 1.0 / 2.0, 1.0 / 3.0, "2/3 1/2 1/3"};
}

namespace {

using Methods = std::vector<std::shared_ptr<const methods::Method>>;

Methods methods_of(const PathRequest& request) {
  Methods list;
  for (const auto& name : request.methods.empty() ? methods::default_panel() : request.methods) {
    list.push_back(methods::method(name));
    if (list.back()->facts().is_adaptive)
      throw InputError(fmt::format("verify --path: {} chooses its steps; allowed: methods with a "
                                   "step in proportion to the elements. Leave it or --path out.",
                                   name),
                       "not-admissible");
  }
  return list;
}

// A mesh that was run, with the errors of all methods.
struct MeshRuns {
  double elements = 0.0, h = 0.0, step = 0.0, e_space = 0.0;
  std::vector<MeshErrors> errors;
};

// Nothing when interrupted.
std::optional<MeshRuns> run_mesh(const PathRequest& request, const Methods& list, double elements,
                                 TaskShare& share, const std::atomic<bool>* interrupt) {
  const auto settings = with_elements(request.settings, elements);
  const auto known = mesh_reference(elements > cases::most_exact_elements
                                        ? cases::make_mesh(request.case_name, settings)
                                        : cases::make(request.case_name, settings),
                                    elements, request.nu);
  const auto& problem = known.mesh.problem;
  MeshRuns runs{elements, known.h, known.step, known.e_space, {}};
  for (const auto& method : list) {
    if (const auto objection = method->objection(problem)) {
      runs.errors.emplace_back().failure = objection->code.name();
      continue;
    }
    MeshSink sink(known);
    WatchedSink watched(&sink, share, 0.0, interrupt);
    const auto outcome = method->prepare(problem, known.step)->advance(watched);
    if (outcome.stopped_by_sink) return {};
    runs.errors.push_back(sink.errors(outcome));
  }
  return runs;
}

PathStudy study_of(const PathRequest& request, const Methods& list,
                   const std::vector<MeshRuns>& meshes) {
  record::Sheet orders{
      "clackers/path/1",
      fmt::format("{} along the path step = {:g} h/c, {:g} to {:g} elements{}", request.case_name,
                  request.nu, meshes.empty() ? 0.0 : meshes.front().elements,
                  meshes.empty() ? 0.0 : meshes.back().elements,
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
  for (const auto& mesh : meshes) curves.rows.push_back({mesh.h, record::cell_of(mesh.e_space)});
  for (auto* sheet : {&finest, &all})
    for (auto& column : error_columns()) sheet->columns.push_back(std::move(column));
  all.columns.push_back({"failure", "", "why a run has no errors"});
  for (std::size_t m = 0; m < list.size(); ++m) {
    const auto facts = list[m]->facts();
    const auto name = methods::short_name(facts.name);
    Ladder ladder;
    curves.columns.push_back({name, "", "error of " + name});
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      const auto& mesh = meshes[k];
      const auto& [e_total, e_time, v_l1, v_l2, energy, failure] = mesh.errors[m];
      std::vector<record::Cell> cells{
          e_total, record::cell_of(e_time), record::cell_of(mesh.e_space), v_l1, v_l2, energy};
      if (failure.empty()) {
        ladder.h.push_back(mesh.h);
        ladder.e_total.push_back(e_total);
        ladder.v_l1.push_back(v_l1);
        ladder.v_l2.push_back(v_l2);
        ladder.finest = cells;
      } else {
        ladder.failure = failure;
        cells.assign(cells.size(), {});
      }
      curves.rows[k].push_back(cells.front());
      cells.insert(cells.begin(), {name, static_cast<long long>(mesh.elements), mesh.h, mesh.step});
      cells.push_back(failure);
      all.rows.push_back(std::move(cells));
    }
    const auto expected = expected_along_path(facts.smooth_order);
    const auto u = order_of(ladder.h, ladder.e_total), v1 = order_of(ladder.h, ladder.v_l1),
               v2 = order_of(ladder.h, ladder.v_l2);
    orders.rows.push_back(
        {name, u, v1, v2, std::string(expected.text),
         reading_of(record::number_in(u), record::number_in(v1), expected, ladder.failure)});
    if (ladder.finest.empty()) continue;
    ladder.finest.insert(ladder.finest.begin(), name);
    finest.rows.push_back(std::move(ladder.finest));
  }
  // A curve without points is none.
  record::drop_columns(curves, [&](std::size_t j) {
    return std::ranges::all_of(
        curves.rows, [&](const auto& row) { return std::isnan(record::number_in(row[j])); });
  });
  return {{std::move(orders), std::move(finest), std::move(curves)}, std::move(all), false};
}

}  // namespace

PathStudy follow_path(const PathRequest& request, const Progress& progress,
                      const std::atomic<bool>* interrupt) {
  const auto list = methods_of(request);
  const auto meshes = meshes_of(request);
  double total = 0.0;
  for (const double n : meshes) total += n * n * n;
  ProgressMeter meter(total, progress);

  // The finest, which lasts longest, first.
  std::vector<std::optional<MeshRuns>> runs(meshes.size());
  run_all(meshes.size(), thread_count(request.jobs), [&](std::size_t k) {
    const auto at = meshes.size() - 1 - k;
    if (interrupt != nullptr && *interrupt) return;
    TaskShare share(meter, std::pow(meshes[at], 3));
    runs[at] = run_mesh(request, list, meshes[at], share, interrupt);
  });
  std::vector<MeshRuns> finished;
  for (auto& run : runs)
    if (run) finished.push_back(std::move(*run));
  auto study = study_of(request, list, finished);
  study.interrupted = finished.size() < runs.size();
  return study;
}

}  // namespace clackers::study
