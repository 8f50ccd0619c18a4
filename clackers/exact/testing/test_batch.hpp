#pragma once

// What the tests of PairBatch share: the state before its last rounding, and how far off a batch is.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "clackers/exact/batch/batch.hpp"
#include "clackers/exact/pair/synchronized_pair.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact::testing_batch {

using numerics::DoubleDouble;
using numerics::simd::ForcedTarget;
using numerics::simd::Target;

/// Four arrays of a batch; each has `before` elements in front of what a batch may touch, and as
/// many behind it, all filled with a value that no motion has.
class Arrays {
 public:
  static constexpr double untouched = 12345.0;

  explicit Arrays(std::size_t size, std::size_t before = 0) : size_(size), before_(before) {
    for (auto& each : values_) each.assign(size + 2 * before, untouched);
  }
  PairBuffers buffers() {
    return {part(values_[0]), part(values_[1]), part(values_[2]), part(values_[3])};
  }
  PairValues values() {
    const auto b = buffers();
    return {b.u1, b.u2, b.v1, b.v2};
  }
  /// u1, u2, v1, v2 at i.
  std::array<double, 4> at(std::size_t i) const {
    return {values_[0][before_ + i], values_[1][before_ + i], values_[2][before_ + i],
            values_[3][before_ + i]};
  }
  bool margins_are_untouched() const {
    for (const auto& each : values_)
      for (std::size_t i = 0; i < before_; ++i)
        if (each[i] != untouched || each[before_ + size_ + i] != untouched) return false;
    return true;
  }

 private:
  std::span<double> part(std::vector<double>& each) { return {each.data() + before_, size_}; }
  std::size_t size_, before_;
  std::vector<double> values_[4];
};

/// u1, u2, v1, v2 before they are rounded: hi 2^exponent + lo 2^exponent, off by 2^-62 of the
/// envelope, which is beside it.
struct Unrounded {
  DoubleDouble value[4];
  double envelope[4];
  int exponent = 0;
};

inline Unrounded unrounded_state(const FlightConstants& c, const DoubleDouble& t,
                                 const FlightPhase& phase) {
  Unrounded s{};
  if (c.eta == 0.0 && phase.flight > 0.0) return s;
  const auto halvings = c.log2_eta * phase.flight - c.decay * t;
  if (halvings.hi < -4000.0) return s;
  const auto e = numerics::exp2(halvings);
  s.exponent = e.exponent;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& m = c.masses[i];
    const auto [sine, cosine] = numerics::sincospi(phase.half_turns * m.multiple);
    s.value[i] = m.b * (e.significand * cosine);
    s.value[i + 2] = m.v_cos * (e.significand * cosine) + m.v_sin * (e.significand * sine);
    s.envelope[i] = m.u_envelope * e.significand.hi;
    s.envelope[i + 2] = m.v_envelope * e.significand.hi;
  }
  return s;
}

/// The largest error of the four values in units of 2^-52 of their envelopes, after two subnormal
/// spacings are forgiven; infinite for NaN.
inline double units(const std::array<double, 4>& found, const Unrounded& reference) {
  constexpr double spacing = std::numeric_limits<double>::denorm_min();
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!std::isfinite(found[i])) return INFINITY;
    // All scaled by 2^-exponent (here up to 4000) in two exact steps, as long double.
    const auto scaled = [&](long double x) { return std::ldexp(x, -reference.exponent); };
    const long double error =
        std::abs((scaled(found[i]) - reference.value[i].hi) - reference.value[i].lo);
    const long double forgiven = scaled(2.0L * spacing);
    if (error <= forgiven) continue;
    if (reference.envelope[i] == 0.0) return INFINITY;
    worst = std::max(worst, double((error - forgiven) / reference.envelope[i] * 0x1p52L));
  }
  return worst;
}

/// The bounds that batch.hpp states.
inline double bound_at_times(double eta) { return eta == 0.0 || eta == 1.0 ? 1.6 : 1.8; }
inline constexpr double bound_on_grids = 2.2;

}  // namespace clackers::exact::testing_batch
