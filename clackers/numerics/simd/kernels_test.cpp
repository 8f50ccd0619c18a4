// Vectors against the scalar functions, bit by bit, on every target.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/numerics/simd/kernels_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "clackers/numerics/simd/double_double-inl.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

HWY_BEFORE_NAMESPACE();
namespace clackers::numerics::simd::HWY_NAMESPACE {

inline DoubleDouble lane_0(const Pair& x) { return {hn::GetLane(x.hi), hn::GetLane(x.lo)}; }

// Each does one thing in all lanes and returns those of the first.
void arithmetic(const DoubleDouble& x, const DoubleDouble& y, DoubleDouble* out) {
  const auto a = constant(x), b = constant(y);
  out[0] = lane_0(add(a, b));
  out[1] = lane_0(subtract(a, b));
  out[2] = lane_0(multiply(a, b));
  out[3] = lane_0(multiply(a, b.hi));
  out[4] = lane_0(two_product(a.hi, b.hi));
}
void sine_and_cosine(const DoubleDouble& y, DoubleDouble* out) {
  Pair sine, cosine;
  sincospi(constant(y), sine, cosine);
  out[0] = lane_0(sine);
  out[1] = lane_0(cosine);
}
void power(const DoubleDouble& x, DoubleDouble* out) {
  Vector scale;
  out[0] = lane_0(exp2(constant(x), scale));
  out[1] = {hn::GetLane(scale), 0.0};
}

}  // namespace clackers::numerics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::numerics::simd {
namespace {

HWY_EXPORT(arithmetic);
HWY_EXPORT(sine_and_cosine);
HWY_EXPORT(power);

class Kernels : public testing::TestWithParam<Target> {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  DoubleDouble any(double exponents) {
    const double x = std::ldexp(uniform(-1.0, 1.0), int(uniform(-exponents, exponents)));
    return quick_two_sum(x, x * 0x1p-54 * uniform(-1.0, 1.0));
  }

 private:
  ForcedTarget forced_{GetParam()};
  std::mt19937_64 random_{3};
};

void expect_bits(const DoubleDouble& found, const DoubleDouble& expected) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(found.hi), std::bit_cast<std::uint64_t>(expected.hi));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(found.lo), std::bit_cast<std::uint64_t>(expected.lo));
}

TEST_P(Kernels, ArithmeticHasTheBitsOfSingleNumbers) {
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const auto x = any(60.0), y = any(60.0);
    DoubleDouble found[5];
    HWY_DYNAMIC_DISPATCH(arithmetic)(x, y, found);
    expect_bits(found[0], x + y);
    expect_bits(found[1], x - y);
    expect_bits(found[2], x * y);
    expect_bits(found[3], x * y.hi);
    expect_bits(found[4], numerics::two_product(x.hi, y.hi));
  }
}

TEST_P(Kernels, SineAndCosineHaveTheBitsOfSingleNumbers) {
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const auto y = i % 3 == 0 ? DoubleDouble{double(i) / 256.0, 0.0} : any(40.0);
    DoubleDouble found[2];
    HWY_DYNAMIC_DISPATCH(sine_and_cosine)(y, found);
    const auto expected = numerics::sincospi(y);
    expect_bits(found[0], expected.sine);
    expect_bits(found[1], expected.cosine);
  }
}

TEST_P(Kernels, PowersOfTwoHaveTheBitsOfSingleNumbers) {
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const DoubleDouble x{i % 3 == 0 ? double(i % 1000) / 64.0 : uniform(-1000.0, 1000.0), 1e-30};
    DoubleDouble found[2];
    HWY_DYNAMIC_DISPATCH(power)(x, found);
    const auto expected = numerics::exp2(x);
    expect_bits(found[0], expected.significand);
    EXPECT_EQ(found[1].hi, std::ldexp(1.0, expected.exponent)) << x.hi;
  }
}

INSTANTIATE_TEST_SUITE_P(, Kernels, testing::ValuesIn(available_targets()),
                         [](const auto& target) { return std::string(target.param.name()); });

}  // namespace
}  // namespace clackers::numerics::simd
#endif
