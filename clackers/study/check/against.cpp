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
#include "clackers/record/reduced_curve.hpp"
#include "clackers/study/check/named_resolution.hpp"

namespace clackers::study {
namespace {

constexpr auto against_name = "check --against";

struct HistoryLevel {
  input::History history;
  double step = 0.0;  ///< or a tolerance
};
using Levels = std::vector<HistoryLevel>;  // coarsest first

// The largest number behind u in the names of a file's columns.
int masses_of(const input::Source& source, input::HistoryOptions options) {
  int masses = 1;
  options.results.most_nodes = std::numeric_limits<int>::max();
  for (const auto& name : input::read_history(source, options).names)
    if (name.size() > 1 && (name[0] == 'u' || name[0] == 'U'))
      masses = std::max(masses, int(finite_number(std::string_view(name).substr(1)).value_or(1.0)));
  return masses;
}

// `given`: none, or the step or tolerance of each; only a step is the time between rows without times.
Levels read_levels(const std::vector<input::Source>& files, std::span<const double> given,
                   bool by_step, input::HistoryOptions options) {
  Levels levels;
  std::vector<NamedHistory> set;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const double step = given.empty() ? 0.0 : given[i];
    options.step = by_step ? step : 0.0;
    auto& level = levels.emplace_back(HistoryLevel{input::read_history(files[i], options), step});
    if (const auto lacking = std::ranges::find(level.history.has_u, false);
        lacking != level.history.has_u.end())
      refuse(against_name, input::name_of(files[i]),
             fmt::format("no u{}", lacking - level.history.has_u.begin() + 1),
             fmt::format("the displacements of all {} masses", options.dof), {}, "no-column");
    set.push_back({named_resolution(input::name_of(files[i])), level.history.spacing});
  }
  const double end = levels.front().history.motion.t.back();
  const auto named = named_steps(set, std::numeric_limits<double>::infinity(), end);
  if (given.empty())
    for (std::size_t i = 0; i < levels.size(); ++i)
      levels[i].step = named.steps[i].value_or(set[i].spacing);
  std::ranges::stable_sort(levels, std::greater{}, &HistoryLevel::step);
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

// Which part was compared, where a history has more; empty where that is all.
std::string part_text(const input::History& first, const input::History& second,
                      const std::vector<std::vector<std::size_t>>& rows) {
  const auto& t = first.motion.t;
  std::vector<double> gaps;
  for (std::size_t k = 1; k < rows.size(); ++k) gaps.push_back(t[rows[k][0]] - t[rows[k - 1][0]]);
  const auto middle = gaps.begin() + std::ssize(gaps) / 2;
  std::ranges::nth_element(gaps, middle);
  const double from = t[rows.front()[0]], to = t[rows.back()[0]];
  // Histories of two steps end up to a step apart.
  const double slack = 2.0 * std::max({*middle, first.spacing, second.spacing});
  std::string longer;
  for (const auto& [name, times] : {std::pair{"first", &t}, {"second", &second.motion.t}})
    if (times->front() < from - slack || times->back() > to + slack)
      longer += fmt::format("; the {} set goes from {:.6g} to {:.6g} s", name, times->front(),
                            times->back());
  return longer.empty()
             ? longer
             : fmt::format(" Compared from {:.6g} to {:.6g} s only{}.", from, to, longer);
}

// Of times in thousandths or millionths of a second in one of the two.
std::string time_unit_hint(double first, double second) {
  constexpr double slack = 0.02;
  const double ratio = std::max(first, second) / std::min(first, second);
  for (const double factor : {1e3, 1e6})
    if (std::abs(ratio / factor - 1.0) < slack)
      return fmt::format(
          " The times of the first go up to {:.6g} and those of the second to {:.6g}, a factor of "
          "{:g}: both must be in seconds.",
          first, second, factor);
  return {};
}

// The first and the last file of each set, without folders where that tells the sets apart.
std::array<std::string, 2> set_names(const std::array<std::vector<input::Source>, 2>& sets) {
  std::array<std::string, 2> whole, brief;
  for (std::size_t set = 0; set < sets.size(); ++set) {
    whole[set] = input::name_of(sets[set].front());
    brief[set] = whole[set].substr(whole[set].find_last_of('/') + 1);
    if (sets[set].size() == 1) continue;
    const auto last = input::name_of(sets[set].back());
    whole[set] += " ... " + last;
    brief[set] += " ... " + last.substr(last.find_last_of('/') + 1);
  }
  return brief[0] != brief[1] ? brief : whole;
}

// The differences between levels at the times that all of them have.
std::vector<record::Cell> self_row(std::string name, const Levels& levels, double size) {
  constexpr std::size_t least_levels = 5;
  std::vector<const model::Trajectory*> histories;
  double least = INFINITY, most = 0.0;  // ratio of steps
  for (std::size_t i = 0; i < levels.size(); ++i) {
    histories.push_back(&levels[i].history.motion);
    if (i == 0) continue;
    least = std::min(least, levels[i - 1].step / levels[i].step);
    most = std::max(most, levels[i - 1].step / levels[i].step);
  }
  std::vector<record::Cell> row{std::move(name), (long long)(levels.size()), levels.back().step};
  row.resize(5);
  row.emplace_back("five histories with one ratio of steps give an order");
  if (levels.size() < least_levels || !(least > 1.0 && most <= 1.01 * least)) return row;
  const auto rows = common_rows(histories);
  std::vector<judge::ResponseLevel> runs;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    judge::Response run{levels[k].step, {}, std::numeric_limits<double>::epsilon() * size};
    const auto dof = std::size_t(histories[k]->dof);
    for (const auto& at : rows)
      for (std::size_t mass = 0; mass < dof; ++mass)
        run.values.push_back(histories[k]->u[at[k] * dof + mass]);
    runs.push_back({std::move(run)});
  }
  const auto fit = judge::self_convergence(runs, {.size = size}).differences;
  row.back() = std::string(to_string(fit.behaviour));
  if (fit.has_line) row[3] = fit.order, row[4] = fit.spread;
  return row;
}

// The differences of the rows of two histories over the displacement of each mass; none that is zero.
record::Sheet difference_curves(const model::Trajectory& a, const model::Trajectory& b,
                                const std::vector<std::vector<std::size_t>>& rows,
                                const std::vector<double>& peaks) {
  constexpr std::size_t most_masses = 9;
  record::Sheet sheet{"clackers/difference/1",
                      "Differences at the common times",
                      {{"t", "s", "time t [s]"}},
                      {},
                      record::Axes{.log_y = true,
                                   .y = "|u - u'| over the largest |u|",
                                   .note = "Times without any difference are left out."}};
  const auto drawn = std::min(peaks.size(), most_masses);
  for (std::size_t mass = 1; mass <= drawn; ++mass)
    sheet.columns.push_back({fmt::format("u{}", mass), "", fmt::format("mass {}", mass)});
  if (drawn < peaks.size())
    sheet.curves->note += fmt::format(" Of {} masses the first {} are drawn.", peaks.size(), drawn);
  const auto relative = [&](std::size_t mass, std::size_t point) {
    const auto off =
        a.u[rows[point][0] * peaks.size() + mass] - b.u[rows[point][1] * peaks.size() + mass];
    return peaks[mass] > 0.0 ? std::abs(off) / peaks[mass] : 0.0;
  };
  for (const auto point : record::kept_points(rows.size(), drawn, relative)) {
    auto& row = sheet.rows.emplace_back(std::vector<record::Cell>{a.t[rows[point][0]]});
    for (std::size_t mass = 0; mass < drawn; ++mass) {
      const double off = relative(mass, point);
      row.push_back(off > 0.0 ? record::Cell(off) : record::Cell());
    }
  }
  return sheet;
}

}  // namespace

