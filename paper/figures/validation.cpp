// The second way of section 2.3: numerical solutions of Eq. (25) converge to Eq. (26).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clackers/study/verify.hpp"
#include "paper/catalogue.hpp"
#include "paper/figures/validation.hpp"

namespace clackers::paper {
namespace {

constexpr std::array letters{"a", "b", "c", "d", "e", "f"};

struct Method {
  const char* name;
  Stroke stroke;
};

const std::vector<Method>& methods_shown() {
  static const std::vector<Method> table{{"newmark", {light::m1, {1, 0}, 1.8}},
                                         {"central-difference", {light::m2, {7, 3}, 1.8}},
                                         {"generalized-alpha:rho=0.2", {light::m3, {2, 2}, 1.8}},
                                         {"rk4", {light::m4, {8, 3, 2, 3}, 1.8}},
                                         {"newmark+reversal", {light::m7, {4, 2}, 1.4}},
                                         {"moreau-jean", {light::m8, {1, 0}, 1.1}}};
  return table;
}

// Steps from a sixteenth of the fast period down by halves: the same part of the fast motion for
// every N.
record::Record study_of(int N, const std::atomic<bool>* interrupt) {
  study::VerifyRequest request;
  for (const auto& method : methods_shown()) request.methods.push_back(method.name);
  request.cases = {"three-parameter"};
  request.settings = {{"N", double(N)}};
  const auto periods = cases::make(request.cases[0], request.settings).damped_periods;
  request.plan = {
      .coarsest = std::ranges::min(periods) / 16.0, .levels = 7, .samples_per_level = 2};
  return study::verify(request, {}, interrupt);
}

// The largest error of each level; a level with a run that failed has none.
Series errors_of(const record::Subject& subject, const Method& look) {
  Series out{look.name, {}, {}, look.stroke};
  for (const auto& level : subject.levels) {
    const auto score = record::worst(level);
    if (score.failed > 0 || !(score.worst.u_error > 0.0)) continue;
    out.x.push_back(level.step);
    out.y.push_back(score.worst.u_error);
  }
  return out;
}

}  // namespace

bool converges(const Series& line) {
  if (line.y.empty()) return false;
  const double last = line.y.back();
  return last < 0.1 * std::ranges::max(line.y) && last <= 2.0 * std::ranges::min(line.y);
}

Figure convergence(std::span<const int> Ns, const std::atomic<bool>* interrupt) {
  Figure figure;
  figure.columns = 3;
  figure.width = 260.0;
  figure.height = 200.0;
  figure.caption =
      "Largest displacement error over 0 ≤ t ≤ 20 s, relative to the initial amplitude of each mass, against the step; three-parameter system with ξ1 = 0.05, a_t = 1. Without another contact treatment in its name a method locates impacts.";
  for (std::size_t i = 0; i < Ns.size(); ++i) {
    const auto record = study_of(Ns[i], interrupt);
    if (record.interrupted) break;
    const auto& plan = record.cases.at(0).plan;
    const double finest = std::ldexp(plan.coarsest, 1 - plan.levels);
    Panel panel{letters[i],
                fmt::format("N = {}", Ns[i]),
                {.title = "step h [s]",
                 .lowest = finest / 1.3,
                 .highest = plan.coarsest * 1.3,
                 .logarithmic = true},
                {.title = "error in u", .lowest = 1e-11, .highest = 10.0, .logarithmic = true},
                {}};
    const auto& subjects = record.cases[0].subjects;
    for (std::size_t m = 0; m < subjects.size(); ++m)
      panel.series.push_back(errors_of(subjects[m], methods_shown()[m]));
    figure.panels.push_back(std::move(panel));
  }
  figure.choices = {
      "The paper names this way and shows no figure. Penalty contact is left out: it solves a system with a spring between the masses, not Eq. (25)."};
  return figure;
}

Figure validation(const std::atomic<bool>* interrupt) {
  constexpr std::array Ns{0, 1, 2, 5, 10, 20};
  return convergence(Ns, interrupt);
}

}  // namespace clackers::paper
