#include "clackers/study/path/path_sheets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "clackers/numerics/line_fit.hpp"

namespace clackers::study {
namespace {

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
  return {{"e_total", "", "largest error of u against the body, over the largest u"},
          {"e_time", "",
           "of it the integrator's: against the exact motion of the mesh, where that is known"},
          {"e_space", "",
           "of it the mesh's, over the largest u (show: in m): known before anything runs"},
          {"v_l1", "", "error of v over x and t, in L1"},
          {"v_l2", "", "error of v over x and t, in L2"},
          {"energy", "", "gained up to the end, over the largest kinetic one of the body"}};
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

}  // namespace

PathOrders expected_along_path(double smooth_order) {
  if (smooth_order < 1.5) return {1.0 / 2.0, 1.0 / 2.0, 1.0 / 4.0, "1/2 1/2 1/4"};
  return {2.0 / 3.0, 1.0 / 2.0, 1.0 / 3.0, "2/3 1/2 1/3"};
}

PathStudy path_study(const PathRequest& request, const std::vector<Judged>& list,
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
      fmt::format("Largest error of u against the body, step = {:g} h/c", request.nu.front()),
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

}  // namespace clackers::study
