#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/file/single_numbers.hpp"
#include "clackers/diagnose/file/units.hpp"
#include "clackers/numerics/golden_section.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

constexpr double float_rounding = 0x1p-24;

std::vector<double> scaled(const std::vector<double>& times, double factor) {
  auto result = times;
  for (double& t : result) t *= factor;
  return result;
}

// Times in another unit: the history is that of the motion at t over the factor. A history that
// hardly moves would fit the first instants of the motion: the reference must move by far more than
// what is left.
std::optional<Diagnosis> time_unit(const FileSample& file) {
  constexpr double visible = 0.05, least_gain = 30.0, acceptable = 0.05;
  if (!(file.distance().u > visible)) return {};
  std::vector<Unit> units(time_units.begin(), time_units.end());
  const auto& facts = file.history().facts;
  const double spacing = file.history().facts.spacing;
  // Numbers of steps in place of times.
  if (facts.step > 0.0 && std::abs(spacing - std::round(spacing)) < 1e-9 && spacing >= 0.5)
    units.push_back({1.0 / facts.step, "steps"});
  std::optional<Diagnosis> best;
  double least = INFINITY, second = INFINITY;
  for (const auto& unit : units) {
    const auto times = scaled(file.rows().t, 1.0 / unit.factor);
    if (times.back() > 1.01 * file.motion().end()) continue;
    const double left = file.distance_at(times).u;
    second = std::min(second, std::max(left, least));
    if (left >= least) continue;
    least = left;
    const auto reference = reference_rows(file.motion(), times);
    double moved = 0.0;
    const auto masses = std::size_t(reference.dof);
    for (std::size_t i = 0; i < reference.u.size(); ++i)
      moved = std::max(moved, std::abs(reference.u[i] - reference.u[i % masses]) /
                                  file.scale().u[Eigen::Index(i % masses)]);
    best.reset();
    if (!(left < acceptable) || !(file.distance().u > least_gain * left) ||
        !(moved > least_gain * left))
      continue;
    best.emplace();
    best->code = "time-unit";
    best->value = unit.factor;
    best->text = unit.name;
    best->confidence = 0.95;
    best->evidence = {{"gain", file.distance().u / left}};
  }
  if (best) best->evidence.push_back({"runner-up-gain", file.distance().u / second});
  return best;
}

// The numbers of steps and the times of a sample that lie on the grid.
struct Grid {
  std::vector<double> n, t;
};

Grid grid_of(const Observation& history) {
  Grid grid;
  for (std::size_t i = 0; i < history.sample_steps.size(); ++i) {
    if (history.sample_steps[i] < 0) continue;
    grid.n.push_back(double(history.sample_steps[i]));
    grid.t.push_back(history.sample.t[i]);
  }
  return grid;
}

// What rounding one time may make, without accumulation.
double rounding_of_times(const Observation& history) {
  double unit = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(history.last);
  for (const auto& column : history.facts.columns)
    if (column.name == "t") unit = std::max(unit, column.half_unit);
  unit = std::max(unit, history.facts.time_half_unit);
  if (are_single(history.sample.t)) unit = std::max(unit, float_rounding * std::abs(history.last));
  return unit;
}

// Times t that leave the grid first + n h by more than each rounding alone could, and a motion that
// is met far better at first + n h, h fitted: the sum of rounded steps. A scale of all times is no
// drift: what counts is the part of t that is not linear in n.
std::optional<Diagnosis> time_drift(const FileSample& file) {
  constexpr double beyond_rounding = 3.0, least_gain = 5.0, sure_gain = 30.0;
  const auto& history = file.history();
  const auto grid = grid_of(history);
  if (grid.t.size() < 20 || history.sample_steps.size() != history.sample.t.size()) return {};
  const auto line = numerics::fit_line(grid.n, grid.t);
  double bent = 0.0;
  for (std::size_t i = 0; i < grid.t.size(); ++i)
    bent = std::max(bent, std::abs(grid.t[i] - line.intercept - line.slope * grid.n[i]));
  const double rounding = rounding_of_times(history);
  if (!(bent > beyond_rounding * rounding)) return {};

  // Rows between places of the grid drift as their neighbours do.
  const auto times_for = [&](double h) {
    auto times = history.sample.t;
    double off = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto place = history.sample_steps[i];
      if (place >= 0) off = history.first + double(place) * h - history.sample.t[i];
      times[i] += off;
    }
    return times;
  };
  const auto distance = [&](double h) { return file.distance_at(times_for(h)).u; };
  // Golden sections between steps that the drift allows: rounded steps err by at most the bend.
  const double reach = 20.0 * bent / grid.n.back();
  const auto [h, left] =
      numerics::golden_section(line.slope - reach, line.slope + reach, 25, distance);
  // The same for times that are only scaled.
  double scaled_left = INFINITY;
  for (int i = -10; i <= 10; ++i)
    scaled_left = std::min(
        scaled_left,
        file.distance_at(scaled(history.sample.t, 1.0 + reach / line.slope * double(i) / 10.0)).u);
  const double gain = file.distance().u / left;
  if (!(gain > least_gain) || !(scaled_left > 2.0 * left)) return {};
  Diagnosis cause;
  cause.code = "time-drifts";
  cause.value = grid.t.back() - history.first - grid.n.back() * h;
  if (std::abs(cause.value) < beyond_rounding * rounding) return {};
  cause.unit = "s";
  cause.confidence = gain > sure_gain ? 0.95 : 0.8;
  cause.evidence = {{"gain", gain}, {"runner-up-gain", file.distance().u / scaled_left}};
  return cause;
}

}  // namespace

std::vector<Diagnosis> time_causes(const std::vector<FileSample>& files) {
  if (auto unit = time_unit(files.front())) return {*unit};
  std::optional<Diagnosis> best;
  double count = 0.0;
  for (const auto& file : files) {
    auto drift = time_drift(file);
    if (!drift) continue;
    ++count;
    if (!best || drift->fact("gain") > best->fact("gain")) best = drift;
  }
  if (!best) return {};
  best->evidence.push_back({"files", count});
  return {*best};
}

}  // namespace clackers::diagnose
