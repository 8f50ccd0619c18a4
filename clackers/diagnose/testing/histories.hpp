#pragma once

// Histories that are exact but for what a test changes in them, and what `check` would know of
// them. For tests only.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/diagnose/diagnose.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/study/check/case_family.hpp"

namespace clackers::diagnose::testing {

/// The exact motion of the case at n spacing, n = 0, 1, ... up to its end or `last` [s]; right limits.
inline model::Trajectory exact_rows(const cases::Case& problem, double spacing,
                                    double last = INFINITY) {
  model::Trajectory rows;
  rows.dof = problem.motion->dof();
  const double end = std::min(problem.motion->end(), last);
  for (int n = 0; double(n) * spacing <= end * (1.0 + 1e-12); ++n)
    rows.t.push_back(std::min(double(n) * spacing, problem.motion->end()));
  const auto size = rows.t.size() * std::size_t(rows.dof);
  rows.u.resize(size);
  rows.v.resize(size);
  problem.motion->sample(rows.t, model::Side::right, {rows.u, rows.v, {}});
  return rows;
}

/// u and v of the case at other times than the rows say; times outside its run are moved to its ends.
inline void resample(model::Trajectory& rows, const cases::Case& problem, double late_u,
                     double late_v) {
  std::vector<double> unused(rows.u.size());
  const auto times = [&](double late) {
    auto t = rows.t;
    for (double& one : t) one = std::clamp(one - late, 0.0, problem.motion->end());
    return t;
  };
  problem.motion->sample(times(late_u), model::Side::right, {rows.u, unused, {}});
  problem.motion->sample(times(late_v), model::Side::right, {unused, rows.v, {}});
}

/// The number as "%.<digits>g" prints it.
inline double printed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

/// What printing u and v with so many significant digits leaves; times as they are.
inline void print(model::Trajectory& rows, int digits) {
  for (auto* values : {&rows.u, &rows.v})
    for (double& value : *values) value = printed(value, digits);
}

/// What is known of such a file. `digits` of u and v, 17 for all.
inline FileFacts facts_of(const cases::Case& problem, const model::Trajectory& rows, double step,
                          int digits = 17) {
  FileFacts facts;
  facts.step = step;
  facts.spacing = rows.t.size() > 1 ? rows.t[1] - rows.t[0] : step;
  facts.columns.push_back({"t", 17, false, 0.0});
  const auto envelope = problem.motion->peak();
  for (int mass = 0; mass < rows.dof; ++mass)
    for (const auto& [letter, values, scale] :
         {std::tuple{"u", &rows.u, &envelope.u}, std::tuple{"v", &rows.v, &envelope.v}}) {
      double largest = 0.0;
      for (auto i = std::size_t(mass); i < values->size(); i += std::size_t(rows.dof))
        largest = std::max(largest, std::abs((*values)[i]));
      const double unit =
          digits >= 17 || largest == 0.0
              ? 0.0
              : 0.5 * std::pow(10.0, std::floor(std::log10(largest)) + 1.0 - digits);
      facts.columns.push_back({letter + std::to_string(mass + 1), digits, false, unit});
      if (*letter == 'u') facts.floor = std::max(facts.floor, unit / (*scale)[mass]);
    }
  return facts;
}

inline Observation observed(const cases::Case& problem, const model::Trajectory& rows,
                            const FileFacts& facts) {
  return observe(measure::Comparison(rows, *problem.motion, problem.problem), facts);
}

inline Observation observed(const cases::Case& problem, const model::Trajectory& rows,
                            double step) {
  return observed(problem, rows, facts_of(problem, rows, step));
}

/// Histories of one case and the question that they make. Coarsest first; each is a level.
struct Files {
  cases::Case problem;
  std::vector<Observation> histories{};
  measure::Ladder ladder{};
  judge::LadderFit displacement{}, velocity{};

  void add(const model::Trajectory& rows, const FileFacts& facts) {
    const measure::Comparison comparison(rows, *problem.motion, problem.problem);
    histories.push_back(observe(comparison, facts));
    ladder.push_back({facts.step, {comparison.score(facts.step)}});
  }
  void add(const model::Trajectory& rows, double step) { add(rows, facts_of(problem, rows, step)); }

  /// Judges the errors, each file as a level.
  void fit(const Claim& claim = {}) {
    const auto found = judge::judge(ladder, claim);
    displacement = found.displacement;
    velocity = found.velocity;
  }

  DiagnosisInput question() const {
    return {.problem = problem.problem,
            .motion = *problem.motion,
            .histories = histories,
            .ladder = ladder,
            .displacement = displacement,
            .velocity = velocity,
            .limit = limit_of(histories, problem.problem, *problem.motion),
            .family = study::family_of(problem)};
  }
};

/// The diagnosis of that code among them.
inline const Diagnosis* find(const std::vector<Diagnosis>& all, std::string_view code) {
  const auto at = std::ranges::find(all, code, &Diagnosis::code);
  return at == all.end() ? nullptr : &*at;
}

/// Their codes, one space between them.
inline std::string codes(const std::vector<Diagnosis>& all) {
  std::string text;
  for (const auto& one : all) text += (text.empty() ? "" : " ") + one.code;
  return text;
}

/// Cases that differ in everything that a file may show: systems, impacts, damping, restitution.
inline std::vector<cases::Case> assorted_cases() {
  std::vector<cases::Case> all;
  for (const double N : {0.0, 1.0, 2.0, 5.0})
    all.push_back(cases::make("three-parameter", {{"N", N}}));
  all.push_back(cases::make("three-parameter", {{"N", 2.0}, {"xi1", 0.25}}));
  all.push_back(cases::make("stop", {{"eta", 0.5}}));
  all.push_back(cases::make("stop"));
  all.push_back(cases::make("sdof"));
  all.push_back(cases::make("symmetric-pair"));
  all.push_back(cases::make("synchronized-pair", {{"r", 2.0}, {"eta", 0.8}}));
  return all;
}

}  // namespace clackers::diagnose::testing
