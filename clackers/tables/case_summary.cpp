#include "clackers/tables/case_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/exact/bodies/bar_motion.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::tables {
namespace {

constexpr long long most_impact_times = 1000;

// The shortest period of the free masses: of the case where it has damped ones, else of the undamped
// modes of M and K.
double fast_period(const cases::Case& problem) {
  if (!problem.damped_periods.empty()) return *std::ranges::min_element(problem.damped_periods);
  const auto& system = problem.problem.system;
  const double largest = numerics::highest_square(system.stiffness, system.mass);
  return largest > 0.0 ? 2.0 * std::numbers::pi / std::sqrt(largest) : problem.motion->end();
}

// At equal times, some of which are left out where the curve is straight.
record::Curve contact_forces(const cases::Case& problem) {
  const auto& motion = *problem.motion;
  if (motion.closed_contacts().empty()) return {};
  constexpr std::size_t times = response_points;
  const auto time = [&](std::size_t k) { return motion.end() * double(k) / double(times - 1); };
  std::vector<Eigen::VectorXd> forces;
  for (std::size_t k = 0; k < times; ++k)
    forces.push_back(motion.contact_forces(time(k), model::Side::right));
  return record::reduced(times, problem.problem.contacts.size(), time,
                         [&](std::size_t row, std::size_t k) {
                           return forces[k].size() > 0 ? forces[k][Eigen::Index(row)] : 0.0;
                         });
}

}  // namespace

record::CaseSummary summary_of(const cases::Case& problem) {
  record::CaseSummary summary;
  summary.name = problem.entry->name;
  summary.summary = problem.entry->summary;
  summary.equations = problem.entry->equations;
  for (std::size_t i = 0; i < problem.values.size(); ++i) {
    const auto& parameter = problem.entry->parameters[i];
    const auto& value = problem.values[i].second;
    auto& added = summary.parameters.emplace_back(
        Quantity{parameter.name, NAN, parameter.unit, parameter.meaning});
    if (value.is_word())
      added.text = value.text();
    else
      added.value = value;
  }
  summary.constants = problem.constants;
  summary.constants.insert(summary.constants.end(), problem.indicators.begin(),
                           problem.indicators.end());
  summary.end = problem.motion->end();
  summary.fast_period = fast_period(problem);
  summary.impact_count = problem.motion->impact_count(summary.end);
  for (long long k = 1; k <= std::min(summary.impact_count, most_impact_times); ++k) {
    const auto impact = problem.motion->impact(k);
    summary.impact_times.push_back(impact.t);
    summary.impact_contacts.push_back(impact.contact);
  }
  summary.contact_forces = contact_forces(problem);
  summary.drawing = record::schematic(problem.problem);
  summary.drawing.plane = problem.plane;
  if (problem.mesh && problem.bars->is_string() && !summary.drawing.blocks.empty())
    summary.drawing.string = record::string_nodes(*problem.mesh);
  return summary;
}

}  // namespace clackers::tables
