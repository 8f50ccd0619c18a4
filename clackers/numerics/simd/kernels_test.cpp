// The pieces that kernels are made of, on every target.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/simd/target.hpp"
#include "clackers/numerics/simd/wanted.hpp"
#include "clackers/numerics/sincospi.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/numerics/simd/kernels_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "clackers/numerics/simd/exp2-inl.hpp"
#include "clackers/numerics/simd/half_turns-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {

inline double first(Vector x) { return hn::GetLane(x); }

// Each function does one thing in all lanes and returns those of the first.
void product_of_factor(double f, double x, double* out) {
  const auto p = two_product(Factor(f), multiplicand(constant(x)));
  out[0] = first(p.hi), out[1] = first(p.lo);
}
void product(double x, double y, double* out) {
  const auto p = two_product(constant(x), constant(y));
  out[0] = first(p.hi), out[1] = first(p.lo);
}
void sum(double x, double y, double* out) {
  const auto p = two_sum(constant(x), constant(y));
  out[0] = first(p.hi), out[1] = first(p.lo);
}
void long_product(double x, double x_lo, double y, double y_lo, double* out) {
  const auto p = multiply({constant(x), constant(x_lo)}, {constant(y), constant(y_lo)});
  out[0] = first(p.hi), out[1] = first(p.lo);
}
void long_dot(double x, double x_lo, double y, double y_lo, double* out) {
  const Pair a{constant(x), constant(x_lo)}, b{constant(y), constant(y_lo)};
  const auto p = dot(a, a, b, {Neg(a.hi), Neg(a.lo)});
  out[0] = first(p.hi), out[1] = first(p.lo);
}
void nearest(double x, double* out) { out[0] = first(nearest_whole(constant(x))); }
void quarter(double x, double* out) {
  const Vectors<1> z = {constant(x)};
  Vectors<1> sine, cosine_less_one;
  sine_cosine_of_quarter<1>(z, sine, cosine_less_one);
  out[0] = first(sine[0]), out[1] = first(cosine_less_one[0]);
}
void turned(double quarters, double* out) {
  const Vector shifted = constant(quarters + 0x1.8p52);
  Vector sine = half_turn_sign(shifted, constant(0.25));
  Vector cosine = half_turn_sign(shifted, constant(0.5));
  turn_by_quarters(shifted, sine, cosine);
  out[0] = first(sine), out[1] = first(cosine);
}
void power(double x, double* out) {
  const Vectors<1> r = {constant(x)};
  Vectors<1> value, low;
  exp2<1>(r, value, low);
  out[0] = first(value[0]), out[1] = first(low[0]);
}
void scaled(double n, double x, double* out) {
  out[0] = first(scale_by_power_of_two(BitCast(Words(), constant(n + 0x1.8p52)), constant(x)));
}
void whole_power(double n, double* out) {
  out[0] = first(whole_power_of_two(BitCast(Words(), constant(n + 0x1.8p52))));
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::numerics::simd {
namespace {

HWY_EXPORT(product_of_factor);
HWY_EXPORT(product);
HWY_EXPORT(sum);
HWY_EXPORT(long_product);
HWY_EXPORT(long_dot);
HWY_EXPORT(nearest);
HWY_EXPORT(quarter);
HWY_EXPORT(turned);
HWY_EXPORT(power);
HWY_EXPORT(whole_power);
HWY_EXPORT(scaled);

class Kernels : public testing::TestWithParam<Target> {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double any() { return std::ldexp(uniform(-1.0, 1.0), int(uniform(-60.0, 60.0))); }

 private:
  ForcedTarget forced_{GetParam()};
  std::mt19937_64 random_{3};
};

TEST_P(Kernels, SplitSumsAndProductsWithoutError) {
  for (int i = 0; i < 3000; ++i) {
    const double x = any(), y = any();
    double found[2];
    HWY_DYNAMIC_DISPATCH(product)(x, y, found);
    const auto p = two_product(x, y);
    EXPECT_EQ(found[0], p.hi);
    // Of cut factors the last product is rounded.
    EXPECT_NEAR(found[1], p.lo, GetParam().has_fma() ? 0.0 : std::abs(p.hi) * 0x1p-104);
    HWY_DYNAMIC_DISPATCH(product_of_factor)(x, y, found);
    EXPECT_EQ(found[0], p.hi);
    EXPECT_EQ(found[1], p.lo);
    HWY_DYNAMIC_DISPATCH(sum)(x, y, found);
    const auto s = two_sum(x, y);
    EXPECT_EQ(found[0], s.hi);
    EXPECT_EQ(found[1], s.lo);
  }
}

TEST_P(Kernels, KeepLongNumbersTo102Bits) {
  for (int i = 0; i < 3000; ++i) {
    const double x = any(), y = any();
    const double x_lo = uniform(-0x1p-54, 0x1p-54) * x, y_lo = uniform(-0x1p-54, 0x1p-54) * y;
    const auto off = [](const double* found, const DoubleDouble& reference) {
      return std::abs((found[0] - reference.hi) + (found[1] - reference.lo));
    };
    double found[2];
    HWY_DYNAMIC_DISPATCH(long_product)(x, x_lo, y, y_lo, found);
    const auto p = DoubleDouble{x, x_lo} * DoubleDouble{y, y_lo};
    EXPECT_LE(off(found, p), 0x1p-102 * std::abs(p.hi));
    HWY_DYNAMIC_DISPATCH(long_dot)(x, x_lo, y, y_lo, found);
    const DoubleDouble a{x, x_lo}, b{y, y_lo};
    EXPECT_LE(off(found, a * a - b * a), 0x1p-102 * (x * x + std::abs(x * y)));
  }
}

TEST_P(Kernels, RoundToTheNearestWholeNumberTiesToEven) {
  for (const double x : {0.0, 0.5, 1.5, -0.5, -1.5, -2.5, 0.49999999999999994, 0x1p50 + 0.75,
                         0x1p51 - 0.5, -0x1p50 - 0.25}) {
    double found;
    HWY_DYNAMIC_DISPATCH(nearest)(x, &found);
    EXPECT_EQ(found, std::nearbyint(x)) << x;
  }
}

TEST_P(Kernels, KeepTheBoundsOfSineAndCosine) {
  double sine = 0.0, cosine = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double z = i == 0       ? 0.25
                     : i == 1     ? -0.25
                     : i % 3 == 0 ? any() * 0x1p-62
                                  : uniform(-0.25, 0.25);
    double found[2];
    HWY_DYNAMIC_DISPATCH(quarter)(z, found);
    const auto reference = sincospi({z, 0.0});
    sine = std::max(sine, std::abs(found[0] - reference.sine.hi - reference.sine.lo));
    const double less_one = (reference.cosine.hi - 1.0) + reference.cosine.lo;
    cosine = std::max(cosine, std::abs(found[1] - less_one));
  }
  EXPECT_LE(sine, 0.4 * 0x1p-52);
  EXPECT_LE(cosine, 0.3 * 0x1p-52);
}

TEST_P(Kernels, TurnByQuartersAsSineAndCosineDo) {
  const double s = 0.25, c = 0.5;
  const double expected[4][2] = {{s, c}, {c, -s}, {-s, -c}, {-c, s}};
  for (const int m : {0, 1, 2, 3, 4, 7, 1000001, -1, -2, -3, -4, -1000002}) {
    double found[2];
    HWY_DYNAMIC_DISPATCH(turned)(m, found);
    EXPECT_EQ(found[0], expected[m & 3][0]) << m;
    EXPECT_EQ(found[1], expected[m & 3][1]) << m;
  }
}

TEST_P(Kernels, KeepTheBoundOfPowersOfTwo) {
  double worst = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double r = i == 0 ? 0.5 : i == 1 ? -0.5 : uniform(-0.5, 0.5);
    double found[2];
    HWY_DYNAMIC_DISPATCH(power)(r, found);
    const auto [e, exponent] = exp2({r, 0.0});
    const double scale = std::ldexp(1.0, exponent);
    const double reference = e.hi * scale;
    worst =
        std::max(worst, std::abs((found[0] - reference) + (found[1] - e.lo * scale)) / reference);
  }
  EXPECT_LE(worst, (GetParam().has_fma() ? 0.37 : 0.55) * 0x1p-52);
}

TEST_P(Kernels, BuildWholePowersOfTwo) {
  for (const int n : {-1022, -1, 0, 1, 1023}) {
    double found;
    HWY_DYNAMIC_DISPATCH(whole_power)(n, &found);
    EXPECT_EQ(found, std::ldexp(1.0, n));
    const double x = n < 0 ? 1.75 : 0.75;
    HWY_DYNAMIC_DISPATCH(scaled)(n, x, &found);
    EXPECT_EQ(found, std::ldexp(x, n));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, Kernels, testing::ValuesIn(available_targets()),
                         [](const auto& each) { return std::string(each.param.name()); });

}  // namespace
}  // namespace clackers::numerics::simd
#endif
