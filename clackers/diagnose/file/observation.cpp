#include "clackers/diagnose/observation.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::diagnose {
namespace {

// Rows that are no limits of jumps, and the two ends.
std::vector<std::size_t> plain_rows(const measure::Comparison& comparison) {
  std::vector<std::size_t> rows;
  const auto last = comparison.rows() - 1;
  rows.reserve(comparison.rows());
  for (std::size_t row = 0; row <= last; ++row)
    if (row == 0 || row == last ||
        (!comparison.is_left_limit(row) && !comparison.is_right_limit(row)))
      rows.push_back(row);
  return rows;
}

std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen(std::min(count, most));
  const double stride = chosen.size() < 2 ? 0.0 : double(count - 1) / double(chosen.size() - 1);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    chosen[i] = std::size_t(std::llround(double(i) * stride));
  return chosen;
}

void append(model::Trajectory& to, const model::Trajectory& from, std::size_t row) {
  const auto dof = std::ptrdiff_t(from.dof);
  to.t.push_back(from.t[row]);
  for (const auto part : {&model::Trajectory::u, &model::Trajectory::v, &model::Trajectory::a}) {
    if ((from.*part).empty()) continue;
    const auto at = (from.*part).begin() + std::ptrdiff_t(row) * dof;
    (to.*part).insert((to.*part).end(), at, at + dof);
  }
}

// The place of each plain row on the grid of `spacing`, -1 between two places.
std::vector<long long> grid_places(const model::Trajectory& history,
                                   const std::vector<std::size_t>& rows, double spacing) {
  // A time that is rounded to a quarter of the spacing still has its place.
  constexpr double tolerance = 0.25;
  std::vector<long long> places{0};
  places.reserve(rows.size());
  double from = history.t[rows.front()];
  long long place = 0, on_grid = 1;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double parts = (history.t[rows[i]] - from) / spacing;
    const double whole = std::round(parts);
    const bool hits = whole >= 1.0 && std::abs(parts - whole) < tolerance;
    if (hits) {
      place += std::llround(whole);
      from = history.t[rows[i]];
      ++on_grid;
    }
    places.push_back(hits ? place : -1);
  }
  constexpr double least_share = 0.9;
  if (double(on_grid) < least_share * double(rows.size())) places.clear();
  return places;
}

}  // namespace

Observation observe(const measure::Comparison& comparison, const FileFacts& facts) {
  const auto& history = comparison.history();
  Observation seen;
  seen.facts = facts;
  seen.rows = (long long)(comparison.rows());
  seen.first = history.t.front();
  seen.last = history.t.back();
  seen.sample.dof = seen.opening.dof = history.dof;
  for (std::size_t row = 0; row < std::min(comparison.rows(), most_opening_rows); ++row)
    append(seen.opening, history, row);

  const auto rows = plain_rows(comparison);
  const auto places = grid_places(history, rows, comparison.step());
  for (const auto i : spread(rows.size(), most_sample_rows)) {
    append(seen.sample, history, rows[i]);
    if (!places.empty()) seen.sample_steps.push_back(places[i]);
  }
  for (double& t : seen.sample.t) t = std::min(t, comparison.reference().end());
  const auto& impacts = comparison.impacts();
  const auto kept = std::min(impacts.size(), most_sample_impacts);
  seen.sample.impacts.emplace(impacts.begin(), impacts.begin() + std::ptrdiff_t(kept));
  return seen;
}

}  // namespace clackers::diagnose
