#include "clackers/report/html/figure_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/base/number.hpp"
#include "clackers/judge/cost/work_precision.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/report/columns.hpp"
#include "clackers/report/html/figures.hpp"
#include "clackers/report/words/words.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

Json cell(const record::Cell& value) {
  return std::visit(
      [](const auto& x) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(x)>, std::monostate>)
          return nullptr;
        else
          return x;
      },
      value);
}

bool is_drawable(const measure::RunScore& score) {
  return score.finished && score.u_error > 0.0 && std::isfinite(score.u_error);
}

void for_each_run(const record::CaseRecord& problem, const auto& use) {
  for (const auto& subject : problem.subjects)
    for (const auto& level : subject.levels)
      for (const auto& run : level.runs) use(run.score);
}

// The masses and points of a figure.
record::Curve drawn(record::Curve whole) {
  whole.y.resize(std::min(whole.y.size(), most_drawn_masses));
  return record::reduced(whole);
}

Json displacements(const record::Curve& whole) {
  const auto curve = drawn(whole);
  Json out = Json::array();
  for (std::size_t mass = 0; mass < curve.y.size(); ++mass)
    out.push_back({{"series", fmt::format("mass {}", mass + 1)},
                   {"t", rounded_list(curve.t)},
                   {"u", rounded_list(curve.y[mass])}});
  return out;
}

Json impacts(const record::CaseSummary& problem) {
  Json out = Json::array();
  for (std::size_t k = 0; k < problem.impact_times.size(); ++k)
    out.push_back({{"series", "impacts"}, {"k", k + 1}, {"t", rounded(problem.impact_times[k])}});
  return out;
}

Json all_runs(const record::CaseRecord& problem) {
  const auto sheet = run_sheet({&problem, 1}, false);
  Json columns = Json::array(), rows = Json::array();
  for (const auto& column : sheet.columns) columns.push_back(column.name);
  for (const auto& row : sheet.rows) {
    Json cells = Json::array();
    for (const auto& value : row) cells.push_back(cell(value));
    rows.push_back(std::move(cells));
  }
  // A run of a program has its name, not the place where its file was kept.
  const auto file = std::size_t(std::ranges::find(sheet.columns, "file", &record::Column::name) -
                                sheet.columns.begin());
  std::size_t at = 0;
  for (const auto& subject : problem.subjects)
    for (const auto& level : subject.levels)
      for (const auto& run : level.runs)
        if (auto& row = rows[at++]; run.file) row[file] = history_name(subject, run);
  return {{"columns", columns}, {"rows", rows}};
}

// The fit has no number for a level that it calls unusable.
Json levels(const record::CaseRecord& problem) {
  Json out = Json::array();
  for (const auto& subject : problem.subjects) {
    const auto& fit = subject.assessment.displacement;
    for (std::size_t level = 0; level < std::min(fit.steps.size(), fit.errors.size()); ++level)
      if (std::isfinite(fit.errors[level]))
        out.push_back(
            {{"method", subject.name},
             {"level", level + 1},
             {"step", fit.steps[level]},
             {"steps_per_fast_period", rounded(problem.problem.fast_period / fit.steps[level])},
             {"u_error", fit.errors[level]}});
  }
  return out;
}

// Triangles whose third side climbs with order 1, 2 and 4, in the lower right corner, where a
// convergence plot is empty. The highest takes at most a third of the height.
Json slopes(const record::CaseRecord& problem) {
  double step = 0.0, lowest = INFINITY, highest = 0.0;
  for_each_run(problem, [&](const measure::RunScore& score) {
    if (!is_drawable(score)) return;
    step = std::max(step, score.step);
    lowest = std::min(lowest, score.u_error);
    highest = std::max(highest, score.u_error);
  });
  Json out = Json::array();
  if (!(step > 0.0)) return out;
  lowest = std::min(lowest, highest / 10.0);  // below errors that do not fall
  const double decades = std::log10(highest) - std::log10(lowest);
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

Json history(const record::CaseRecord& problem) {
  Json out = Json::array();
  for (const auto& subject : problem.subjects) {
    const auto* run = subject.shown_run();
    if (run == nullptr) continue;
    const auto curve = drawn(run->error_history);
    for (std::size_t mass = 0; mass < curve.y.size(); ++mass)
      out.push_back({{"method", subject.name},
                     {"mass", mass + 1},
                     {"step", rounded(run->score.step)},
                     {"t", rounded_list(curve.t)},
                     {"error", rounded_list(curve.y[mass])}});
  }
  return out;
}

Json impact_table(const record::CaseRecord& problem) {
  Json out = Json::array();
  for (const auto& subject : problem.subjects)
    for (std::size_t k = 0; k < subject.impacts.size(); ++k) {
      const auto& impact = subject.impacts[k];
      out.push_back({{"method", subject.name},
                     {"k", k + 1},
                     {"contact", impact.contact + 1},
                     {"t", rounded(impact.t)},
                     {"restitution", rounded(impact.restitution)},
                     {"least", rounded(impact.restitution - impact.restitution_error)},
                     {"most", rounded(impact.restitution + impact.restitution_error)},
                     {"late", rounded(impact.delay_steps)}});
    }
  return out;
}

Json work(const record::CaseRecord& problem, const std::vector<ShownCounter>& counters) {
  Json out = Json::array();
  for (const auto& subject : problem.subjects)
    for (const auto& counter : counters) {
      const auto curve = judge::work_curve(record::ladder_of(subject), counter.counter);
      for (std::size_t level = 0; level < curve.envelope.size(); ++level) {
        const auto& worst = curve.envelope[level];
        if (worst.work > 0.0 && std::isfinite(worst.error))
          out.push_back({{"method", subject.name},
                         {"counter", counter.field},
                         {"level", level + 1},
                         {"step", worst.step},
                         {"cost", worst.work},
                         {"u_error", worst.error}});
      }
    }
  return out;
}

Json front(const record::CaseRecord& problem, const std::vector<ShownCounter>& counters) {
  measure::Ladder all;
  for (const auto& subject : problem.subjects)
    if (!record::is_solver(subject.kind))
      for (auto& level : record::ladder_of(subject)) all.push_back(std::move(level));
  Json out = Json::array();
  for (const auto& counter : counters)
    for (const auto& run : judge::work_curve(all, counter.counter).runs)
      if (run.on_front && run.work > 0.0 && run.error > 0.0)
        out.push_back({{"counter", counter.field}, {"cost", run.work}, {"u_error", run.error}});
  return out;
}

bool is_refused(std::span<const record::CaseRecord> cases, const std::string& name) {
  bool known = false, refused = true;
  for (const auto& problem : cases)
    for (const auto& subject : problem.subjects)
      if (subject.name == name) {
        known = true;
        refused = refused && !subject.refusal.empty();
      }
  return known && refused;
}

}  // namespace

