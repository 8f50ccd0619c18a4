#include "clackers/exact/friction/oblique_disk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {

using Eigen::VectorXd;
using numerics::Wide;

namespace {

// Beyond, more than 1e5 impacts are within the run.
constexpr double largest_eta = 0.9995;

const ObliqueDiskParameters& checked(const ObliqueDiskParameters& p, std::string_view who) {
  if (p.height.eta > largest_eta)
    refuse(who, "eta", p.height.eta, fmt::format("0 <= eta <= {}", largest_eta),
           "It would hardly come to rest, after more than 1e5 impacts.");
  require_bouncing(p.height, who);
  return p;
}

}  // namespace

DiskCounts disk_counts(const ObliqueDiskParameters& p) {
  DiskFormulas<Wide> f(p, {.last = last_impact(p.height)});
  const auto last = f.last;
  auto& slides = f.counts.slides;
  bool& proven = f.counts.proven;
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
  slides = std::clamp(powers(-f.left * f.once / (sign * f.more * f.friction), p.height.eta) - 1,
                      0LL, last);
  while (slides < last && slips(slides + 1)) ++slides;
  proven = proven && slides < last;
  return f.counts;
}

ObliqueDisk::ObliqueDisk(const ObliqueDiskParameters& p, std::string_view who)
    : Bouncing(p, DiskFormulas<Wide>(p, disk_counts(checked(p, who)))) {
  problem_.system.mass = Eigen::Vector3d(1.0, 1.0, p.beta).asDiagonal();
  problem_.system.damping = problem_.system.stiffness = Eigen::Matrix3d::Zero();
  problem_.system.add_load = model::HarmonicLoad({{1, -p.height.g, 0.0, 0.0}});
  problem_.contacts = {{VectorXd::Unit(3, 1), 0.0, p.height.eta}};
  problem_.start = {0.0, Eigen::Vector3d(0.0, p.height.h0, 0.0),
                    Eigen::Vector3d(p.vx0, p.height.v0, p.w0)};
  problem_.end = p.height.end;
  problem_.frictions = {{Eigen::Vector3d(1.0, 0.0, 1.0), p.mu, p.mu, 0.0, 0}};
}

double ObliqueDisk::slides() const {
  return formulas_.counts.slides > formulas_.counts.last ? HUGE_VAL
                                                         : double(formulas_.counts.slides);
}
double ObliqueDisk::rolls() const { return instant(formulas_.counts.slides + 1).nearest(); }

VectorXd ObliqueDisk::contact_forces(double t, model::Side side) const {
  return Eigen::Vector2d(Bouncing::contact_forces(t, side)[0], at(t, side).a[0]);
}

model::Kinematics ObliqueDisk::envelope(double t) const {
  model::require_inside("motion", t, end());
  const double V = speed(), v = std::max(std::abs(formulas_.p.vx0), std::abs(rolling_speed())),
               w = std::max(std::abs(formulas_.p.w0), std::abs(rolling_speed()));
  // What stands still along the floor has the size of the jumps.
  const Eigen::Vector3d speeds(v > 0.0 ? v : V, V, w > 0.0 ? w : V);
  const double g = formulas_.ball.g, height = V * V / (2.0 * g);
  return {Eigen::Vector3d(speeds[0] * end(), height, speeds[2] * end()), speeds,
          Eigen::Vector3d(g, g, g)};
}

}  // namespace clackers::exact
