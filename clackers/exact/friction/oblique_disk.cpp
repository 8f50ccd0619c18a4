#include "clackers/exact/friction/oblique_disk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {

using Eigen::VectorXd;
using model::Side;
using numerics::Bounded, numerics::Wide;

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

const ObliqueDiskParameters& checked(const ObliqueDiskParameters& p, std::string_view who) {
  if (!(p.eta >= 0.0 && p.eta <= largest_eta))
    refuse(who, "eta", p.eta, fmt::format("0 <= eta <= {}", largest_eta),
           p.eta <= 1.0 ? "It would hardly come to rest, after more than 1e5 impacts." : "");
  if (!(p.h0 > 0.0 || p.v0 > 0.0))
    refuse(who, "v0", p.v0, "v0 > 0 where h0 = 0", "It starts on the floor.");
  return p;
}

}  // namespace

DiskCounts disk_counts(const ObliqueDiskParameters& p) {
  DiskFormulas<Wide> f(p, {});
  auto &last = f.counts.last, &slides = f.counts.slides;
  bool& proven = f.counts.proven;
  last = std::max(
      1LL, 1 + powers(Wide(0x1p-56) * f.rest() * Wide(p.g) * f.once / (Wide(2.0) * f.V), p.eta));
  if (f.slip.value == 0) return f.counts;
  const auto is_positive = [&](const Wide& x) {
    proven = proven && abs(x.value) > x.error;
    return x.value > 0;
  };
  if (is_positive(f.left) || f.left.value == 0) {
    slides = last + 1;
    return f.counts;
  }
  const Wide sign = f.is_backward() ? -1.0 : 1.0;
  const auto slips = [&](long long j) {
    return is_positive(sign * (f.slip - f.more * f.friction * (Wide(1.0) - f.power(j)) / f.once));
  };
  slides =
      std::clamp(powers(-f.left * f.once / (sign * f.more * f.friction), p.eta) - 1, 0LL, last);
  while (slides < last && slips(slides + 1)) ++slides;
  proven = proven && slides < last;
  return f.counts;
}

ObliqueDisk::ObliqueDisk(const ObliqueDiskParameters& p, std::string_view who)
    : WideFlights(p, DiskFormulas<Wide>(p, disk_counts(checked(p, who)))) {
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

double ObliqueDisk::slides() const {
  return formulas_.counts.slides > formulas_.counts.last ? HUGE_VAL
                                                         : double(formulas_.counts.slides);
}
double ObliqueDisk::rolls() const { return instant(formulas_.counts.slides + 1).nearest(); }

Bounded ObliqueDisk::instant(long long k) const {
  return k > formulas_.counts.last + 2 ? Bounded(HUGE_VAL) : WideFlights::instant(k);
}

long long ObliqueDisk::near_flight(double t) const {
  const auto left = (formulas_.rest() - Wide(t)) * Wide(formulas_.p.g) * formulas_.once /
                    (Wide(2.0) * formulas_.V);
  return left.value > 0 ? std::clamp(powers(left, formulas_.p.eta), 0LL, formulas_.counts.last)
                        : formulas_.counts.last + 1;
}

model::Kinematics ObliqueDisk::envelope(double t) const {
  model::require_inside("motion", t, end());
  const double V = speed(), v = std::max(std::abs(formulas_.p.vx0), std::abs(rolling_speed())),
               w = std::max(std::abs(formulas_.p.w0), std::abs(rolling_speed()));
  // What stands still along the floor has the size of the jumps.
  const Eigen::Vector3d speeds(v > 0.0 ? v : V, V, w > 0.0 ? w : V);
  const double height = V * V / (2.0 * formulas_.p.g);
  return {Eigen::Vector3d(speeds[0] * end(), height, speeds[2] * end()), speeds,
          Eigen::Vector3d(formulas_.p.g, formulas_.p.g, formulas_.p.g)};
}

long long ObliqueDisk::impact_count(double t) const {
  return std::min(formulas_.counts.last, Flights::impact_count(t));
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
           formulas_.p.eta > 0.0,
           instant(formulas_.counts.last).nearest()}};
}

VectorXd ObliqueDisk::contact_forces(double t, Side side) const {
  return VectorXd::Constant(1, flight_at(t, side) > formulas_.counts.last ? formulas_.p.g : 0.0);
}

}  // namespace clackers::exact
