#include "clackers/report/figure_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/report/runs.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

// Six digits are finer than any screen.
double rounded(double value) {
  return std::isfinite(value) ? std::stod(fmt::format("{:.6g}", value)) : value;
}

Json rounded(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(rounded(value));
  return out;
}

Json cell(const study::Cell& value) {
  return std::visit(
      [](const auto& x) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(x)>, std::monostate>)
          return nullptr;
        else
          return x;
      },
      value);
}

Json response(const study::Curve& whole) {
  const auto curve = reduced(whole);
  Json out = Json::array();
  for (std::size_t mass = 0; mass < curve.y.size(); ++mass)
    out.push_back({{"series", fmt::format("mass {}", mass + 1)},
                   {"t", rounded(curve.t)},
                   {"u", rounded(curve.y[mass])}});
  return out;
}

Json collisions(const study::CaseSummary& problem) {
  Json out = Json::array();
  for (std::size_t k = 0; k < problem.impact_times.size(); ++k)
    out.push_back(
        {{"series", "collisions"}, {"k", k + 1}, {"t", rounded(problem.impact_times[k])}});
  return out;
}

Json all_runs(const study::Record& record) {
  const auto sheet = runs(record);
  Json columns = Json::array(), rows = Json::array();
  for (const auto& column : sheet.columns) columns.push_back(column.name);
  for (const auto& row : sheet.rows) {
    Json cells = Json::array();
    for (const auto& value : row) cells.push_back(cell(value));
    rows.push_back(std::move(cells));
  }
  return {{"columns", columns}, {"rows", rows}};
}

// Of each level the run with the largest error: the upper envelope, with what that run cost.
Json levels(const study::Record& record) {
  Json out = Json::array();
  for (const auto& method : record.methods)
    for (std::size_t level = 0; level < method.ladder.size(); ++level) {
      const assess::RunScore* worst = nullptr;
      for (const auto& run : method.ladder[level].runs)
        if (run.finished && (worst == nullptr || run.u_error > worst->u_error)) worst = &run;
      if (worst == nullptr) continue;
      out.push_back({{"method", method.name},
                     {"level", level + 1},
                     {"step", worst->step},
                     {"steps_per_fast_period", rounded(record.problem.fast_period / worst->step)},
                     {"u_error", worst->u_error},
                     {"force_evaluations", worst->work.force_evaluations},
                     {"seconds", worst->seconds}});
    }
  return out;
}

// Triangles whose third side climbs with order 1, 2 and 4, in the lower right corner, where a
// convergence plot is empty. The highest takes at most a third of the height.
Json slopes(const study::Record& record) {
  double step = 0.0, lowest = INFINITY, highest = 0.0;
  for (const auto& method : record.methods)
    for (const auto& level : method.ladder)
      for (const auto& run : level.runs)
        if (run.finished && run.u_error > 0.0 && std::isfinite(run.u_error)) {
          step = std::max(step, run.step);
          lowest = std::min(lowest, run.u_error);
          highest = std::max(highest, run.u_error);
        }
  Json out = Json::array();
  if (!(step > 0.0)) return out;
  const double decades = std::max(std::log10(highest / lowest), 1.0);
  const double base = std::min(8.0, std::pow(10.0, decades / 3.0 / 4.0));
  for (const int order : std::array{1, 2, 4}) {
    const double left = step / base, top = lowest * std::pow(base, order);
    // The base is the same for all three, so it is drawn once.
    const bool whole = order == 4;
    const Json steps = whole ? Json{step, left, step, step} : Json{left, step};
    const Json errors = whole ? Json{lowest, lowest, top, lowest} : Json{lowest, top};
    out.push_back({{"order", fmt::format("{}", order)},
                   {"step", steps},
                   {"u_error", errors},
                   {"corner", whole ? Json{0, 1, 2, 3} : Json{1, 2}}});
  }
  return out;
}

Json history(const study::Record& record) {
  Json out = Json::array();
  for (const auto& method : record.methods) {
    const auto curve = reduced(method.error_history);
    for (std::size_t mass = 0; mass < curve.y.size(); ++mass)
      out.push_back({{"method", method.name},
                     {"mass", mass + 1},
                     {"step", rounded(method.history_step)},
                     {"t", rounded(curve.t)},
                     {"error", rounded(curve.y[mass])}});
  }
  return out;
}

}  // namespace

study::Curve reduced(const study::Curve& curve, std::size_t most) {
  const auto n = curve.t.size();
  if (n <= most) return curve;
  // Each stretch gives the lowest and the highest point of every row, in order of time.
  const auto kept_per_stretch = 2 * std::max<std::size_t>(curve.y.size(), 1);
  const auto stretches = std::max<std::size_t>(most / kept_per_stretch, 1);
  std::vector<std::size_t> kept;
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto from = n * s / stretches, to = n * (s + 1) / stretches;
    for (const auto& y : curve.y) {
      const auto [lo, hi] =
          std::minmax_element(y.begin() + std::ptrdiff_t(from), y.begin() + std::ptrdiff_t(to));
      kept.push_back(std::size_t(lo - y.begin()));
      kept.push_back(std::size_t(hi - y.begin()));
    }
  }
  std::ranges::sort(kept);
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  study::Curve out;
  out.y.resize(curve.y.size());
  for (const auto i : kept) {
    out.t.push_back(curve.t[i]);
    for (std::size_t row = 0; row < curve.y.size(); ++row) out.y[row].push_back(curve.y[row][i]);
  }
  return out;
}

nlohmann::ordered_json figure_data(const study::Record& record) {
  return {{"response", response(record.response)},
          {"collisions", collisions(record.problem)},
          {"runs", all_runs(record)},
          {"levels", levels(record)},
          {"slopes", slopes(record)},
          {"history", history(record)}};
}

}  // namespace clackers::report
