#include "clackers/exact/pair/closed_form.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "clackers/exact/pair/sampling.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {

using model::Kinematics;
using model::Side;
using numerics::DoubleDouble;
using numerics::Scaled;

namespace {

// Never -0, which would be printed as such.
double rounded(const DoubleDouble& x, int exponent) {
  return numerics::scale(x.hi, exponent) + 0.0;
}

Kinematics make_kinematics(int n) {
  return {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
}

}  // namespace

ClosedForm::ClosedForm(const Parameters& parameters, std::string_view who)
    : ClosedForm(parameters, derive(who, parameters)) {}

ClosedForm::ClosedForm(const Parameters& parameters, Derived derived)
    : parameters_(parameters),
      c_(std::move(derived.flight)),
      problem_(std::move(derived.problem)),
      pair_(derived.pair) {}

const ClosedForm* as_closed_form(const model::Motion& motion) {
  return dynamic_cast<const ClosedForm*>(&motion);
}

Phase ClosedForm::phase(double t, Side side) const {
  model::require_inside("motion", t, c_.end);
  return phase_at(c_, t, side);
}

void ClosedForm::sample(std::span<const double> times, Side side, model::SampleBuffers out) const {
  const auto masses = c_.masses.size();
  model::require_buffers("motion", out, times.size(), masses);
  const auto evaluate = [&](std::size_t i) {
    const auto at = i * masses;
    sample_one(times[i], side, &out.u[at], &out.v[at], out.a.empty() ? nullptr : &out.a[at]);
  };
  // A vector takes as long as some single numbers, a block as long as `most_alone`.
  constexpr std::size_t few = 3;
  constexpr int most_alone = 8;
  StepTable table;
  bool steps = tabulate_steps(c_, times, table);
  std::uint64_t left_out_of[most_anchors];
  for (std::size_t i = 0; i < times.size(); i += most_in_block) {
    const auto count = std::min(most_in_block, times.size() - i);
    if (count <= few) {
      for (std::size_t j = i; j < i + count; ++j) evaluate(j);
      continue;
    }
    const auto at = i * masses, anchor = i / most_in_block % most_anchors;
    double* const a = out.a.empty() ? nullptr : &out.a[at];
    if (steps && anchor == 0)
      steps = sample_steps(c_, table, &times[i],
                           std::min(most_anchors, (times.size() - i) / most_in_block), &out.u[at],
                           &out.v[at], a, left_out_of);
    auto left_out = steps && count == most_in_block ? left_out_of[anchor] : ~std::uint64_t(0);
    if (std::popcount(left_out) > most_alone)
      left_out = sample_block(c_, &times[i], count, &out.u[at], &out.v[at], a);
    for (; left_out != 0; left_out &= left_out - 1)
      evaluate(i + static_cast<std::size_t>(std::countr_zero(left_out)));
  }
}

void ClosedForm::sample_one(double t, Side side, double* u, double* v, double* a) const {
  model::require_inside("motion", t, c_.end);
  const auto [k, theta_over_pi] = c_.collides ? phase_at(c_, t, side) : natural_phase(c_, t);
  const bool rests = c_.eta == 0.0 && k > 0.0;
  const double flight = c_.collides ? k : 0.0;
  auto [e, exponent] = rests ? Scaled{} : power(c_.log2_eta * flight - c_.decay * t);
  // Without a stop an odd number of half turns changes the sign.
  if (!c_.collides && std::fmod(k, 2.0) != 0.0) e = -e;
  for (const auto& mass : c_.masses) {
    const auto [sine, cosine] = numerics::sincospi(theta_over_pi * mass.multiple);
    const auto ec = e * cosine, es = e * sine;
    *u++ = rounded(mass.b * ec, exponent);
    *v++ = rounded(mass.v_cos * ec + mass.v_sin * es, exponent);
    if (a != nullptr) *a++ = rounded(mass.a_cos * ec + mass.a_sin * es, exponent);
  }
}

Kinematics ClosedForm::envelope(double t) const {
  model::require_inside("motion", t, c_.end);
  const double flight = phase_at(c_, t, Side::left).flight;
  auto result = make_kinematics(dof());
  if (c_.eta == 0.0 && flight > 0.0) return result;
  const auto [e, exponent] = power(c_.log2_eta * flight - c_.decay * t);
  for (int i = 0; i < dof(); ++i) {
    const auto& mass = c_.masses[static_cast<std::size_t>(i)];
    result.u[i] = numerics::scale(mass.u_envelope * e.hi, exponent);
    result.v[i] = numerics::scale(mass.v_envelope * e.hi, exponent);
    result.a[i] = numerics::scale(mass.a_envelope * e.hi, exponent);
  }
  return result;
}

Kinematics ClosedForm::error_bound(double t) const {
  constexpr double relative = 0.51 * 0x1p-52;
  constexpr double spacing = std::numeric_limits<double>::denorm_min();
  auto bound = envelope(t);
  for (auto* x : {&bound.u, &bound.v, &bound.a}) *x = (*x * relative).array() + spacing;
  return bound;
}

long long ClosedForm::impact_count(double t) const {
  model::require_inside("motion", t, c_.end);
  if (!c_.collides) return 0;
  const auto count = static_cast<long long>(natural_phase(c_, t).flight);
  return c_.eta == 0.0 ? std::min(count, 1LL) : count;
}

model::MotionImpact ClosedForm::impact(long long index) const {
  const auto count = impact_count(c_.end);
  model::require_impact("motion", index, count, c_.end);
  const auto k = static_cast<double>(index);
  model::MotionImpact hit;
  hit.index = index;
  const auto when = impact_instant(c_, k);
  hit.t = when.nearest;
  const double other = std::nextafter(hit.t, when.beyond > 0.0 ? INFINITY : 0.0);
  hit.when = {std::min(hit.t, other), std::max(hit.t, other)};

  const auto decay = c_.period_decay * (k - 0.5);
  const auto before = power(c_.log2_eta * (k - 1.0) - decay);
  const auto after = c_.eta == 0.0 ? Scaled{} : power(c_.log2_eta * k - decay);
  hit.before = hit.after = make_kinematics(dof());
  for (int i = 0; i < dof(); ++i) {
    const auto& mass = c_.masses[static_cast<std::size_t>(i)];
    hit.before.v[i] = rounded(mass.v_hit * before.significand, before.exponent);
    hit.before.a[i] = rounded(mass.a_hit * before.significand, before.exponent);
    hit.after.v[i] = rounded(-mass.v_hit * after.significand, after.exponent);
    hit.after.a[i] = rounded(-mass.a_hit * after.significand, after.exponent);
  }
  hit.impulse = rounded(c_.impulse * before.significand, before.exponent);
  const auto square = [](const Scaled& x) {
    return Scaled{x.significand * x.significand, 2 * x.exponent};
  };
  const auto energy_before = square(before), energy_after = square(after);
  hit.energy_before = rounded(c_.energy * energy_before.significand, energy_before.exponent);
  hit.energy_after = rounded(c_.energy * energy_after.significand, energy_after.exponent);
  return hit;
}

}  // namespace clackers::exact
