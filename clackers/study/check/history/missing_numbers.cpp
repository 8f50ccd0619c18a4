#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "clackers/input/history.hpp"
#include "clackers/record/notes.hpp"
#include "clackers/study/check/history/prepared_history.hpp"

namespace clackers::study {
namespace {

// Two masses that touch have one place: u1 - u2 = gap.
void complete_u(model::Impact& impact, const cases::Case& problem) {
  const auto& contacts = problem.problem.contacts;
  if (impact.u.size() != 2 || contacts.size() != 1) return;
  const auto& row = contacts.front();
  const bool first_known = std::isfinite(impact.u[0]);
  if (first_known && std::isfinite(impact.u[1])) return;
  const auto known = first_known ? 0 : 1, other = 1 - known;
  const double left = row.gap - row.direction[known] * impact.u[std::size_t(known)];
  impact.u[std::size_t(other)] = left / row.direction[other];
}

}  // namespace

void add_events(PreparedHistory& history, const input::Source& events, const cases::Case& problem,
                const std::atomic<bool>* interrupt) {
  if (problem.problem.has_unstated_impacts()) return;
  auto& m = history.data.motion;
  auto impacts = input::read_events(events, m.dof, int(problem.problem.contacts.size()), interrupt);
  const auto outside = [&](const model::Impact& i) {
    return i.t < m.t.front() || i.t > m.t.back();
  };
  if (!impacts.empty()) {
    constexpr double least_part = 0.5;  // of the run, by the last impact
    const auto kept = std::ranges::count_if(impacts, std::not_fn(outside));
    require_seconds(input::given_name(events), impacts.back().t,
                    double(kept) / double(impacts.size()), least_part, problem);
  }
  if (const auto left_out = std::erase_if(impacts, outside); left_out > 0)
    history.file.notes.push_back(record::note(
        "events-outside", {double(left_out), m.t.front(), m.t.back()}, input::given_name(events)));
  for (auto& impact : impacts) complete_u(impact, problem);
  m.impacts = std::move(impacts);
}

void complete_u(PreparedHistory& history, const cases::Case& problem) {
  auto& m = history.data.motion;
  const auto dof = std::size_t(m.dof);
  constexpr std::size_t block = 4096;
  std::vector<double> u, v;
  for (std::size_t from = 0; from < m.t.size(); from += block) {
    const auto times = std::span(m.t).subspan(from, std::min(block, m.t.size() - from));
    u.resize(times.size() * dof);
    v.resize(times.size() * dof);
    problem.motion->sample(times, model::Side::right, {u, v, {}});
    for (std::size_t i = 0; i < u.size(); ++i)
      if (!history.data.has_u[i % dof]) m.u[from * dof + i] = u[i];
  }
}

}  // namespace clackers::study
