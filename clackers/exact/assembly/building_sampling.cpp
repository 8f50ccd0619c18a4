#include "clackers/exact/assembly/building_shape.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/exact/assembly/building_sampling.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "clackers/numerics/simd/double_double-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::exact::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace simd = numerics::simd::HWY_NAMESPACE;

using simd::constant;
using simd::Doubles;
using simd::Pair;
using simd::Vector;

// Neighbouring storeys of a quantity that are written together.
inline constexpr std::size_t in_tile = 4;

// Writes the first `count` of `in_tile` vectors, a storey each, to `out[lane * dof]` and on.
HWY_INLINE void write(const double* tile, std::size_t count, double* out, std::size_t dof,
                      std::size_t lanes) {
  const Doubles d;
  const auto vector = [&](std::size_t i) HWY_ATTR { return hn::Load(d, tile + i * hn::Lanes(d)); };
  HWY_ALIGN double by_lane[in_tile * hn::MaxLanes(d)];
  hn::StoreInterleaved4(vector(0), vector(1), vector(2), vector(3), d, by_lane);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto* from = by_lane + in_tile * lane;
    // Of a number that is known a copy is one instruction.
    count == in_tile ? std::copy_n(from, in_tile, out + lane * dof)
                     : std::copy_n(from, count, out + lane * dof);
  }
}

// One building at as many times as a vector has lanes.
template <bool with_a>
HWY_INLINE void sample_part(const BuildingShape::Coefficients& c, double sigma,
                            const FlightBlock& block, std::size_t at, std::size_t lanes,
                            std::size_t dof, double* u, double* v, double* a) {
  const Doubles d;
  const std::size_t width = hn::Lanes(d), n = c.v.size();
  const auto load = [&](const double* x) HWY_ATTR { return hn::Load(d, x + at); };
  // cos(x) and sin(x) of x = multiple (theta + pi/2), but for the sign of one; multiple odd.
  Pair sine, cosine;
  simd::sincospi(simd::multiply({load(block.y_hi), load(block.y_lo)}, constant(c.multiple)), cosine,
                 sine);
  const Vector s = c.reverses ? Neg(sine.hi) : sine.hi, k = c.reverses ? cosine.hi : Neg(cosine.hi);
  const Vector s2 = simd::multiply(sine, sine).hi, k2 = simd::multiply(cosine, cosine).hi;
  const Vector e = Mul(load(block.e_hi), load(block.scale));
  HWY_ALIGN double sines[static_cast<std::size_t>(most_storeys) * hn::MaxLanes(d)];
  Vector power = constant(1.0);
  for (std::size_t i = 0; i < n; ++i, power = Mul(power, s2))
    hn::Store(power, d, sines + i * width);

  HWY_ALIGN double tiles[3][in_tile * hn::MaxLanes(d)];
  const auto put = [&](Vector x, double* tile, std::size_t i) HWY_ATTR {
    hn::Store(Add(Mul(e, x), hn::Zero(d)), d, tile + i % in_tile * width);  // never -0
  };
  Vector displacement = hn::Zero(d), cosines = constant(1.0);
  for (std::size_t i = n; i-- > 0;) {
    const Vector term = Mul(cosines, hn::Load(d, sines + i * width));
    const Vector more = Mul(cosines, k2);
    displacement = Add(displacement, Mul(Mul(constant(c.u[i]), s), term));
    const Vector velocity = Mul(Mul(constant(c.v[i]), k), term);
    const Vector decayed = Mul(constant(sigma), displacement);
    put(displacement, tiles[0], i);
    put(Sub(velocity, decayed), tiles[1], i);
    if constexpr (with_a) {
      Vector change = Mul(constant(-double(2 * (n - 1 - i) + 1)), term);
      if (i > 0)
        change = Add(change,
                     Mul(constant(double(2 * i)), Mul(more, hn::Load(d, sines + (i - 1) * width))));
      const Vector acceleration = Mul(Mul(constant(c.frequency * c.v[i]), s), change);
      put(Sub(acceleration, Mul(constant(sigma), Sub(Mul(constant(2.0), velocity), decayed))),
          tiles[2], i);
    }
    cosines = more;
    if (i % in_tile != 0) continue;
    const auto count = std::min(in_tile, n - i);
    write(tiles[0], count, u + i, dof, lanes);
    write(tiles[1], count, v + i, dof, lanes);
    if constexpr (with_a) write(tiles[2], count, a + i, dof, lanes);
  }
}

void sample_buildings(const BuildingShape& shape, const FlightBlock& block, std::size_t count,
                      const model::SampleBuffers& out) {
  const auto dof = shape.dof(), width = hn::Lanes(Doubles());
  for (std::size_t at = 0; at < count; at += width) {
    const auto lanes = std::min(width, count - at);
    std::size_t first = at * dof;
    for (const auto& part : shape.parts()) {
      out.a.empty() ? sample_part<false>(part, shape.sigma(), block, at, lanes, dof, &out.u[first],
                                         &out.v[first], nullptr)
                    : sample_part<true>(part, shape.sigma(), block, at, lanes, dof, &out.u[first],
                                        &out.v[first], &out.a[first]);
      first += part.v.size();
    }
  }
}

}  // namespace clackers::exact::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::exact {

HWY_EXPORT(sample_buildings);

void BuildingShape::sample(const FlightBlock& block, std::size_t count,
                           model::SampleBuffers out) const {
  HWY_DYNAMIC_DISPATCH(sample_buildings)(*this, block, count, out);
}

}  // namespace clackers::exact
#endif
