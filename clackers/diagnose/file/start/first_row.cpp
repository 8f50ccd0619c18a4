#include "clackers/diagnose/file/start/first_row.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/numerics/linear_algebra.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace clackers::diagnose {
namespace {

constexpr double exact_tolerance = 1e-6;

std::vector<double> numbers_of(const model::Trajectory& rows, std::size_t row) {
  const auto masses = std::size_t(rows.dof);
  std::vector<double> numbers(rows.u.begin() + std::ptrdiff_t(row * masses),
                              rows.u.begin() + std::ptrdiff_t((row + 1) * masses));
  if (!rows.v.empty())
    numbers.insert(numbers.end(), rows.v.begin() + std::ptrdiff_t(row * masses),
                   rows.v.begin() + std::ptrdiff_t((row + 1) * masses));
  return numbers;
}

// At most 200 of the rows in the first nine tenths of the flight up to the first impact.
model::Trajectory flight_rows(const model::Trajectory& rows, const model::Motion& motion) {
  constexpr double part = 0.9;
  constexpr std::size_t most = 200;
  const double end = motion.impact_count(motion.end()) > 0 ? motion.impact(1).t : motion.end();
  const auto last = std::ranges::upper_bound(rows.t, part * end);
  const auto count = std::size_t(last - rows.t.begin());
  const auto stride = std::max<std::size_t>(1, count / most);
  const auto masses = std::size_t(rows.dof);
  model::Trajectory flight;
  flight.dof = rows.dof;
  for (std::size_t row = 0; row < count; row += stride) {
    const auto numbers = numbers_of(rows, row);
    flight.t.push_back(rows.t[row]);
    const auto middle = numbers.begin() + std::ptrdiff_t(masses);
    flight.u.insert(flight.u.end(), numbers.begin(), middle);
    flight.v.insert(flight.v.end(), middle, numbers.end());
  }
  return flight;
}

}  // namespace

FirstRow::FirstRow(const FirstRows& opening, const model::ImpactProblem<>& problem,
                   const model::Motion& motion)
    : opening_(opening),
      problem_(problem),
      motion_(motion),
      masses_(std::size_t(opening.rows.dof)),
      step_(opening.step),
      tolerance_(exact_tolerance + 2.0 * opening.printed_floor),
      given_(numbers_of(opening.rows, 0)),
      flight_(flight_rows(opening.rows, motion)),
      reference_(reference_rows(motion, flight_.t, !flight_.v.empty())) {
  const auto& t = opening.rows.t;
  if (!(step_ > 0.0) && t.size() > 1) step_ = t[1] - t[0];
  for (std::size_t mass = 0; mass < masses_; ++mass)
    if (mass < opening.has_u.size() && !opening.has_u[mass]) given_[mass] = unknown;
  expected_ = state_at(time());
  const auto scale = motion.peak();
  for (std::size_t q = 0; q < given_.size(); ++q) {
    const auto mass = Eigen::Index(q % masses_);
    scale_.push_back(q < masses_ ? scale.u[mass] : scale.v[mass]);
  }
}

bool FirstRow::complete() const {
  return std::ranges::none_of(given_, [](double x) { return std::isnan(x); });
}

double FirstRow::distance(const std::vector<double>& numbers,
                          const std::vector<double>& state) const {
  double largest = 0.0;
  for (std::size_t q = 0; q < numbers.size(); ++q)
    largest = std::fmax(largest, std::abs(numbers[q] - state[q]) / scale_[q]);
  return largest;
}

std::vector<double> FirstRow::state_at(double t) const {
  return numbers_of(reference_rows(motion_, {&t, 1}, has_v()), 0);
}

double FirstRow::flight_distance(const Reading& reading) const {
  if (flight_.t.size() < 3 || !complete()) return unknown;
  const auto rows = read_as(reading, flight_);
  double sum = 0.0;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    const auto found = numbers_of(rows, row), truth = numbers_of(reference_, row);
    for (std::size_t q = 0; q < found.size(); ++q) {
      const double part = (found[q] - truth[q]) / scale_[q];
      sum += part * part;
    }
  }
  return std::sqrt(sum / double(rows.t.size() * given_.size()));
}

double FirstRow::flight_distance(std::span<const double> u) const {
  if (flight_.t.size() < 3 || !complete()) return unknown;
  double sum = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double part = (flight_.u[i] - u[i]) / scale_[i % masses_];
    sum += part * part;
  }
  return std::sqrt(sum / double(u.size()));
}

double FirstRow::flight_distance(const model::Motion& other) const {
  return flight_distance(reference_rows(other, flight_.t, false).u);
}

// Runge-Kutta's method of fourth order with steps of a hundredth of the fastest rate of change:
// local errors of 1e-11.
double FirstRow::own_flight_distance() const {
  if (!has_v() || !complete()) return unknown;
  const auto& system = problem_.system;
  const auto size = Eigen::Index(masses_);
  const Eigen::MatrixXd inverse = numerics::inverse(system.mass);
  const Eigen::MatrixXd stiffness = inverse * system.stiffness, damping = inverse * system.damping;
  const double rate = std::max(std::sqrt(stiffness.cwiseAbs().rowwise().sum().maxCoeff()),
                               damping.cwiseAbs().rowwise().sum().maxCoeff());
  Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(given_.data(), 2 * size);
  const auto derivative = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd d(2 * size);
    d << x.tail(size), -stiffness * x.head(size) - damping * x.tail(size);
    return d;
  };
  std::vector<double> u;
  double t = time();
  for (const double next : flight_.t) {
    const double steps = std::ceil((next - t) * 100.0 * rate),
                 h = (next - t) / std::max(steps, 1.0);
    for (double step = 0.0; step < steps; ++step) {
      const Eigen::VectorXd k1 = derivative(state), k2 = derivative(state + 0.5 * h * k1),
                            k3 = derivative(state + 0.5 * h * k2), k4 = derivative(state + h * k3);
      state += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    t = next;
    u.insert(u.end(), state.data(), state.data() + size);
  }
  return flight_distance(u);
}

}  // namespace clackers::diagnose
