#include "clackers/study/check/against.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/base/number.hpp"
#include "clackers/input/history.hpp"
#include "clackers/judge/convergence/self_convergence.hpp"
#include "clackers/study/check/named_resolution.hpp"

namespace clackers::study {
namespace {

constexpr auto against_name = "check --against";

struct Level {
  input::History history;
  double step = 0.0;  ///< or a tolerance
};
using Levels = std::vector<Level>;  // coarsest first

// The largest number behind u in the names of a file's columns.
int masses_of(const input::Source& source, input::HistoryOptions options) {
  int masses = 1;
  for (const auto& name : input::read_history(source, options).names)
    if (name.size() > 1 && (name[0] == 'u' || name[0] == 'U'))
      masses = std::max(masses, int(finite_number(std::string_view(name).substr(1)).value_or(1.0)));
  return masses;
}

Levels read_levels(const std::vector<input::Source>& files, std::span<const double> steps,
                   input::HistoryOptions options) {
  Levels levels;
  std::vector<NamedHistory> set;
  for (std::size_t i = 0; i < files.size(); ++i) {
    options.step = steps.empty() ? 0.0 : steps[i];
    auto& level = levels.emplace_back(Level{input::read_history(files[i], options), options.step});
    if (const auto lacking = std::ranges::find(level.history.has_u, false);
        lacking != level.history.has_u.end())
      refuse(against_name, input::name_of(files[i]),
             fmt::format("no u{}", lacking - level.history.has_u.begin() + 1),
             fmt::format("the displacements of all {} masses", options.dof), {}, "no-column");
    set.push_back({named_resolution(input::name_of(files[i])), level.history.spacing});
  }
  const double end = levels.front().history.motion.t.back();
  const auto named = named_steps(set, std::numeric_limits<double>::infinity(), end);
  if (steps.empty())
    for (std::size_t i = 0; i < levels.size(); ++i)
      levels[i].step = named.steps[i].value_or(set[i].spacing);
  std::ranges::stable_sort(levels, std::greater{}, &Level::step);
  return levels;
}

// Rows of the first history, and of each other the row of the same time; of two rows of one time the
// right limit.
std::vector<std::vector<std::size_t>> common_rows(
    const std::vector<const model::Trajectory*>& histories) {
  constexpr double same_time = 1e-9;  // of the time between rows
  std::vector<std::size_t> at(histories.size(), 0);
  std::vector<std::vector<std::size_t>> rows;
  const auto& first = histories.front()->t;
  const double near = same_time * (first.back() - first.front()) / double(first.size());
  for (std::size_t row = 0; row < first.size(); ++row) {
    if (row + 1 < first.size() && first[row + 1] == first[row]) continue;
    at[0] = row;
    bool is_common = true;
    for (std::size_t k = 1; k < histories.size(); ++k) {
      const auto& t = histories[k]->t;
      while (at[k] + 1 < t.size() && t[at[k] + 1] <= first[row] + near) ++at[k];
      is_common = is_common && std::abs(t[at[k]] - first[row]) <= near;
    }
    if (is_common) rows.push_back(at);
  }
  return rows;
}

// The order with which the differences between levels fall, at the times that all of them have.
std::vector<record::Cell> self_row(const char* name, const Levels& levels, double size) {
  std::vector<record::Cell> row{std::string(name), (long long)(levels.size()), levels.back().step};
  const auto add_empty = [&](std::string reason) {
    row.insert(row.end(), {std::monostate{}, std::monostate{}, std::move(reason)});
    return row;
  };
  constexpr std::size_t least_levels = 5;
  if (levels.size() < least_levels) return add_empty("five histories or more give an order");
  const double ratio = levels[0].step / levels[1].step;
  std::vector<const model::Trajectory*> histories;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    histories.push_back(&levels[i].history.motion);
    if (i > 0 &&
        !(std::abs(levels[i - 1].step / levels[i].step / ratio - 1.0) < 0.01 && ratio > 1.0))
      return add_empty("steps of one ratio give an order");
  }
  const auto rows = common_rows(histories);
  std::vector<judge::ResponseLevel> runs;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const auto& u = histories[k]->u;
    const auto dof = std::size_t(histories[k]->dof);
    judge::Response run{levels[k].step, {}, std::numeric_limits<double>::epsilon() * size};
    for (const auto& at : rows)
      run.values.insert(run.values.end(), u.begin() + std::ptrdiff_t(at[k] * dof),
                        u.begin() + std::ptrdiff_t((at[k] + 1) * dof));
    runs.push_back({std::move(run)});
  }
  const auto fit = judge::self_convergence(runs, {.size = size}).differences;
  if (!fit.has_line) return add_empty(std::string(to_string(fit.behaviour)));
  row.insert(row.end(), {fit.order, fit.spread, std::string(to_string(fit.behaviour))});
  return row;
}

}  // namespace

