#include "clackers/exact/assembly/shaped_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"

namespace clackers::exact {

using model::Kinematics;
using model::Side;
using numerics::DoubleDouble;

ShapedMotion::ShapedMotion(const ShapedParameters& parameters, FlightConstants constants,
                           std::unique_ptr<const FlightShape> shape, ImpactPattern pattern,
                           std::string_view who)
    : parameters_(parameters),
      c_(std::move(constants)),
      shape_(std::move(shape)),
      pattern_(std::move(pattern)) {
  const double impacts = natural_phase(c_, c_.end).flight * double(contacts_at_once());
  if (!(impacts <= 0x1p62))
    refuse(who, "t_end", c_.end, "at most 2^62 impacts",
           fmt::format("There would be {:.3g}, {} at once.", impacts, contacts_at_once()));
}

ShapedMotion::Instant ShapedMotion::instant(const Phase& phase,
                                            const DoubleDouble& halvings) const {
  const bool rests = c_.eta == 0.0 && phase.flight > 0.0;
  return {phase, rests ? numerics::Scaled{} : power(c_.log2_eta * phase.flight - halvings)};
}

ShapedMotion::Instant ShapedMotion::instant_at(double t, Side side) const {
  model::require_inside("motion", t, c_.end);
  return instant(phase_at(c_, t, side), c_.decay * t);
}

void ShapedMotion::put(const Instant& now, std::size_t lane, FlightBlock& block) {
  // So that a product with E is rounded to a subnormal number once.
  constexpr int least = -1000;
  const auto& [e, exponent] = now.decay;
  const int beyond = std::min(0, exponent - least);
  block.flight[lane] = now.phase.flight;
  block.y_hi[lane] = now.phase.theta_over_pi.hi;
  block.y_lo[lane] = now.phase.theta_over_pi.lo;
  block.e_hi[lane] = numerics::scale(e.hi, beyond);
  block.e_lo[lane] = numerics::scale(e.lo, beyond);
  block.scale[lane] = numerics::scale(1.0, exponent - beyond);
}

void ShapedMotion::sample(std::span<const double> times, Side side,
                          model::SampleBuffers out) const {
  const auto n = shape_->dof();
  model::require_buffers("motion", out, times.size(), n);
  // A vector takes as long as some single numbers.
  constexpr std::size_t few = 3;
  FlightBlock block{};
  for (std::size_t first = 0; first < times.size(); first += most_in_block) {
    const auto count = std::min(most_in_block, times.size() - first);
    auto left_out = count <= few ? (std::uint64_t(1) << count) - 1
                                 : flight_block(c_, &times[first], count, block);
    for (; left_out != 0; left_out &= left_out - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left_out));
      put(instant_at(times[first + lane], side), lane, block);
    }
    const auto part = [&](std::span<double> x) {
      return x.empty() ? x : x.subspan(first * n, count * n);
    };
    shape_->sample(block, count, {part(out.u), part(out.v), part(out.a)});
  }
}

Kinematics ShapedMotion::state(const Instant& now) const {
  FlightBlock block{};
  put(now, 0, block);
  const auto n = static_cast<Eigen::Index>(shape_->dof());
  Kinematics x{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  const auto values = [](Eigen::VectorXd& column) {
    return std::span<double>(column.data(), static_cast<std::size_t>(column.size()));
  };
  shape_->sample(block, 1, {values(x.u), values(x.v), values(x.a)});
  return x;
}

Kinematics ShapedMotion::envelope(double t) const {
  const auto [significand, exponent] = instant_at(t, Side::left).decay;
  const double e = numerics::scale(significand.hi, exponent);
  auto size = shape_->amplitude();
  for (auto* x : {&size.u, &size.v, &size.a}) *x *= e;
  return size;
}

Kinematics ShapedMotion::error_bound(double t) const {
  constexpr double own = 3.0 * 0x1p-53;
  // Up to three columns, each with a factor, a product and a sum.
  constexpr double spacing = 8.0 * std::numeric_limits<double>::denorm_min();
  const auto [significand, exponent] = instant_at(t, Side::left).decay;
  const double e = numerics::scale(significand.hi, exponent);
  const auto size = shape_->amplitude(), error = shape_->error();
  const auto bound = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& its_error) {
    return Eigen::VectorXd((e * (its_error + own * x)).array() +
                           spacing * (1.0 + size.u.array() + x.array()));
  };
  return {bound(size.u, error.u), bound(size.v, error.v), bound(size.a, error.a)};
}

long long ShapedMotion::impact_count(double t) const {
  model::require_inside("motion", t, c_.end);
  const auto instants = static_cast<long long>(natural_phase(c_, t).flight);
  return contacts_at_once() * (c_.eta == 0.0 ? std::min(instants, 1LL) : instants);
}

model::MotionImpact ShapedMotion::impact(long long index) const {
  const auto count = impact_count(c_.end);
  model::require_impact("motion", index, count, c_.end);
  const auto number = (index - 1) / contacts_at_once() + 1;
  const auto& contacts =
      pattern_.contacts[static_cast<std::size_t>(number - 1) % pattern_.contacts.size()];
  const auto& [contact, impulse] =
      contacts[static_cast<std::size_t>((index - 1) % contacts_at_once())];

  const auto k = static_cast<double>(number);
  const auto halvings = c_.period_decay * (k - 1.0 + c_.first_impact);
  const auto before = instant({k - 1.0, {0.5, 0.0}}, halvings);
  const auto after = instant({k, {-0.5, 0.0}}, halvings);
  const auto when = impact_instant(c_, k);
  model::MotionImpact hit;
  hit.index = index;
  hit.t = when.nearest;
  const double other = std::nextafter(hit.t, when.beyond > 0.0 ? INFINITY : 0.0);
  hit.when = {std::min(hit.t, other), std::max(hit.t, other)};
  hit.contact = contact;
  hit.before = state(before);
  hit.after = state(after);
  const auto times_decay = [](double x, const numerics::Scaled& e) {
    return numerics::scale((e.significand * x).hi, e.exponent);
  };
  const auto square = [](const numerics::Scaled& e) {
    return numerics::Scaled{e.significand * e.significand, 2 * e.exponent};
  };
  hit.impulse = times_decay(impulse, before.decay);
  hit.energy_before = times_decay(pattern_.energy, square(before.decay));
  hit.energy_after = times_decay(pattern_.energy, square(after.decay));
  return hit;
}

}  // namespace clackers::exact
