#include "clackers/exact/friction/oblique_disk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {

using Eigen::VectorXd;
using model::Side;
using numerics::Bounded, numerics::narrowed, numerics::Wide;

namespace {

// Beyond, more than 1e5 impacts are within the run.
constexpr double largest_eta = 0.9995;

// How often eta has to be multiplied until a share is left, give or take one.
long long powers(const Wide& share, double eta) {
  const long double left = static_cast<long double>(share.value);
  if (eta == 0.0 || !(left > 0.0L)) return 0;
  return static_cast<long long>(
      std::floor(std::log(left) / std::log(static_cast<long double>(eta))));
}

}  // namespace

ObliqueDisk::ObliqueDisk(const ObliqueDiskParameters& p, std::string_view who)
    : p_(p), once_(Wide(1.0) - Wide(p.eta)) {
  if (!(p.eta >= 0.0 && p.eta <= largest_eta))
    refuse(who, "eta", p.eta, fmt::format("0 <= eta <= {}", largest_eta),
           p.eta <= 1.0 ? "It would hardly come to rest, after more than 1e5 impacts." : "");
  if (!(p.h0 > 0.0 || p.v0 > 0.0))
    refuse(who, "v0", p.v0, "v0 > 0 where h0 = 0", "It starts on the floor.");
  const Wide v0 = p.v0, g = p.g, inertia = p.beta, more = Wide(1.0) + Wide(1.0) / inertia;
  V_ = sqrt(v0 * v0 + Wide(2.0) * g * Wide(p.h0));
  first_ = (v0 + V_) / g;
  const Wide rest = start(-1);
  last_ = std::max(1LL, 1 + powers(Wide(0x1p-56) * rest * g * once_ / (Wide(2.0) * V_), p.eta));

  const Wide slip = Wide(p.vx0) + Wide(p.w0), sign = slip.value < 0 ? -1.0 : 1.0;
  friction_ = sign * Wide(p.mu) * (Wide(1.0) + Wide(p.eta)) * V_;
  loss_ = slip / more;
  // What is left of the slip if friction acts at all impacts.
  const Wide left = sign * (slip - more * friction_ / once_);
  if (slip.value != 0 && left.value >= 0) {
    slides_ = last_ + 1;
    slip_end_ = left / (Wide(p.mu) * g * more);
  } else if (left.value < 0) {
    const auto slides = [&](long long j) {
      return (sign * (slip - more * friction_ * (Wide(1.0) - power(j)) / once_)).value > 0;
    };
    const auto estimate = powers(-left * once_ / (sign * more * friction_), p.eta);
    slides_ = std::clamp(estimate - 1, 0LL, last_);
    while (slides_ < last_ && slides(slides_ + 1)) ++slides_;
  }

  problem_.system.mass = Eigen::Vector3d(1.0, 1.0, p.beta).asDiagonal();
  problem_.system.damping = problem_.system.stiffness = Eigen::Matrix3d::Zero();
  problem_.system.add_load = model::HarmonicLoad({{1, -p.g, 0.0, 0.0}});
  problem_.contacts = {{VectorXd::Unit(3, 1), 0.0, p.eta}};
  problem_.start = {0.0, Eigen::Vector3d(0.0, p.h0, 0.0), Eigen::Vector3d(p.vx0, p.v0, p.w0)};
  problem_.end = p.end;
  problem_.unstated = fmt::format(
      "friction on the floor (Coulomb's law, mu = {}, of impulses at the impacts and of forces after them, between "
      "contact 1 and the slip v1 + v3)",
      p.mu);
}

double ObliqueDisk::slides() const { return slides_ > last_ ? HUGE_VAL : double(slides_); }
double ObliqueDisk::rolls() const { return instant(slides_ + 1).nearest(); }

Wide ObliqueDisk::power(long long k) const {
  if (k < 0 || k > last_) return 0.0;
  Wide result = 1.0, square = p_.eta;
  for (; k > 0; k /= 2, square = square * square)
    if (k % 2 == 1) result = result * square;
  return result;
}

// Flight -1 stands for the end of all.
Wide ObliqueDisk::start(long long k) const {
  if (k == 0) return 0.0;
  const auto flights = first_ + Wide(2.0) * V_ / Wide(p_.g) * (Wide(p_.eta) - power(k)) / once_;
  return k > last_ + 1 ? flights + slip_end_ : flights;
}

