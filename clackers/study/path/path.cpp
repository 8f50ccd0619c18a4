#include "clackers/study/path/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/study/method_candidate.hpp"
#include "clackers/study/path/path_sheets.hpp"
#include "clackers/study/run_sinks.hpp"

namespace clackers::study {
namespace {

constexpr double most_work = 1e12;  // steps times squared degrees of freedom

// Before any work what is not allowed of the finest mesh is refused.
cases::Case finest_of(const PathRequest& request, const std::vector<double>& meshes) {
  try {
    return cases::make_mesh(request.case_name, with_elements(request.settings, meshes.back()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} It is the finest of the {} meshes of --path: start with fewer "
                                 "elements, or take fewer --levels.",
                                 error.what(), meshes.size()),
                     error.code());
  }
}

std::vector<double> meshes_of(const PathRequest& request) {
  const auto base = cases::make_mesh(request.case_name, request.settings);
  if (request.nu.empty()) refuse("verify", "path", 0.0, "one number or more");
  for (const double nu : request.nu) {
    require_within("verify", "path", nu, 1e-3, 100.0);
    if (std::ranges::count(request.nu, nu) > 1)
      refuse("verify", "path", nu, "each number once", {}, "bad-syntax");
  }
  const double coarsest = value_of(base.values, "elements");
  std::vector<double> list;
  for (int k = 0; k < request.levels * request.samples_per_level; ++k) {
    const double n = std::round(coarsest * std::exp2(double(k) / request.samples_per_level));
    if (list.empty() || n > list.back()) list.push_back(n);
  }
  if (list.size() < 3)
    refuse("verify", "levels", double(request.levels), "three meshes or more with --path");
  const auto finest = finest_of(request, list);
  const double steps = steps_along_path(finest, list.back(), std::ranges::min(request.nu)),
               dof = double(finest.problem.dof());
  if (!(steps * dof * dof < most_work))
    refuse("verify", "steps", steps, "fewer with so many elements",
           "End the run earlier, or take fewer levels.", "too-many-steps");
  return list;
}

using Methods = std::vector<std::shared_ptr<const methods::Method>>;

void require_step_in_proportion(const std::string& name, bool is_adaptive) {
  if (is_adaptive)
    throw InputError(fmt::format("verify --path: {} chooses its steps; allowed: methods with a "
                                 "step in proportion to the elements. Leave it or --path out.",
                                 name),
                     "not-admissible");
}

Methods methods_of(const PathRequest& request) {
  Methods list;
  const bool is_default = request.methods.empty() && request.solvers.empty();
  for (const auto& name : is_default ? methods::default_panel() : request.methods) {
    list.push_back(methods::method(name));
    require_step_in_proportion(name, list.back()->facts().is_adaptive);
  }
  for (const auto& solver : request.solvers)
    require_step_in_proportion(solver.name, !solver.tolerances.empty());
  return list;
}

std::vector<Judged> all_of(const PathRequest& request, const Methods& list) {
  constexpr double usual = 2.0;  // of a solver that claims none
  std::vector<Judged> all;
  for (const auto& method : list) {
    const auto facts = method->facts();
    all.push_back({methods::short_name(facts.name), facts.smooth_order});
  }
  for (const auto& solver : request.solvers)
    all.push_back({solver.name, solver.claim.order > 0.0 ? solver.claim.order : usual});
  return all;
}

// With its exact motion where that can be.
cases::Case best_known(std::string_view name, const cases::Settings& settings, double elements) {
  auto mesh = cases::make_mesh(name, settings);
  if (elements > mesh.most_exact_elements) return mesh;
  try {
    return cases::make(name, settings);
  } catch (const InputError&) {
    return mesh;  // an impact or a release of its contact is not certain
  }
}

// Nothing when interrupted.
std::optional<MeshRuns> run_mesh(const PathRequest& request, const Methods& list, double nu,
                                 double elements, TaskShare& share,
                                 const std::atomic<bool>* interrupt) {
  const auto known = mesh_reference(
      best_known(request.case_name, with_elements(request.settings, elements), elements), elements,
      nu);
  const auto& problem = known.mesh.problem;
  MeshRuns runs{nu, elements, known.h, known.step, known.e_space, {}};
  for (const auto& method : list) {
    if (const auto objection = method->objection(problem)) {
      runs.errors.emplace_back().failure =
          fmt::format("{} [{}]", objection_text(*method, *objection), objection->code.name());
      continue;
    }
    MeshSink sink(known);
    WatchedSink watched(&sink, share, 0.0, interrupt);
    const auto outcome = method->prepare(problem, known.step)->advance(watched);
    if (outcome.stopped_by_sink) return {};
    runs.errors.push_back(sink.errors(outcome));
  }
  for (const auto& solver : request.solvers) {
    auto errors = errors_of(solver, known, interrupt);
    if (!errors) return {};
    runs.errors.push_back(std::move(*errors));
  }
  return runs;
}

}  // namespace

PathStudy follow_path(const PathRequest& request, const Progress& progress,
                      const std::atomic<bool>* interrupt) {
  const auto list = methods_of(request);
  const auto meshes = meshes_of(request);
  double total = 0.0;
  for (const double n : meshes) total += n * n * n * double(request.nu.size());
  ProgressMeter meter(total, progress);

  // The finest, which lasts longest, first.
  std::vector<std::optional<MeshRuns>> runs(meshes.size() * request.nu.size());
  run_all(runs.size(), thread_count(request.jobs), [&](std::size_t k) {
    const auto at = runs.size() - 1 - k, mesh = at / request.nu.size();
    if (interrupt != nullptr && *interrupt) return;
    TaskShare share(meter, std::pow(meshes[mesh], 3));
    runs[at] =
        run_mesh(request, list, request.nu[at % request.nu.size()], meshes[mesh], share, interrupt);
  });
  std::vector<MeshRuns> finished;
  for (auto& run : runs)
    if (run) finished.push_back(std::move(*run));
  auto study = path_study(request, all_of(request, list), finished);
  study.interrupted = finished.size() < runs.size();
  return study;
}

}  // namespace clackers::study
