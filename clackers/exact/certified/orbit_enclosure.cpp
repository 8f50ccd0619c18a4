#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/orbit_enclosure.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/exact/elliptic/two_pendula.hpp"
#include "clackers/exact/friction/friction_motion.hpp"
#include "clackers/exact/friction/oblique_disk.hpp"

namespace clackers::certified {
namespace {

exact::CradleFormulas<Ball> in_balls(std::monostate) { return {}; }  // refused before
auto in_balls(const exact::CradleParameters& p) { return exact::CradleFormulas<Ball>(p); }
auto in_balls(const exact::CircleBilliardParameters& p) { return exact::CircleFormulas<Ball>(p); }
auto in_balls(const exact::BallParameters& p) {
  return exact::BallFormulas<Ball>(p, exact::last_impact(p));
}
auto in_balls(const exact::ObliqueDiskParameters& p) {
  const auto counts = exact::disk_counts(p);
  if (!counts.proven)
    throw InputError(
        "digits: the slip ends so close to an impact that 256 bits do not tell which side; allowed: other values of mu, "
        "vx0 or w0.",
        "no-enclosure");
  return exact::DiskFormulas<Ball>(p, counts);
}
auto in_balls(const exact::SliderParameters& p) {
  return exact::SliderFormulas<Ball>(p, exact::half_swings(p));
}
auto in_balls(const exact::BeltParameters& p) { return exact::BeltFormulas<Ball>(p); }
auto in_balls(const exact::ForcedSliderParameters& p) {
  return exact::ForcedSliderFormulas<Ball>(p);
}
auto in_balls(const exact::PendulumParameters& p) { return exact::PendulumFormulas<Ball>(p); }
auto in_balls(const exact::DuffingParameters& p) { return exact::DuffingFormulas<Ball>(p); }
auto in_balls(const exact::TwoPendulaParameters& p) {
  return exact::TwoPendulaFormulas<Ball>(p, exact::second_modulus(p));
}
auto in_balls(const exact::PendulumCradleParameters& p) {
  return exact::TwoPendulaFormulas<Ball>(p);
}
auto in_balls(const auto& p) { return exact::OrbitFormulas<Ball>(p); }

}  // namespace

KinematicBalls OrbitEnclosure::kinematics(const exact::StatesOf<Ball>& states) const {
  KinematicBalls now;
  for (std::size_t i = 0; i < std::size_t(motion_.dof()); ++i) {
    now.u.push_back(states[i].u);
    now.v.push_back(states[i].v);
    now.a.push_back(states[i].a);
  }
  return now;
}

// Impacts that the motion leaves out are not before t.
void OrbitEnclosure::require_resolved(double t) const {
  for (const auto& closed : motion_.closed_contacts())
    if (closed.accumulates && t >= closed.resolved && t <= closed.begins.hi)
      throw InputError(
          fmt::format("digits: impacts accumulate at t = {} s; allowed: times before and after.",
                      t),
          "no-enclosure");
}

// With the working bits of now.
const OrbitEnclosure::Formulas& OrbitEnclosure::formulas() {
  constexpr long most_bits = 1 << 15;
  if (bits_ == WorkingBits::now()) return formulas_;
  bits_ = WorkingBits::now();
  if (bits_ > most_bits)
    throw InputError(
        "digits: a value is 0 or halfway between two decimal numbers; allowed: other values.",
        "no-enclosure");
  std::visit([&](const auto& p) { formulas_ = in_balls(p); }, motion_.parameters());
  return formulas_;
}

KinematicBalls OrbitEnclosure::at_now(long long k, double t) {
  require_resolved(t);
  return std::visit(
      [&](const auto& formulas) {
        // A double that is an impact's instant itself.
        const auto since = [&](long long impact) { return Ball(t) - formulas.instant(impact); };
        if (k > 0 && since(k).is_zero()) return kinematics(formulas.limits(k).after);
        if (since(k + 1).is_zero()) return kinematics(formulas.limits(k + 1).before);
        auto states = formulas.state(k, since(k));
        for (std::size_t i = 0; i < std::size_t(motion_.dof()); ++i)
          if (formulas.turns(i, k, t)) states[i].v = Ball();
        return kinematics(states);
      },
      formulas());
}

ImpactBalls OrbitEnclosure::impact_now(long long k) {
  return std::visit(
      [&](const auto& formulas) {
        const auto limits = formulas.limits(k);
        return ImpactBalls{
            formulas.instant(k), kinematics(limits.before),      kinematics(limits.after),
            limits.impulse,      formulas.energy(limits.before), formulas.energy(limits.after)};
      },
      formulas());
}

}  // namespace clackers::certified

#endif