Wide ObliqueDisk::lost(long long k) const {
  if (k == 0) return 0.0;
  return k <= slides_ ? friction_ * (Wide(1.0) - power(k)) / once_ : loss_;
}

Wide ObliqueDisk::behind(long long k) const {
  if (k == 0) return 0.0;
  if (k > last_ + 1)
    return behind(last_ + 1) +
           (lost(last_ + 1) + loss_) * Wide(0.5) * slip_end_;  // evenly decelerated
  const Wide eta = p_.eta, until = power(k), sliding = k <= slides_ ? until : eta * power(slides_);
  const auto once = (eta - sliding) / once_,
             twice = (eta * eta - sliding * sliding) / (Wide(1.0) - eta * eta);
  return Wide(2.0) * V_ / Wide(p_.g) * (friction_ * (once - twice) + loss_ * (sliding - until)) /
         once_;
}

Bounded ObliqueDisk::instant(long long k) const {
  return k > last_ + 2 ? Bounded(HUGE_VAL) : narrowed(start(k));
}

auto ObliqueDisk::along(long long k, const Wide& share, double velocity) const -> MassState {
  const Wide force =
      k == last_ + 1 ? share * Wide(friction_.value < 0 ? p_.mu : -p_.mu) * Wide(p_.g) : 0.0;
  return {narrowed(Wide(velocity) * start(k) - share * behind(k)),
          narrowed(Wide(velocity) - share * lost(k)), narrowed(force)};
}

auto ObliqueDisk::state(long long k, const Bounded& s) const -> States {
  const bool flies = k <= last_;
  const Bounded g = flies ? p_.g : 0.0;
  const MassState height =
      k == 0 ? MassState{p_.h0, p_.v0, -g} : MassState{0.0, narrowed(power(k) * V_), -g};
  States now{{along(k, 1.0, p_.vx0), height, along(k, Wide(1.0) / Wide(p_.beta), p_.w0)}};
  for (auto& [u, v, a] : now) {
    u = u + s * (v + Bounded(0.5) * a * s);
    v = v + a * s;
  }
  return now;
}

long long ObliqueDisk::near_flight(double t) const {
  const auto left = (start(-1) - Wide(t)) * Wide(p_.g) * once_ / (Wide(2.0) * V_);
  return left.value > 0 ? std::clamp(powers(left, p_.eta), 0LL, last_) : last_ + 1;
}

auto ObliqueDisk::limits(long long k) const -> Limits {
  const auto share = Wide(1.0) / Wide(p_.beta);
  Limits limit{};
  for (const bool after : {false, true}) {
    auto& now = after ? limit.after : limit.before;
    const long long flight = after ? k : k - 1;
    const auto speed = narrowed(power(k - (after ? 0 : 1)) * V_);
    now = {{along(k, 1.0, p_.vx0), {0.0, after ? speed : -speed, -p_.g}, along(k, share, p_.w0)}};
    now[0].v = along(flight, 1.0, p_.vx0).v;
    now[2].v = along(flight, share, p_.w0).v;
  }
  limit.impulse = narrowed((Wide(1.0) + Wide(p_.eta)) * power(k - 1) * V_);
  return limit;
}

model::Kinematics ObliqueDisk::envelope(double t) const {
  model::require_inside("motion", t, end());
  const double V = speed(), v = std::max(std::abs(p_.vx0), std::abs(rolling_speed())),
               w = std::max(std::abs(p_.w0), std::abs(rolling_speed()));
  // What stands still along the floor has the size of the jumps.
  const Eigen::Vector3d speeds(v > 0.0 ? v : V, V, w > 0.0 ? w : V);
  const double height = V * V / (2.0 * p_.g);
  return {Eigen::Vector3d(speeds[0] * end(), height, speeds[2] * end()), speeds,
          Eigen::Vector3d(p_.g, p_.g, p_.g)};
}

long long ObliqueDisk::impact_count(double t) const {
  return std::min(last_, Flights::impact_count(t));
}

std::vector<model::ClosedContact> ObliqueDisk::closed_contacts() const {
  const auto begins = rest();
  const double from = begins.nearest(), reach = begins.nearest_error();
  if (from > end()) return {};
  return {{0,
           from,
           end(),
           {from - reach, from + reach},
           false,
           p_.eta > 0.0,
           instant(last_).nearest()}};
}

VectorXd ObliqueDisk::contact_forces(double t, Side side) const {
  return VectorXd::Constant(1, flight_at(t, side) > last_ ? p_.g : 0.0);
}

}  // namespace clackers::exact
