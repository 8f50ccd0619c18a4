#include "clackers/diagnose/system/flight_fits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "clackers/measure/errors/mechanics.hpp"

namespace clackers::diagnose {
namespace {

using System = model::SmoothSystem<>;
using measure::FreeState;

// Pairs of neighbouring rows with no impact near them.
std::vector<std::size_t> flights_in(const model::Trajectory& rows, double longest) {
  constexpr std::size_t most = 300;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i + 1 < rows.t.size(); ++i) {
    const double s = rows.t[i + 1] - rows.t[i];
    if (!(s > 0.0) || s > longest) continue;
    const auto near = [&](const model::Impact& impact) {
      return impact.t > rows.t[i] - 3.0 * s && impact.t < rows.t[i + 1] + 3.0 * s;
    };
    if (!rows.impacts || std::ranges::none_of(*rows.impacts, near)) found.push_back(i);
  }
  if (found.size() <= most) return found;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < most; ++k) kept.push_back(found[k * found.size() / most]);
  return kept;
}

class Mover {
 public:
  Mover(const System& system, double fastest) : motion_(system), fastest_(fastest) {}
  FreeState moved(const FreeState& state, double s) const {
    return motion_.moved(state, s, 1 + int(std::abs(s) * fastest_ / 0.05));
  }

 private:
  measure::FreeMotion motion_;
  double fastest_;
};

}  // namespace

void FlightFits::move_flights(const Observation& seen, const System& system,
                              const std::vector<FlightChange>& changes) {
  const double fastest = measure::highest_frequency(system);
  const auto& whole = seen.sample;
  if (whole.v.empty()) return;
  const double longest = 0.5 / fastest;
  auto flights = flights_in(whole, longest);
  constexpr std::size_t enough = 40;
  const auto& rows = flights.size() < enough && !seen.opening.v.empty() ? seen.opening : whole;
  if (&rows != &whole) flights = flights_in(rows, longest);
  if (flights.size() < enough) return;
  const auto dof = system.dof();
  const Eigen::ArrayXd weight = system.mass.diagonal().array().sqrt();
  const auto moved = [&](const System& by) {
    const Mover mover(by, fastest);
    Eigen::VectorXd all(std::ssize(flights) * dof);
    for (std::size_t k = 0; k < flights.size(); ++k) {
      const auto i = flights[k];
      const double s = rows.t[i + 1] - rows.t[i];
      all.segment(Eigen::Index(k) * dof, dof) =
          mover.moved(measure::row_state(rows, i), s).v.array() * weight / s;
    }
    return all;
  };
  const Eigen::VectorXd right = moved(system);
  lack_.resize(right.size());
  for (std::size_t k = 0; k < flights.size(); ++k) {
    const auto i = flights[k];
    lack_.segment(Eigen::Index(k) * dof, dof) =
        measure::row_state(rows, i + 1).v.array() * weight / (rows.t[i + 1] - rows.t[i]);
  }
  lack_ -= right;
  const Mover mover(system, fastest);
  double over = 0.0, under = 0.0;
  for (const auto i : flights) {
    const double s = rows.t[i + 1] - rows.t[i];
    const auto from = measure::row_state(rows, i), to = measure::row_state(rows, i + 1);
    const Eigen::VectorXd way = s * from.v.array() * weight.square();
    over += way.dot(to.u - mover.moved(from, s).u);
    under += way.dot(s * from.v);
  }
  if (under > 0.0) excess_ = over / under;
  std::vector<Eigen::VectorXd> columns;
  constexpr double small = 1e-5;
  for (const auto& change : changes)
    for (const auto& parameter : change.parameters) {
      auto changed = system;
      parameter(changed, small);
      columns.emplace_back((moved(changed) - right) / small);
    }
  columns_.resize(right.size(), std::ssize(columns));
  for (std::size_t k = 0; k < columns.size(); ++k) columns_.col(Eigen::Index(k)) = columns[k];
}

FlightFits::FlightFits(const Observation& seen, const System& system,
                       const std::vector<FlightChange>& changes) {
  move_flights(seen, system, changes);
  for (const auto& change : changes) {
    first_.push_back(next_);
    next_ += std::ssize(change.parameters);
    count_.push_back(std::ssize(change.parameters));
  }
  if (!known()) return;
  gram_ = columns_.transpose() * columns_;
  onto_ = columns_.transpose() * lack_;
  square_ = lack_.squaredNorm();
}

Fitted FlightFits::of(std::vector<std::size_t> changes) const {
  std::vector<Eigen::Index> at;
  for (const auto change : changes)
    for (Eigen::Index k = 0; k < count_[change]; ++k) at.push_back(first_[change] + k);
  const Eigen::MatrixXd part = gram_(at, at);
  const numerics::Cholesky solver(part);
  Fitted found{std::move(changes), {}, {}, 0.0};
  if (!solver.is_definite(part, double(part.rows()) * std::numeric_limits<double>::epsilon()))
    return found;
  found.values = solver.solve(onto_(at));
  double left = (lack_ - columns_(Eigen::all, at) * found.values).squaredNorm();
  found.gain = std::sqrt(square_ / std::max(left, 1e-300));
  left /= double(lack_.size());
  found.uncertainty =
      (4.0 * left *
       solver.solve(Eigen::MatrixXd::Identity(part.rows(), part.rows())).diagonal().array())
          .sqrt();
  return found;
}

std::optional<Fitted> best_of(const FlightFits& fits, const std::vector<FlightChange>& changes) {
  constexpr double least_gain = 5.0, least_gain_of_two = 20.0, least_lead = 2.0;
  std::vector<Fitted> tried;
  const auto lead = [&](double least) -> std::optional<Fitted> {
    std::ranges::sort(tried, std::greater{}, &Fitted::gain);
    if (tried.empty() || tried.front().gain < least) return {};
    if (tried.size() > 1 && tried.front().gain < least_lead * tried[1].gain) return {};
    return tried.front();
  };
  for (std::size_t i = 0; i < changes.size(); ++i) tried.push_back(fits.of({i}));
  const auto one = lead(least_gain);
  const double gain_of_one = tried.empty() ? 0.0 : tried.front().gain;
  tried.clear();
  for (std::size_t i = 0; i < changes.size(); ++i)
    for (std::size_t j = i + 1; j < changes.size(); ++j)
      if (changes[i].cause.code != changes[j].cause.code || !changes[j].is_of_all)
        tried.push_back(fits.of({i, j}));
  // Two changes always leave less than one, and what the method's own error leaves is no change.
  constexpr double worth_two = 3.0, enough = 300.0;
  const auto two = lead(least_gain_of_two);
  return two && two->gain > worth_two * gain_of_one && gain_of_one < enough ? two : one;
}

}  // namespace clackers::diagnose
