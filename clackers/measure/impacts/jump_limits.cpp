#include "clackers/measure/impacts/impact_finder.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::measure {
namespace {

bool is_known(const std::vector<double>& entries, int dof) {
  return std::ssize(entries) == dof &&
         std::ranges::all_of(entries, [](double x) { return std::isfinite(x); });
}

struct ReportedJump {
  const model::Impact* first;
  const model::Impact* last;
};

// Complete impacts within the history, in order of time, those of one time together.
std::vector<ReportedJump> jumps(const model::Trajectory& history) {
  std::vector<const model::Impact*> known;
  for (const auto& impact : *history.impacts)
    if (impact.t >= history.t.front() && impact.t <= history.t.back() &&
        is_known(impact.u, history.dof) && is_known(impact.v_before, history.dof) &&
        is_known(impact.v_after, history.dof))
      known.push_back(&impact);
  std::ranges::stable_sort(known, {}, &model::Impact::t);
  std::vector<ReportedJump> found;
  for (const auto* impact : known) {
    if (!found.empty() && found.back().last->t == impact->t)
      found.back().last = impact;
    else
      found.push_back({impact, impact});
  }
  return found;
}

class WidenedRows {
 public:
  WidenedRows(const model::Trajectory& from, std::size_t more)
      : from_(from), dof_(std::size_t(from.dof)) {
    to_.dof = from.dof;
    to_.t.reserve(from.t.size() + more);
    to_.u.reserve(from.u.size() + more * dof_);
    to_.v.reserve(from.v.size() + more * dof_);
  }
  void copy(std::size_t first, std::size_t last) {
    const auto take = [](const auto& source, auto& target, std::size_t begin, std::size_t end) {
      target.insert(target.end(), source.begin() + std::ptrdiff_t(begin),
                    source.begin() + std::ptrdiff_t(end));
    };
    take(from_.t, to_.t, first, last);
    take(from_.u, to_.u, first * dof_, last * dof_);
    take(from_.v, to_.v, first * dof_, last * dof_);
  }
  void add(const model::Impact& impact, const std::vector<double>& v) {
    to_.t.push_back(impact.t);
    to_.u.insert(to_.u.end(), impact.u.begin(), impact.u.end());
    to_.v.insert(to_.v.end(), v.begin(), v.end());
  }
  model::Trajectory take() {
    to_.impacts = from_.impacts;
    return std::move(to_);
  }

 private:
  const model::Trajectory& from_;
  std::size_t dof_;
  model::Trajectory to_;
};

}  // namespace

std::optional<model::Trajectory> with_jump_limits(const model::Trajectory& history) {
  if (!history.impacts || history.v.empty() || !history.a.empty() || history.t.empty()) return {};
  const auto all = jumps(history);
  if (all.empty()) return {};
  WidenedRows rows(history, 2 * all.size());
  std::size_t done = 0;
  bool added = false;
  for (const auto& [first, last] : all) {
    const auto [from, to] =
        std::equal_range(history.t.begin() + std::ptrdiff_t(done), history.t.end(), first->t);
    rows.copy(done, std::size_t(from - history.t.begin()));
    done = std::size_t(to - history.t.begin());
    if (to - from == 2) {
      rows.copy(done - 2, done);
      continue;
    }
    rows.add(*first, first->v_before);
    rows.add(*last, last->v_after);
    added = true;
  }
  if (!added) return {};
  rows.copy(done, history.t.size());
  return rows.take();
}

}  // namespace clackers::measure
