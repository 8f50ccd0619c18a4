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
                     {"steps", worst->work.steps},
                     {"force_evaluations", worst->work.force_evaluations},
                     {"factorizations", worst->work.factorizations},
                     {"newton_iterations", worst->work.newton_iterations},
                     {"event_searches", worst->work.event_searches},
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

bool is_refused(const study::Record& record, const std::string& name) {
  const auto method = std::ranges::find(record.methods, name, &study::MethodResult::name);
  return method != record.methods.end() && !method->refusal.empty();
}

// Lines from ratio 1 to a common end, so that the height at which a line stays can be seen.
Json profile(const study::Record& record) {
  Json out = Json::array();
  for (const auto& profile : record.profiles) {
    double end = 2.0;
    for (const auto& method : profile.methods)
      if (!method.steps.empty()) end = std::max(end, 1.25 * method.steps.back().ratio);
    for (const auto& method : profile.methods) {
      std::vector<assess::ProfileStep> line;
      if (method.steps.empty() || method.steps.front().ratio > 1.0) line.push_back({1.0, 0.0});
      line.insert(line.end(), method.steps.begin(), method.steps.end());
      line.push_back({end, line.back().share});
      Json ratio = Json::array(), share = Json::array(), solved = Json::array();
      for (const auto& step : line) {
        ratio.push_back(step.ratio);
        share.push_back(step.share);
        solved.push_back(std::llround(step.share * double(profile.tasks.size())));
      }
      // A method that never ran has no entry in the legend; the text beside the figure names it.
      if (is_refused(record, method.method)) continue;
      out.push_back({{"counter", profile.counter},
                     {"method", method.method},
                     {"failed", method.failed},
                     {"ratio", ratio},
                     {"share", share},
                     {"solved", solved}});
    }
  }
  return out;
}

}  // namespace

nlohmann::ordered_json figure_data(const study::Record& record) {
  return {{"response", response(record.response)},
          {"collisions", collisions(record.problem)},
          {"runs", all_runs(record)},
          {"levels", levels(record)},
          {"slopes", slopes(record)},
          {"history", history(record)},
          {"profile", profile(record)}};
}

}  // namespace clackers::report
