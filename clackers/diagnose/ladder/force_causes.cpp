#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

// What steps of h between rows s apart add to free motion: A s h a in displacement and B s h da/dt in
// velocity. Where A + B < 0 the energy of every spring grows. Symplectic Euler has 1/2 and -1/2,
// explicit Euler -1/2 twice.
struct StepError {
  double displacement = 0.0, velocity = 0.0;
};

// Least squares with one column: the factor, where it explains nine tenths of the squares.
class Factor {
 public:
  void add(const Eigen::VectorXd& of, const Eigen::VectorXd& by) {
    onto_ += of.dot(by);
    column_ += by.squaredNorm();
    square_ += of.squaredNorm();
  }
  std::optional<double> value() const {
    constexpr double least_explained = 0.9;
    if (!(column_ > 0.0) || !(onto_ * onto_ > least_explained * square_ * column_)) return {};
    return onto_ / column_;
  }

 private:
  double onto_ = 0.0, column_ = 0.0, square_ = 0.0;
};

std::optional<StepError> step_error(const Observation& seen, const model::SmoothSystem<>& system) {
  constexpr double longest_turn = 0.5;
  constexpr int least_steps = 20;
  const auto& rows = seen.opening;
  const double h = seen.facts.step;
  if (rows.v.empty() || !seen.sample.impacts || !(h > 0.0)) return {};
  const measure::FreeMotion motion(system);
  const double longest = longest_turn / measure::highest_frequency(system);
  const Eigen::ArrayXd weight = system.mass.diagonal().array().sqrt();
  Factor displacement, velocity;
  int steps = 0;
  constexpr std::size_t most_rows = 500;
  for (std::size_t i = 0; i + 1 < rows.t.size(); i += 1 + rows.t.size() / most_rows) {
    const double s = rows.t[i + 1] - rows.t[i];
    if (!(s > 0.5 * h) || s > longest) continue;
    if (std::ranges::any_of(*seen.sample.impacts, [&](const model::Impact& impact) {
          return impact.t > rows.t[i] - 3.0 * s && impact.t < rows.t[i + 1] + 3.0 * s;
        }))
      continue;
    const auto from = measure::row_state(rows, i), to = measure::row_state(rows, i + 1);
    const auto free = motion.moved(from, s);
    const Eigen::VectorXd a = motion.acceleration(from.t, from.u, from.v);
    const Eigen::VectorXd change = motion.acceleration(free.t, free.u, free.v) - a;
    displacement.add(weight * (to.u - free.u).array() / s, h * weight * a.array());
    velocity.add(weight * (to.v - free.v).array(), h * weight * change.array());
    ++steps;
  }
  const auto of_u = displacement.value(), of_v = velocity.value();
  if (steps < least_steps || !of_u || !of_v) return {};
  return StepError{*of_u, *of_v};
}

}  // namespace

std::vector<Diagnosis> force_causes(const DiagnosisInput& question) {
  constexpr double at_old_state = -0.5, same = 0.1, least_growth = 0.1;
  const auto& system = question.problem.system;
  if (question.by_tolerance || system.nonlinear) return {};
  std::vector<double> factors;
  for (const auto& seen : question.histories) {
    const auto error = step_error(seen, system);
    if (!error) continue;
    if (std::abs(error->velocity - at_old_state) > same) return {};
    factors.push_back(error->displacement + 0.5);
  }
  if (factors.size() < 2) return {};
  const double factor = factors.back();
  double spread = 0.0;
  for (const double other : factors) spread = std::max(spread, std::abs(other - factor));
  if (factor > 1.0 - least_growth || spread > same) return {};
  auto found = diagnosis_of(Code("force-step"), factor, "1");
  found.confidence = 0.95;
  found.evidence = {{"uncertainty", spread}, {"files", double(factors.size())}};
  return {found};
}

}  // namespace clackers::diagnose
