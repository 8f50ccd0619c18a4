#include "clackers/numerics/double_double.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>

#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"
#include "clackers/numerics/triple_double.hpp"

namespace clackers::numerics {
namespace {

using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

Wide wide(const DoubleDouble& x) { return Wide(x.hi) + x.lo; }
Wide wide(const TripleDouble& x) { return Wide(x.hi) + x.mid + x.lo; }

class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  double any() { return std::ldexp(uniform(-1.0, 1.0), int(uniform(-60.0, 60.0))); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  DoubleDouble pair() {
    const double hi = any();
    return quick_two_sum(hi, std::ldexp(hi * uniform(-1.0, 1.0), -54));
  }

 private:
  std::mt19937_64 random_;
};

constexpr unsigned seed = 20260401;
constexpr int many = 3000;

TEST(DoubleDouble, SumsAndProductsOfDoublesLoseNothing) {
  Numbers numbers(seed);
  for (int i = 0; i < many; ++i) {
    const double a = numbers.any(), b = numbers.any();
    EXPECT_EQ(wide(two_sum(a, b)), Wide(a) + b);
    EXPECT_EQ(two_sum(a, b).hi, a + b);
    EXPECT_EQ(wide(two_product(a, b)), Wide(a) * b);
    EXPECT_EQ(two_product(a, b).hi, a * b);
    const double big = std::max(std::abs(a), std::abs(b)),
                 small = std::min(std::abs(a), std::abs(b));
    EXPECT_EQ(wide(quick_two_sum(big, -small)), Wide(big) - small);
  }
}

TEST(DoubleDouble, OperationsKeepTheirErrorBounds) {
  Numbers numbers(seed + 1);
  for (int i = 0; i < many; ++i) {
    const auto x = numbers.pair(), y = numbers.pair();
    const double z = numbers.any();
    EXPECT_LE(abs(wide(x + y) - (wide(x) + wide(y))), ldexp(abs(wide(x)) + abs(wide(y)), -104));
    EXPECT_LE(abs(wide(x - y) - (wide(x) - wide(y))), ldexp(abs(wide(x)) + abs(wide(y)), -104));
    EXPECT_LE(abs(wide(x * y) - wide(x) * wide(y)), ldexp(abs(wide(x) * wide(y)), -103));
    EXPECT_LE(abs(wide(x * z) - wide(x) * z), ldexp(abs(wide(x) * z), -103));
    EXPECT_LE(abs(wide(x / y) - wide(x) / wide(y)), ldexp(abs(wide(x) / wide(y)), -100));
    const Wide root = sqrt(abs(wide(x)));
    EXPECT_LE(abs(wide(sqrt(x.hi < 0.0 ? -x : x)) - root), ldexp(root, -100));
  }
}

TEST(DoubleDouble, NearestWholeRoundsTiesToEven) {
  for (const double x : {0.0, 0.4, 0.5, 1.5, 2.5, -0.5, -1.5, 1e15 + 0.5, 123456789.49})
    EXPECT_EQ(nearest_whole(x), std::nearbyint(x)) << x;
}

TripleDouble triple(const Wide& x) {
  const auto hi = x.convert_to<double>();
  const auto mid = Wide(x - hi).convert_to<double>();
  return {hi, mid, Wide(x - hi - mid).convert_to<double>()};
}

TEST(TripleDouble, ProductsAreTrueTo150Bits) {
  Numbers numbers(seed + 2);
  for (int i = 0; i < many; ++i) {
    const auto x = triple(sqrt(Wide(std::abs(numbers.any()))));
    const double y = numbers.any();
    const auto product = x * y;
    EXPECT_LE(abs(wide(product) - wide(x) * y), ldexp(abs(wide(x) * y), -150));
    EXPECT_EQ(product.hi + product.mid, product.hi);
    EXPECT_LE(std::abs(product.lo), std::ldexp(std::abs(product.mid), -52));
    // nearest_double agrees with the rounding of the wide number.
    const auto near = nearest_double(product);
    EXPECT_EQ(near.nearest, wide(product).convert_to<double>());
    EXPECT_EQ(near.beyond > 0.0, wide(product) > near.nearest);
  }
}

TEST(TripleDouble, TheLastPartDecidesHalfWayBetweenTwoDoubles) {
  constexpr double half = 0x1p-53, tiny = 0x1p-110;
  EXPECT_EQ(nearest_double({1.0, half, tiny}).nearest, 1.0 + 0x1p-52);
  EXPECT_LT(nearest_double({1.0, half, tiny}).beyond, 0.0);
  EXPECT_EQ(nearest_double({1.0, half, -tiny}).nearest, 1.0);
  EXPECT_GT(nearest_double({1.0, half, -tiny}).beyond, 0.0);
  EXPECT_EQ(nearest_double({1.0, -half / 2, -tiny}).nearest, 1.0 - 0x1p-53);
  EXPECT_EQ(nearest_double({1.0, -half / 2, tiny}).nearest, 1.0);
  EXPECT_EQ(nearest_double({1.0, half / 2, tiny}).nearest, 1.0);
  EXPECT_EQ(nearest_double({1.0, 0.0, tiny}).nearest, 1.0);
}

TEST(HalfTurns, SineAndCosineAreTrueTo63AndTo98Bits) {
  const Wide pi_wide = 4 * atan(Wide(1));
  EXPECT_LE(abs(wide(pi) - pi_wide), ldexp(Wide(1), -106));
  Numbers numbers(seed + 3);
  for (int i = 0; i < many; ++i) {
    // Small and large angles, and some at the seams between table entries.
    const double size = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 1e-3 : 4e8;
    double hi = numbers.uniform(-size, size);
    if (i % 5 == 0) hi = (std::floor(hi * 128.0) + 0.5) / 128.0;
    const auto y = quick_two_sum(hi, std::ldexp(hi * numbers.uniform(-1.0, 1.0), -54));
    const auto [sine, cosine] = sincospi(y);
    EXPECT_LE(abs(wide(sine) - sin(pi_wide * wide(y))), ldexp(Wide(1), -63)) << "y = " << y.hi;
    EXPECT_LE(abs(wide(cosine) - cos(pi_wide * wide(y))), ldexp(Wide(1), -63)) << "y = " << y.hi;
    const auto precise = precise_sincospi(y);
    EXPECT_LE(abs(wide(precise.sine) - sin(pi_wide * wide(y))), ldexp(Wide(1), -98)) << y.hi;
    EXPECT_LE(abs(wide(precise.cosine) - cos(pi_wide * wide(y))), ldexp(Wide(1), -98)) << y.hi;
  }
}

TEST(HalfTurns, ZerosAreExact) {
  for (int i = -9; i <= 9; ++i) {
    EXPECT_EQ(sincospi({double(i), 0.0}).sine.hi, 0.0);
    EXPECT_EQ(sincospi({i + 0.5, 0.0}).cosine.hi, 0.0);
    EXPECT_EQ(sincospi({double(i), 0.0}).cosine.hi, i % 2 == 0 ? 1.0 : -1.0);
  }
}

TEST(PowerOfTwo, IsTrueTo66Bits) {
  EXPECT_LE(abs(wide(ln2) - log(Wide(2))), ldexp(Wide(1), -107));
  Numbers numbers(seed + 4);
  for (int i = 0; i < many; ++i) {
    const double size = i % 2 == 0 ? 1.0 : 4000.0;
    double hi = numbers.uniform(-size, size);
    if (i % 5 == 0) hi = (std::floor(hi * 64.0) + 0.5) / 64.0;
    const auto x = quick_two_sum(hi, std::ldexp(hi * numbers.uniform(-1.0, 1.0), -54));
    const auto power = exp2(x);
    const Wide reference = exp(log(Wide(2)) * (wide(x) - power.exponent));
    EXPECT_LE(abs(wide(power.significand) / reference - 1), ldexp(Wide(1), -66)) << "x = " << x.hi;
    EXPECT_GE(power.significand.hi, 0.99);
    EXPECT_LT(power.significand.hi, 2.02);
  }
}

TEST(PowerOfTwo, ScalingRoundsOnceIntoTheSubnormals) {
  for (const double x : {1.0, -1.75, 1.0 + 0x1p-52, 1e200, 3e-200})
    for (int exponent = -1800; exponent <= 400; exponent += 7)
      EXPECT_EQ(scale(x, exponent), std::ldexp(x, exponent)) << x << " " << exponent;
  EXPECT_EQ(scale(1.0, -1074), 5e-324);
  EXPECT_EQ(scale(1.0, -1023), 0x1p-1023);
  EXPECT_EQ(scale(1.0, 1023), 0x1p1023);
}

}  // namespace
}  // namespace clackers::numerics