Json rounded_list(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(rounded(value));
  return out;
}

// Lines from ratio 1 to a common end, so that the height at which a line stays can be seen.
Json profile_data(const std::vector<record::Profile>& profiles,
                  std::span<const record::CaseRecord> cases) {
  Json out = Json::array();
  for (const auto& profile : profiles) {
    double end = 2.0;
    for (const auto& method : profile.methods)
      if (!method.steps.empty()) end = std::max(end, 1.25 * method.steps.back().ratio);
    for (const auto& method : profile.methods) {
      // A method that never ran has no entry in the legend; the text beside the figure names it.
      if (is_refused(cases, method.method)) continue;
      std::vector<judge::ProfileStep> line;
      if (method.steps.empty() || method.steps.front().ratio > 1.0) line.push_back({1.0, 0.0});
      line.insert(line.end(), method.steps.begin(), method.steps.end());
      line.push_back({end, line.back().share});
      Json ratio = Json::array(), share = Json::array(), solved = Json::array();
      for (const auto& step : line) {
        ratio.push_back(step.ratio);
        share.push_back(step.share);
        solved.push_back(std::llround(step.share * double(profile.tasks.size())));
      }
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

bool has_convergence(const record::CaseRecord& problem) {
  int drawable = 0;
  for_each_run(problem, [&](const measure::RunScore& score) { drawable += is_drawable(score); });
  return drawable > 1;
}

bool has_error_history(const record::CaseRecord& problem) {
  return std::ranges::any_of(problem.subjects, [](const record::Subject& subject) {
    const auto* run = subject.shown_run();
    return run != nullptr && std::ranges::any_of(run->error_history.y, [](const auto& errors) {
             return std::ranges::any_of(errors, [](double error) { return error > 0.0; });
           });
  });
}

std::size_t worst_mass(const record::CaseRecord& problem) {
  std::size_t worst = 1;
  double largest = 0.0;
  for (const auto& subject : problem.subjects) {
    const auto* run = subject.shown_run();
    if (run == nullptr) continue;
    const auto& errors = run->error_history.y;
    for (std::size_t mass = 0; mass < std::min(errors.size(), most_drawn_masses); ++mass)
      for (const double error : errors[mass])
        if (error > largest) largest = error, worst = mass + 1;
  }
  return worst;
}

const record::Subject* drawn_subject(const record::CaseRecord& problem) {
  for (const auto& subject : problem.subjects) {
    const auto* run = subject.shown_run();
    if (run != nullptr && run->file && !run->file->history.t.empty()) return &subject;
  }
  return nullptr;
}

Json figure_data(const record::CaseRecord& problem) {
  const auto counters = counters_of(problem);
  const auto* drawn = drawn_subject(problem);
  return {{"response", displacements(problem.response)},
          {"history_rows",
           drawn == nullptr ? Json::array() : displacements(drawn->shown_run()->file->history)},
          {"impacts", impacts(problem.problem)},
          {"runs", all_runs(problem)},
          {"levels", levels(problem)},
          {"slopes", slopes(problem)},
          {"history", history(problem)},
          {"impact_table", impact_table(problem)},
          {"work", work(problem, counters)},
          {"front", front(problem, counters)},
          {"profile", profile_data(problem.profiles, {&problem, 1})}};
}

}  // namespace clackers::report