AgainstResult check_against(const AgainstRequest& request, const std::atomic<bool>* interrupt) {
  const auto& [ours, theirs] = request.sets;
  if (ours.empty() || theirs.empty())
    throw InputError("check --against needs a FILE before it and one behind it.", "bad-syntax");
  if (!request.steps.empty() && request.steps.size() != ours.size() + theirs.size())
    refuse(against_name, "--steps", fmt::format("{} of them", request.steps.size()),
           fmt::format("one a history, {} here, in the same order", ours.size() + theirs.size()),
           {}, "wrong-size");
  for (const double step : request.steps) require_step("check --steps", step);
  if (request.tolerance) require_positive("check", "--tolerance", *request.tolerance);
  input::HistoryOptions options{.columns = request.columns, .interrupt = interrupt};
  if (!request.steps.empty()) options.step = request.steps.front();
  options.dof = masses_of(ours.front(), options);
  const std::span steps = request.steps;
  const bool has_steps = !steps.empty();
  const auto first = read_levels(ours, has_steps ? steps.first(ours.size()) : steps, options);
  const auto second = read_levels(theirs, has_steps ? steps.last(theirs.size()) : steps, options);

  const auto &a = first.back().history.motion, &b = second.back().history.motion;
  const auto rows = common_rows({&a, &b});
  if (rows.size() < least_common_times)
    refuse(against_name, "common times of the finest histories", double(rows.size()),
           fmt::format("{} or more", least_common_times),
           "Nothing is interpolated: write both at the same times.", "wrong-size");
  record::Sheet masses{"clackers/differences/1",
                       "",
                       {{"mass", "", "from 1"},
                        {"difference", "m", "largest over the common times"},
                        {"relative", "", "the same over the largest displacement of the mass"},
                        {"time", "s", "of the largest difference"},
                        {"since", "s", "first time of a relative difference above 1e-3"}},
                       {}};
  const auto dof = std::size_t(a.dof);
  double size = 0.0, largest = 0.0, at_time = 0.0, visible = INFINITY;
  for (std::size_t mass = 0; mass < dof; ++mass) {
    double peak = 0.0, difference = 0.0, time = 0.0, from = INFINITY;
    for (const auto& at : rows)
      peak = std::max({peak, std::abs(a.u[at[0] * dof + mass]), std::abs(b.u[at[1] * dof + mass])});
    for (const auto& at : rows) {
      const double off = std::abs(a.u[at[0] * dof + mass] - b.u[at[1] * dof + mass]);
      if (off > visible_difference * peak) from = std::min(from, a.t[at[0]]);
      if (off > difference) {
        difference = off;
        time = a.t[at[0]];
      }
    }
    const double relative = peak > 0.0 ? difference / peak : 0.0;
    size = std::max(size, peak);
    visible = std::min(visible, from);
    if (relative > largest) {
      largest = relative;
      at_time = time;
    }
    masses.rows.push_back({(long long)(mass) + 1, difference, relative, time,
                           std::isfinite(from) ? record::Cell(from) : record::Cell()});
  }
  AgainstResult result;
  result.is_within = !request.tolerance || largest <= *request.tolerance;
  masses.title = fmt::format(
      "The two differ by up to {} of the largest displacement, at t = {} s; {}. {}{} "
      "common times, nothing interpolated. Agreement is no proof: both may be wrong the "
      "same way.",
      scientific(largest), short_number(at_time, 3),
      std::isfinite(visible) ? fmt::format("first by more than {} at t = {} s", visible_difference,
                                           short_number(visible, 3))
                             : fmt::format("nowhere by more than {}", visible_difference),
      !request.tolerance ? ""
                         : fmt::format("{} the tolerance of {}. ",
                                       result.is_within ? "Within" : "Beyond", *request.tolerance),
      rows.size());
  record::Sheet sets{"clackers/self-convergence/1",
                     "Each set by itself, from the differences between its histories",
                     {{"set", "", "before or behind --against"},
                      {"histories", "", ""},
                      {"finest", "", "step [s] or tolerance"},
                      {"order", "", "with which the differences fall"},
                      {"±", "", "half width of the order's 95 % interval"},
                      {"behaviour", "", "of the differences"}},
                     {}};
  if (size > 0.0) sets.rows = {self_row("first", first, size), self_row("second", second, size)};
  result.sheets = {std::move(masses), std::move(sets)};
  return result;
}

}  // namespace clackers::study
