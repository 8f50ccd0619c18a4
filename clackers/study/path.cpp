#include "clackers/study/path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/jobs/work_queue.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/numerics/line_fit.hpp"
#include "clackers/study/method_candidate.hpp"
#include "clackers/study/path/mesh_run.hpp"
#include "clackers/study/run_sinks.hpp"

namespace clackers::study {
namespace {

constexpr double most_work = 1e12;  // steps times squared degrees of freedom

std::vector<double> meshes_of(const PathRequest& request) {
  const auto base = cases::make_mesh(request.case_name, request.settings);
  if (request.nu.empty()) refuse("verify", "path", 0.0, "one number or more");
  for (const double nu : request.nu) require_within("verify", "path", nu, 1e-3, 100.0);
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
  const double steps = steps_along_path(finest, list.back(), std::ranges::min(request.nu)),
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

// An order and the half width of its 95 % interval; NaN where there are too few errors.
struct Order {
  double slope = std::nan(""), spread = std::nan("");
  bool is_below(double bound) const { return slope + spread < bound; }
  bool is_beyond(double bound) const { return slope - spread >= bound; }
  // Three digits are more than scatter leaves.
  record::Cell cell() const { return record::cell_of(std::round(1000.0 * slope) / 1000.0); }
};

Order order_of(const std::vector<double>& h, const std::vector<double>& errors) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (errors[i] > 0.0) x.push_back(std::log(h[i])), y.push_back(std::log(errors[i]));
  if (x.size() < 3) return {};
  const auto fit = numerics::fit_line(x, y);
  return {fit.slope, fit.slope_spread};
}

// Only what the intervals prove.
std::string reading_of(const Order& u, const Order& v_l1, const PathOrders& expected,
                       const std::string& failure) {
  constexpr double still = 0.1;
  const double least_u = 0.75 * expected.u, least_v = 0.6 * expected.v_l1;
  if (std::isnan(u.slope)) return "failed: " + failure;
  if (u.is_below(-still)) return "diverges";
  if (u.is_below(still)) return "stagnates";
  if (v_l1.is_below(still)) return "velocities stagnate";
  if (u.is_below(least_u) || v_l1.is_below(least_v)) return "slower";
  const auto open = [](const char* name, const Order& order, double least) {
    return fmt::format("undecided: {} {:.2f} ± {:.2f}, {:.2f} wanted", name, order.slope,
                       order.spread, least);
  };
  if (!u.is_beyond(least_u)) return open("u", u, least_u);
  return v_l1.is_beyond(least_v) ? "as expected" : open("v_l1", v_l1, least_v);
}

std::vector<record::Column> error_columns() {
  return {{"e_total", "", "largest error of u against the bar, over the largest u"},
          {"e_time", "",
           "of it the integrator's: against the exact motion of the mesh, where that is known"},
          {"e_space", "",
           "of it the mesh's, over the largest u (show: in m): known before anything runs"},
          {"v_l1", "", "error of v over x and t, in L1"},
          {"v_l2", "", "error of v over x and t, in L2"},
          {"energy", "", "gained up to the end, over the largest kinetic one of the bar"}};
}

}  // namespace

PathOrders expected_along_path(double smooth_order) {
  if (smooth_order < 1.5) return {1.0 / 2.0, 1.0 / 2.0, 1.0 / 4.0, "1/2 1/2 1/4"};
  return {2.0 / 3.0, 1.0 / 2.0, 1.0 / 3.0, "2/3 1/2 1/3"};
}

namespace {

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

// What the rows of the sheets are of, methods before solvers.
struct Judged {
  std::string name;
  double smooth_order = 0.0;
};

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

// A mesh that was run with the step of one path, with the errors of all methods.
struct MeshRuns {
  double nu = 0.0, elements = 0.0, h = 0.0, step = 0.0, e_space = 0.0;
  std::vector<MeshErrors> errors;
};

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

// A table of a method: of each mesh e_time of all steps and the step at which it equals e_space, on
// logarithms a line between two steps. Nothing where the steps do not enclose it.
record::Sheet crossings_of(const std::vector<double>& paths, const std::string& name,
                           std::size_t method, const std::vector<MeshRuns>& meshes) {
  record::Sheet sheet{"clackers/path-crossings/1",
                      name + ": error in time of each step beside that of the mesh",
                      {{"elements", "", "of the mesh"},
                       {"h", "m", "length of an element"},
                       {"e_space", "", "error of the mesh, over the largest u"}},
                      {}};
  for (const double nu : paths)
    sheet.columns.push_back({fmt::format("{:g} h/c", nu), "", "e_time with this step"});
  sheet.columns.push_back({"crossing", "s",
                           "step at which both are equal: a finer one is wasted on this mesh; "
                           "empty where these steps do not enclose it"});
  std::map<double, std::vector<const MeshRuns*>> by_elements;
  for (const auto& mesh : meshes) by_elements[mesh.elements].push_back(&mesh);
  for (auto& [elements, runs] : by_elements) {
    // A finer step is compared at more times.
    double e_space = runs.front()->e_space;
    for (const auto* run : runs) e_space = std::max(e_space, run->e_space);
    if (std::isnan(e_space) || runs.size() < paths.size()) continue;
    std::vector<record::Cell> row{static_cast<long long>(elements), runs.front()->h, e_space};
    const auto e_time = [&](const MeshRuns* run) {
      const auto& errors = run->errors[method];
      return errors.failure.empty() ? errors.e_time : std::nan("");
    };
    for (const auto* run : runs) row.push_back(record::cell_of(e_time(run)));
    std::ranges::sort(runs, {}, &MeshRuns::step);
    double crossing = std::nan("");
    for (std::size_t k = 1; k < runs.size(); ++k) {
      const auto &fine = *runs[k - 1], &coarse = *runs[k];
      const double below = std::log(e_time(&fine) / e_space),
                   above = std::log(e_time(&coarse) / e_space);
      if (below <= 0.0 && above > 0.0)
        crossing = fine.step * std::pow(coarse.step / fine.step, below / (below - above));
    }
    row.push_back(record::cell_of(crossing));
    sheet.rows.push_back(std::move(row));
  }
  return sheet;
}

PathStudy study_of(const PathRequest& request, const std::vector<Judged>& list,
                   const std::vector<MeshRuns>& meshes) {
  const bool several = request.nu.size() > 1;
  constexpr std::size_t most_curves = 8;  // beside that of the mesh
  record::Sheet orders{
      "clackers/path/1",
      fmt::format("{} along the path step = {:g} h/c, {:g} to {:g} elements{}", request.case_name,
                  fmt::join(request.nu, ", "), meshes.empty() ? 0.0 : meshes.front().elements,
                  meshes.empty() ? 0.0 : meshes.back().elements,
                  std::ranges::count(request.nu, 1.0) > 0
                      ? ": 1 is the characteristic step, no ranking"
                      : ""),
      {{"method", "", "under test"},
       {"nu", "", "c step/h"},
       {"u", "", "order in h of the largest error of u, over all meshes"},
       {"v_l1", "", "order of v in L1 over x and t"},
       {"v_l2", "", "order of v in L2 over x and t"},
       {"expected", "", "orders of u, v in L1 and v in L2 of such data"},
       {"reading", "", "of these orders, or why there are none"}},
      {}};
  record::Sheet finest{"clackers/path-errors/1",
                       "Errors of the finest mesh",
                       {{"method", "", "under test"}, {"nu", "", "c step/h"}},
                       {}};
  record::Sheet curves{
      "clackers/path-curves/1",
      fmt::format("Largest error of u against the bar, step = {:g} h/c", request.nu.front()),
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
  for (auto* sheet : {&finest, &all})
    for (auto& column : error_columns()) sheet->columns.push_back(std::move(column));
  all.columns.push_back({"failure", "", "why a run has no errors"});
  std::map<double, std::size_t> curve_row;  // by elements
  for (const auto& mesh : meshes)
    if (curve_row.emplace(mesh.elements, curve_row.size()).second)
      curves.rows.push_back({mesh.h, record::cell_of(mesh.e_space)});
  PathStudy study;
  for (std::size_t m = 0; m < list.size(); ++m) {
    const auto& [name, smooth_order] = list[m];
    const auto expected = expected_along_path(smooth_order);
    for (const double nu : request.nu) {
      Ladder ladder;
      const bool is_drawn = nu == request.nu.front() && m < most_curves;
      if (is_drawn) curves.columns.push_back({name, "", "error of " + name});
      if (is_drawn)
        for (auto& row : curves.rows) row.emplace_back();
      for (const auto& mesh : meshes) {
        if (mesh.nu != nu) continue;
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
        if (is_drawn) curves.rows[curve_row[mesh.elements]].back() = cells.front();
        cells.insert(cells.begin(),
                     {name, static_cast<long long>(mesh.elements), mesh.h, mesh.step});
        cells.push_back(failure);
        all.rows.push_back(std::move(cells));
      }
      const auto u = order_of(ladder.h, ladder.e_total), v1 = order_of(ladder.h, ladder.v_l1),
                 v2 = order_of(ladder.h, ladder.v_l2);
      orders.rows.push_back({name, nu, u.cell(), v1.cell(), v2.cell(), std::string(expected.text),
                             reading_of(u, v1, expected, ladder.failure)});
      if (ladder.finest.empty()) continue;
      ladder.finest.insert(ladder.finest.begin(), {name, nu});
      finest.rows.push_back(std::move(ladder.finest));
    }
    if (several) study.sheets.push_back(crossings_of(request.nu, name, m, meshes));
  }
  // A curve without points is none, and one path needs no column.
  record::drop_columns(curves, [&](std::size_t j) {
    return std::ranges::all_of(
        curves.rows, [&](const auto& row) { return std::isnan(record::number_in(row[j])); });
  });
  for (auto* sheet : {&orders, &finest})
    if (!several) record::drop_columns(*sheet, [](std::size_t j) { return j == 1; });
  study.failed = finest.rows.empty();
  if (study.failed)
    study.sheets = {std::move(orders)};
  else
    study.sheets.insert(study.sheets.begin(),
                        {std::move(orders), std::move(finest), std::move(curves)});
  study.runs = std::move(all);
  return study;
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
  auto study = study_of(request, all_of(request, list), finished);
  study.interrupted = finished.size() < runs.size();
  return study;
}

}  // namespace clackers::study
