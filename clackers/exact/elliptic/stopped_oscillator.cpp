#include "clackers/exact/elliptic/stopped_oscillator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/nonlinear_springs.hpp"

namespace clackers::exact {

using numerics::Bounded;
using Law = model::NonlinearSprings::Law;

namespace {

constexpr std::size_t most_flights = 100'000;

Eigen::VectorXd scalar(double x) { return Eigen::VectorXd::Constant(1, x); }

}  // namespace

StoppedOscillator::StoppedOscillator(double m, double eta, double end) : eta_(eta) {
  problem_.system.mass = scalar(m);
  problem_.system.damping = problem_.system.stiffness = scalar(0.0);
  problem_.contacts = {{scalar(1.0), 0.0, eta}};
  problem_.start = {0.0, scalar(0.0), scalar(0.0)};
  problem_.end = end;
}

template <class Make>
void StoppedOscillator::follow(std::string_view who, const Flight& first, const Make& make) {
  flights_ = {first};
  first_ = quarter_period(first.modulus) / first.frequency;
  flights_[0].start = -first_;
  auto start = first_, speed = first.speed;
  while (true) {
    speed = Bounded(eta_) * speed;
    auto next = make(speed);
    next.start = start;
    flights_.push_back(next);
    if (start.value > problem_.end) return;
    if (flights_.size() > most_flights)
      throw InputError(fmt::format("{}: more than {} impacts up to t_end = {}; allowed: at most so "
                                   "many. End the run earlier.",
                                   who, most_flights, problem_.end),
                       "out-of-range");
    start = start + Bounded(2.0) * quarter_period(next.modulus) / next.frequency;
  }
}

Bounded StoppedOscillator::instant(long long k) const {
  return k < std::ssize(flights_) ? flights_[std::size_t(k)].start : Bounded(INFINITY);
}

long long StoppedOscillator::near_flight(double t) const {
  const auto after = std::ranges::upper_bound(flights_, static_cast<long double>(t), {},
                                              [](const Flight& f) { return f.start.value; });
  return std::max<std::ptrdiff_t>(0, after - flights_.begin() - 1);
}

auto StoppedOscillator::limits(long long k) const -> Limits {
  const auto& before = flights_[std::size_t(k - 1)].speed;
  const auto after = Bounded(eta_) * before, a = acceleration(0.0);
  return {{{{0.0, -before, a}}},
          {{{0.0, after, a}}},
          Bounded(problem_.system.mass(0, 0)) * (before + after)};
}

model::Kinematics StoppedOscillator::envelope(double t) const {
  const auto& now = flights_[std::size_t(flight_at(t, model::Side::left))];
  return {scalar(now.size.nearest()), scalar(now.speed.nearest()),
          scalar(std::abs(acceleration(now.size).nearest()))};
}

Pendulum::Pendulum(const PendulumParameters& p, std::string_view who)
    : StoppedOscillator(1.0, p.eta, p.end), l_(p.l), g_(p.g), w_(sqrt(g_ / l_)) {
  problem_.system.nonlinear =
      std::make_shared<model::NonlinearSprings>(std::vector<model::NonlinearSprings::Row>{
          {scalar(1.0), Law::sine, (g_ / l_).nearest(), p.l}});
  auto first = flight_of(Swing::of_angle(l_, w_, p.theta0));
  first.size = l_ * Bounded(p.theta0);
  problem_.start.u[0] = first.size.nearest();
  follow(who, first, [this](const Bounded& v) { return flight_of(Swing::of_speed(l_, w_, v)); });
}

auto Pendulum::flight_of(const Swing& swing) const -> Flight {
  return {0.0, swing.speed(), swing.modulus, w_, swing.arc()};
}

model::Kinematics Pendulum::envelope(double t) const {
  auto size = StoppedOscillator::envelope(t);
  // Beyond a quarter turn the weight is largest on the way.
  if (size.u[0] > 1.5707 * l_.nearest()) size.a[0] = g_.nearest();
  return size;
}

Bounded Pendulum::acceleration(const Bounded& u) const { return -(g_ * sin(u / l_)); }

auto Pendulum::state(long long k, const Bounded& s) const -> States {
  return {{Swing{l_, w_, flights_[std::size_t(k)].modulus}.at(s)}};
}

Duffing::Duffing(const DuffingParameters& p, std::string_view who)
    : StoppedOscillator(p.m, p.eta, p.end),
      square_(Bounded(p.k) / Bounded(p.m)),
      cubic_(Bounded(p.b) / Bounded(p.m)) {
  if (p.b < 0.0 && !(-p.b * p.u0 * p.u0 < p.k))
    refuse(who, "b", p.b, fmt::format("b > -k/u0^2 = {}", -p.k / (p.u0 * p.u0)),
           "At the start the spring would pull away from the stop.", "not-admissible");
  problem_.system.stiffness(0, 0) = p.k;
  problem_.system.nonlinear = std::make_shared<model::NonlinearSprings>(
      std::vector<model::NonlinearSprings::Row>{{scalar(1.0), Law::cubic, p.b, 0.0}});
  problem_.start.u[0] = p.u0;
  const Bounded A = p.u0;
  const auto speed = A * sqrt(square_ + Bounded(0.5) * cubic_ * A * A);
  follow(who, flight_of(A, speed), [this](const Bounded& v) { return flight(v); });
}

// The amplitude of a speed, without cancellation for either sign of b.
auto Duffing::flight(const Bounded& speed) const -> Flight {
  const auto v = speed * speed;
  const auto root = sqrt(square_ * square_ + Bounded(2.0) * cubic_ * v);
  return flight_of(sqrt(Bounded(2.0) * v / (square_ + root)), speed);
}

auto Duffing::flight_of(const Bounded& A, const Bounded& speed) const -> Flight {
  const auto force = cubic_ * A * A, half = Bounded(0.5) * force;
  // Of a softening spring force/2 is negative.
  const auto L2 = cubic_.value < 0.0L ? square_ + half : square_ + force;
  const auto k2 = cubic_.value < 0.0L ? -half / L2 : half / L2;
  const auto rest = cubic_.value < 0.0L ? (square_ + force) / L2 : (square_ + half) / L2;
  return {0.0, speed, {sqrt(k2), sqrt(rest)}, sqrt(L2), A};
}

Bounded Duffing::acceleration(const Bounded& u) const {
  return -(square_ * u + cubic_ * u * u * u);
}

auto Duffing::state(long long k, const Bounded& s) const -> States {
  const auto& now = flights_[std::size_t(k)];
  const auto [sn, cn, dn] = jacobi(now.frequency * s, now.modulus);
  const auto rate = now.size * now.frequency;
  Bounded u = now.size * sn, v = rate * cn * dn;
  if (cubic_.value > 0.0L) {
    const auto& c = now.modulus.complement;
    u = c * u / dn;
    v = c * rate * cn / (dn * dn);
  }
  return {{{u, v, acceleration(u)}}};
}

}  // namespace clackers::exact
