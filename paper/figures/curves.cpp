#include "paper/figures/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "clackers/exact/flights/piecewise_motion.hpp"

namespace clackers::paper {
namespace {

// Of a curve in a panel, where its turns allow: what a picture keeps.
constexpr double wanted_points = 2800.0;

struct Instant {
  double t;
  model::Side side;
  long long impact = 0;  // its number; 0 between impacts
};

// From `from` to `to` in pieces of `dt`, the last one shorter; both ends included, seen from inside.
// `first` and `last` are the impacts at the ends, 0 for none.
void append_flight(double from, long long first, double to, long long last, double dt,
                   std::vector<Instant>& out) {
  const auto pieces = std::max(1.0, std::ceil((to - from) / dt * (1.0 - 1e-9)));
  for (double j = 0.0; j < pieces; ++j)
    out.push_back({from + j * dt, model::Side::right, j == 0.0 ? first : 0});
  out.push_back({to, model::Side::left, last});
}

// The displacement or velocity of mass i at an impact: the limit at the true instant, which lies
// beside the double nearest to it.
double limit(const model::Motion& motion, const Instant& when, Quantity quantity, Eigen::Index i) {
  const auto impact = motion.impact(when.impact);
  const auto& side = when.side == model::Side::left ? impact.before : impact.after;
  return quantity == Quantity::displacement ? side.u[i] : side.v[i];
}

// An impact lies (X theta = X pi/2) a whole number of pieces after each extremum of its flight.
std::vector<Instant> instants(const model::Motion& motion, double dt) {
  std::vector<Instant> out;
  double from = 0.0;
  const auto count = motion.impact_count(motion.end());
  for (long long k = 1; k <= count; ++k) {
    const double t = motion.impact(k).t;
    append_flight(from, k - 1, t, k, dt, out);
    from = t;
  }
  if (from < motion.end()) append_flight(from, count, motion.end(), 0, dt, out);
  return out;
}

}  // namespace

Series curve(const cases::Case& test_case, int mass, Quantity quantity, int points_per_half_turn) {
  const auto& motion = *test_case.motion;
  const auto i = std::size_t(mass - 1), dof = std::size_t(motion.dof());
  const auto dt = test_case.damped_periods.at(i) / (2.0 * points_per_half_turn);
  const auto when = instants(motion, dt);
  std::vector<double> times;
  for (const auto& item : when) times.push_back(item.t);
  std::vector<double> u[2], v[2], none;
  for (const auto side : {model::Side::left, model::Side::right}) {
    const auto s = std::size_t(side == model::Side::right);
    u[s].resize(times.size() * dof);
    v[s].resize(times.size() * dof);
    motion.sample(times, side, {u[s], v[s], none});
  }
  Series out{.name = dof == 1 ? "the mass" : "mass " + std::to_string(mass),
             .x = {},
             .y = {},
             .stroke = mass == 1 ? first_mass() : second_mass()};
  for (std::size_t k = 0; k < when.size(); ++k) {
    const auto s = std::size_t(when[k].side == model::Side::right);
    const auto& rows = quantity == Quantity::displacement ? u[s] : v[s];
    // Displacements do not jump, so one point is enough.
    if (quantity == Quantity::displacement && !out.x.empty() && out.x.back() == when[k].t) continue;
    out.x.push_back(when[k].t);
    out.y.push_back(when[k].impact > 0
                        ? limit(motion, when[k], quantity, static_cast<Eigen::Index>(i))
                        : rows[k * dof + i]);
  }
  return out;
}

Panel response_panel(const cases::Case& test_case, Quantity quantity, std::string label,
                     std::string note, std::vector<double> range) {
  Panel panel{std::move(label),
              std::move(note),
              time_axis(0.0, test_case.motion->end()),
              quantity == Quantity::displacement ? displacement_axis() : velocity_axis(),
              {}};
  if (!range.empty()) {
    panel.y.lowest = range.at(0);
    panel.y.highest = range.at(1);
  }
  for (int mass = 1; mass <= test_case.motion->dof(); ++mass) {
    const double half_turns =
        2.0 * test_case.motion->end() / test_case.damped_periods.at(std::size_t(mass - 1));
    const int points = std::clamp(int(wanted_points / half_turns), 10, 48);
    panel.series.push_back(curve(test_case, mass, quantity, points));
  }
  return panel;
}

Series without_contact(const cases::Case& test_case, int mass, const Series& like) {
  auto problem = test_case.problem;
  problem.contacts.clear();
  const exact::PiecewiseMotion motion(problem);
  Series out = like;
  std::ranges::transform(like.x, out.y.begin(),
                         [&](double t) { return motion.at(t, model::Side::right).u[mass - 1]; });
  return out;
}

double constant(const cases::Case& test_case, const std::string& name) {
  for (const auto* list : {&test_case.constants, &test_case.indicators})
    for (const auto& item : *list)
      if (item.name == name) return item.value;
  throw std::logic_error("no constant " + name);
}

}  // namespace clackers::paper
