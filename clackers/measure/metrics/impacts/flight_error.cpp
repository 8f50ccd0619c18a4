#include "clackers/measure/metrics/definitions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/measure/metrics/metric.hpp"

namespace clackers::measure {
namespace {

// From when to when a flight of the history lasts, and the true flight beside it.
struct Flight {
  double from, to;
  long long after;  // true impact; negative: none
  double shift;
};

std::vector<Flight> flights(const Comparison& comparison) {
  const auto& impacts = comparison.impacts();
  const auto start = comparison.history().t.front();
  const auto first = start > 0.0 ? comparison.reference().impact_count(start) : 0;
  std::vector<Flight> all{{-infinity, infinity, first, 0.0}};
  auto match = comparison.matches().begin();
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const double end = comparison.impact_ends()[k];
    all.back().to = impacts[k].t;
    all.push_back({end, infinity, -1, 0.0});
    if (match == comparison.matches().end() || match->found != k) continue;
    all.back().after = match->reference.index;
    all.back().shift = end - match->reference.t;
    ++match;
  }
  return all;
}

// Compares flights one by one; rows and flights are both passed once.
class FlightComparison {
 public:
  explicit FlightComparison(const Comparison& comparison)
      : c_(comparison), t_(c_.history().t), dof_(c_.dof()) {}

  void add(const Flight& flight, std::vector<FlightError>& errors) {
    rows_.clear();
    times_.clear();
    while (row_ < t_.size() && !follows(row_, flight.from)) ++row_;
    const auto first = row_;
    while (row_ < t_.size() && precedes(row_, flight.to)) ++row_;
    if (flight.after < 0) return;
    const auto last_impact = c_.reference().impact_count(c_.reference().end());
    const bool struck = flight.after > 0;
    const auto begin = struck ? c_.reference().impact(flight.after) : model::MotionImpact{};
    const double until = flight.after < last_impact ? c_.reference().impact(flight.after + 1).t
                                                    : c_.reference().end();
    FlightError error{flight.after, flight.shift, 0, std::vector<double>(dof_), {}};
    if (c_.has_velocities()) error.v.resize(dof_);
    for (auto i = first; i < row_; ++i) {
      // The limits of a jump are at contact, wherever the method thinks that is.
      if (!c_.is_left_limit(i) && !c_.is_right_limit(i) && is_closed(i)) continue;
      const double t = t_[i] - flight.shift;
      // The start itself is known to be one: rounding must not put it before the impact.
      if (struck && (t_[i] == flight.from || t == begin.t))
        take(error, i, begin.after.u.data(), begin.after.v.data());
      else if ((!struck || t > begin.t) && t <= until)
        rows_.push_back(i), times_.push_back(t);
    }
    take_sampled(error);
    if (error.rows > 0) errors.push_back(std::move(error));
  }

 private:
  // The rows after a time, and of two rows at that time the second.
  bool follows(std::size_t i, double from) const {
    return t_[i] > from || (t_[i] == from && c_.is_right_limit(i));
  }
  bool precedes(std::size_t i, double to) const {
    return t_[i] < to || (t_[i] == to && c_.is_left_limit(i));
  }

  // Displacements are right to a unit of their envelope, and so is their sum.
  bool is_closed(std::size_t i) const {
    for (const auto& contact : c_.problem().contacts) {
      double gap = -contact.gap, size = 0.0;
      for (std::size_t j = 0; j < dof_; ++j) {
        const double part = contact.direction[Eigen::Index(j)];
        gap += part * c_.history().u[i * dof_ + j];
        size += std::abs(part) * c_.u_envelope()[j];
      }
      if (gap < -2.0 * std::numeric_limits<double>::epsilon() * size) return true;
    }
    return false;
  }

  void take(FlightError& error, std::size_t row, const double* u, const double* v) const {
    ++error.rows;
    for (std::size_t j = 0; j < dof_; ++j) {
      error.u[j] = std::max(error.u[j], std::abs(c_.history().u[row * dof_ + j] - u[j]));
      if (!error.v.empty())
        error.v[j] = std::max(error.v[j], std::abs(c_.history().v[row * dof_ + j] - v[j]));
    }
  }

  void take_sampled(FlightError& error) {
    constexpr std::size_t block = 4096;
    u_.resize(block * dof_);
    v_.resize(block * dof_);
    for (std::size_t from = 0; from < times_.size(); from += block) {
      const auto count = std::min(block, times_.size() - from);
      c_.reference().sample(
          std::span(times_).subspan(from, count), model::Side::left,
          {std::span(u_).first(count * dof_), std::span(v_).first(count * dof_), {}});
      for (std::size_t i = 0; i < count; ++i)
        take(error, rows_[from + i], &u_[i * dof_], &v_[i * dof_]);
    }
  }

  const Comparison& c_;
  const std::vector<double>& t_;
  std::size_t dof_;
  std::size_t row_ = 0;
  std::vector<std::size_t> rows_;
  std::vector<double> times_, u_, v_;
};

MetricValue worst(const Comparison& comparison, std::vector<double> FlightError::*list) {
  std::vector<double> masses;
  for (const auto& flight : comparison.shared(flight_errors)) {
    masses.resize(comparison.dof());
    for (std::size_t j = 0; j < masses.size(); ++j)
      masses[j] = std::max(masses[j], (flight.*list)[j]);
  }
  if (masses.empty())
    return not_measured("No flight of the history could be laid beside a true one.");
  return measured(std::move(masses));
}

}  // namespace

std::vector<FlightError> flight_errors(const Comparison& comparison) {
  std::vector<FlightError> errors;
  FlightComparison comparing(comparison);
  for (const auto& flight : flights(comparison)) comparing.add(flight, errors);
  return errors;
}

MetricValue flight_u_error(const Comparison& comparison) {
  return worst(comparison, &FlightError::u);
}

MetricValue flight_v_error(const Comparison& comparison) {
  if (!comparison.has_velocities()) return not_measured(Comparison::no_velocities);
  return worst(comparison, &FlightError::v);
}

}  // namespace clackers::measure