AgainstResult check_against(const AgainstRequest& request, const std::atomic<bool>* interrupt) {
  const auto& [ours, theirs] = request.sets;
  if (ours.empty() || theirs.empty())
    throw InputError("check --against needs a FILE before it and one behind it.", "bad-syntax");
  const bool by_step = request.tolerances.empty();
  const std::span given = by_step ? request.steps : request.tolerances;
  if (!by_step && !request.steps.empty())
    throw InputError("check: --steps and --tolerances; allowed: one of them.", "bad-syntax");
  if (!given.empty() && given.size() != ours.size() + theirs.size())
    refuse(against_name, by_step ? "--steps" : "--tolerances",
           fmt::format("{} of them", given.size()),
           fmt::format("one a history, {} here, in the same order", ours.size() + theirs.size()),
           {}, "wrong-size");
  if (path_of(ours.front()) == "-")
    refuse(against_name, "FILE", "-", "a file, since the first is read twice", {}, "bad-syntax");
  for (const double step : request.steps) require_step("check --steps", step);
  for (const double t : request.tolerances)
    if (!(t > 0.0 && t < 1.0)) refuse("check", "--tolerances", t, "0 < tolerance < 1");
  if (request.tolerance) require_positive("check", "--tolerance", *request.tolerance);
  input::HistoryOptions options{
      .columns = request.columns, .interrupt = interrupt, .results = request.results};
  if (!request.steps.empty()) options.step = request.steps.front();
  options.dof = masses_of(ours.front(), options);
  const auto middle = std::min(given.size(), ours.size());
  const auto first = read_levels(ours, given.first(middle), by_step, options);
  const auto second = read_levels(theirs, given.subspan(middle), by_step, options);

  const auto &a = first.back().history.motion, &b = second.back().history.motion;
  const auto rows = common_rows({&a, &b});
  if (rows.size() < least_common_times)
    refuse(against_name, "common times of the finest histories", double(rows.size()),
           fmt::format("{} or more", least_common_times),
           "Nothing is interpolated: write both at the same times." +
               time_unit_hint(a.t.back(), b.t.back()),
           "wrong-size");
  record::Sheet masses{"clackers/differences/1",
                       "",
                       {{"mass", "", "from 1"},
                        {"difference", "m", "largest over the common times"},
                        {"relative", "", "the same over the largest displacement of the mass"},
                        {"time", "s", "of the largest difference"},
                        {"since", "s", "first time of a relative difference above 1e-3"}},
                       {}};
  const auto dof = std::size_t(a.dof);
  double size = 0.0, largest = 0.0;
  std::vector<double> peaks;
  double first_visible = INFINITY;
  std::size_t first_mass = 0;
  for (std::size_t mass = 0; mass < dof; ++mass) {
    double peak = 0.0, difference = 0.0, time = 0.0;
    record::Cell since;
    for (const auto& at : rows)
      peak = std::max({peak, std::abs(a.u[at[0] * dof + mass]), std::abs(b.u[at[1] * dof + mass])});
    for (const auto& at : rows) {
      const double t = a.t[at[0]];
      const double off = std::abs(a.u[at[0] * dof + mass] - b.u[at[1] * dof + mass]);
      if (off > visible_difference * peak && since.index() == 0) {
        since = t;
        if (t < first_visible) first_visible = t, first_mass = mass + 1;
      }
      if (off > difference) difference = off, time = t;
    }
    const double relative = peak > 0.0 ? difference / peak : 0.0;
    peaks.push_back(peak);
    size = std::max(size, peak);
    largest = std::max(largest, relative);
    masses.rows.push_back({(long long)(mass) + 1, difference, relative, time, since});
  }
  AgainstResult result;
  const bool is_within = !request.tolerance || largest <= *request.tolerance;
  auto part = part_text(first.back().history, second.back().history, rows);
  result.is_within = is_within;
  if (request.tolerance && is_within && !part.empty()) {
    part += " The rest is undecided.";
    result.is_within.reset();
  }
  const auto limit = !request.tolerance
                         ? std::string()
                         : fmt::format(", {} the tolerance of {}", is_within ? "within" : "beyond",
                                       *request.tolerance);
  masses.title = fmt::format(
      "The two differ by up to {} of the largest displacement{}, at {} common times; nothing is "
      "interpolated.{} Agreement is no proof: both may be wrong the same way.",
      scientific(largest), limit, rows.size(), part);
  record::Sheet sets{"clackers/self-convergence/1",
                     "Each set by itself, from the differences between its histories",
                     {{"set", "", "its first and last history, in the order given"},
                      {"histories", "", ""},
                      {"finest", "", "step [s] or tolerance"},
                      {"order", "", "with which the differences fall"},
                      {"±", "", "half width of the order's 95 % interval"},
                      {"behaviour", "", "of the differences"}},
                     {}};
  const auto names = set_names(request.sets);
  if (size > 0.0) sets.rows = {self_row(names[0], first, size), self_row(names[1], second, size)};
  result.sheets = {std::move(masses), std::move(sets)};
  result.differences = difference_curves(a, b, rows, peaks);
  if (first_mass > 0) {
    result.differences.curves->marks = {first_visible};
    result.differences.curves->mark_text =
        fmt::format("first difference above {}, of mass {} at t = {:.6g} s", visible_difference,
                    first_mass, first_visible);
  }
  return result;
}

}  // namespace clackers::study
