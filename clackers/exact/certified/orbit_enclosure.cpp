#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/orbit_enclosure.hpp"

#include "clackers/base/error.hpp"

namespace clackers::certified {
namespace {

exact::CradleFormulas<Ball> in_balls(std::monostate) { return {}; }  // refused before
auto in_balls(const exact::CradleParameters& p) { return exact::CradleFormulas<Ball>(p); }
auto in_balls(const auto& p) { return exact::OrbitFormulas<Ball>(p); }

KinematicBalls kinematics(const exact::StatesOf<Ball>& states) {
  KinematicBalls now;
  for (const auto& mass : {states[0], states[1]}) {
    now.u.push_back(mass.u);
    now.v.push_back(mass.v);
    now.a.push_back(mass.a);
  }
  return now;
}

}  // namespace

// With the working bits of now.
const OrbitEnclosure::Formulas& OrbitEnclosure::formulas() {
  constexpr long most_bits = 1 << 15;
  if (bits_ == WorkingBits::now()) return formulas_;
  bits_ = WorkingBits::now();
  if (bits_ > most_bits)
    throw InputError("digits: a value is 0; allowed: values other than 0.", "no-enclosure");
  std::visit([&](const auto& p) { formulas_ = in_balls(p); }, motion_.parameters());
  return formulas_;
}

KinematicBalls OrbitEnclosure::at_now(long long k, double t) {
  return std::visit(
      [&](const auto& formulas) {
        // A double that is an impact's instant itself.
        const auto since = [&](long long impact) { return Ball(t) - formulas.instant(impact); };
        if (since(k).is_zero()) return kinematics(formulas.limits(k).after);
        if (since(k + 1).is_zero()) return kinematics(formulas.limits(k + 1).before);
        auto states = formulas.state(k, since(k));
        for (std::size_t i = 0; i < 2; ++i)
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
