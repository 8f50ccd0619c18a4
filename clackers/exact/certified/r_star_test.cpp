// The sharp form of Eq. (18), proved for every odd X up to 1001 by interval arithmetic. With
// x = X theta in (0, X pi/2], theta counted from an impact, u1 - u2 has the sign of
//
//     F_r(x) = X sin(x/X) + r sin(x).
//
// r* is the largest r for which F_r >= 0, since F_r = (1 - r/r*) X sin(x/X) + (r/r*) F_r*: it is
// shown that F_r* > 0 outside [4, 5], convex on it, and that its minimum there is 0.
#ifdef CLACKERS_HAS_ARB

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clackers/exact/certified/ball.hpp"
#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::certified {
namespace {

constexpr double largest = 1001.0;

Ball stationary(const Ball& X, const Ball& x) {
  const Ball theta = x / X;
  return X * sin(theta) * cos(x) - sin(x) * cos(theta);
}

Ball slope_of_stationary(const Ball& X, const Ball& x) {
  return -((X - Ball(1.0) / X) * sin(x / X) * sin(x));
}

// Where sin(x) / (X sin(x/X)) has its minimum, x = X theta: the only zero in (pi, 3 pi/2) of
// h(x) = X sin(x/X) cos(x) - sin(x) cos(x/X), for odd X >= 5. It is the only one because
// h' = -(X - 1/X) sin(x/X) sin(x) > 0 there. Certain to `bits`.
Ball graze_angle(double X_odd, long bits) {
  for (long working = bits + 64;; working *= 2) {
    const WorkingBits scope(working);
    const Ball X = X_odd;
    // Newton from a point in the middle of where the zeros of all X lie, without any proof.
    Ball x = 4.5;
    for (long known = 1; known < 2 * working; known *= 2)
      x = middle(x - stationary(X, x) / slope_of_stationary(X, x));
    // The proof: h is rising and changes its sign within this distance, all within (pi, 3 pi/2).
    const Ball reach = scaled(Ball(1.0), -(bits + 8));
    const Ball low = x - reach, high = x + reach;
    if (Ball::pi() < low && high < Ball(1.5) * Ball::pi() && stationary(X, low).is_negative() &&
        stationary(X, high).is_positive()) {
      arb_add_error_2exp_si(x.get(), -(bits + 8));
      return x;
    }
  }
}

// r*(X) = sqrt(1 + (X^2 - 1) sin^2(x/X)) at that x, for odd X >= 3; exactly 3 for X = 3, where
// x = 3 pi/2. Certain to `bits`.
Ball r_star(double X_odd, long bits) {
  if (X_odd == 3.0) return 3.0;
  // r* changes less than x does, relative to itself (the minimum is flat), and sin and sqrt lose a
  // few bits.
  const Ball x = graze_angle(X_odd, bits + 16);
  const WorkingBits scope(bits + 96);
  const Ball X = X_odd, sine = sin(x / X);
  return sqrt(Ball(1.0) + (X * X - 1.0) * sine * sine);
}

// The smallest ball of few bits that holds [low, high].
Ball hull(double low, double high) {
  Ball c;
  const Ball a(low), b(high);
  arb_set_interval_arf(c.get(), arb_midref(a.get()), arb_midref(b.get()), WorkingBits::now());
  return c;
}

Ball separation(const Ball& X, const Ball& r, const Ball& x) { return X * sin(x / X) + r * sin(x); }
Ball slope(const Ball& X, const Ball& r, const Ball& x) { return cos(x / X) + r * cos(x); }
Ball curvature(const Ball& X, const Ball& r, const Ball& x) {
  return -(sin(x / X) / X) - r * sin(x);
}

// `holds` for balls that together cover [low, high], halved where it is not seen yet.
bool everywhere(double low, double high, auto holds, int depth = 12) {
  if (holds(hull(low, high))) return true;
  if (depth == 0) return false;
  const double middle = low + 0.5 * (high - low);
  return everywhere(low, middle, holds, depth - 1) && everywhere(middle, high, holds, depth - 1);
}

// F_r(x) >= F_r(middle) - |F_r'| radius: sharper than F_r of the ball.
bool is_apart(const Ball& X, const Ball& r, const Ball& x) {
  return (separation(X, r, middle(x)) - abs(slope(X, r, x)) * radius(x)).is_positive();
}

// F_r > 0 for 0 < x <= low, and from `high` to X pi/2. F_r(0) = 0.
bool is_apart_around(const Ball& X, const Ball& r, double low, double high) {
  // From 0 it rises; 3/2 < pi/2.
  const bool rises =
      everywhere(0.0, 1.5, [&](const Ball& x) { return slope(X, r, x).is_positive(); });
  const bool left = everywhere(1.5, low, [&](const Ball& x) { return is_apart(X, r, x); });
  // Where X sin(x/X) > r, sin(x) has no say any more; sin rises up to theta = pi/2, X pi/2.
  const Ball end = X * Ball::pi() / 2.0;
  double last = high;
  while (last < 12.0 && !(X * sin(Ball(last) / X) > r)) last += 0.25;
  const bool tail = Ball(last) < end;
  const bool right = everywhere(high, last, [&](const Ball& x) { return is_apart(X, r, x); });
  return rises && left && right && tail;
}

TEST(RStar, IsTheLargestRatioThatKeepsTheMassesApartForEveryOddXUpTo1001) {
  Ball before = 3.0;
  for (double odd = 5.0; odd <= largest; odd += 2.0) {
    SCOPED_TRACE(testing::Message() << "X = " << odd);
    const WorkingBits scope(64);
    const Ball X = odd, r = r_star(odd, 40), x = graze_angle(odd, 40);
    EXPECT_TRUE(is_apart_around(X, r, 4.0, 5.0));
    // One minimum in [4, 5], at the zero of h, where F and F' vanish together: 0 lies in both.
    EXPECT_TRUE(
        everywhere(4.0, 5.0, [&](const Ball& at) { return curvature(X, r, at).is_positive(); }));
    EXPECT_TRUE(Ball(4.0) < x && x < Ball(5.0));
    EXPECT_TRUE(separation(X, r, x).holds_zero());
    EXPECT_TRUE(slope(X, r, x).holds_zero());
    EXPECT_TRUE(before < r && r < Ball(4.60333884876)) << "rising to r_infinity";
    before = r;
    // A ratio a little larger is not admissible.
    EXPECT_TRUE(separation(X, r * 1.0000001, x).is_negative());
  }
}

TEST(RStar, Equation18IsProvedAndStrictFromXOf5On) {
  for (double odd = 5.0; odd <= largest; odd += 2.0) {
    SCOPED_TRACE(testing::Message() << "X = " << odd);
    const WorkingBits scope(64);
    // Without any word of r*: r = 3 leaves module everywhere, smaller ratios leave more.
    EXPECT_TRUE(is_apart_around(odd, 3.0, 4.5, 4.5));
  }
}

TEST(RStar, Equation18OfXOf3HoldsForRBelow3AndGrazesAt3) {
  const WorkingBits scope(64);
  const Ball X = 3.0;
  // x ends at 3 pi/2, theta = pi/2, the start of the motion: F_3 is 0 there with its slope, convex
  // before it, positive before that.
  EXPECT_TRUE(everywhere(0.0, 1.5, [&](const Ball& x) { return slope(X, 3.0, x).is_positive(); }));
  EXPECT_TRUE(everywhere(1.5, 4.0, [&](const Ball& x) { return is_apart(X, 3.0, x); }));
  EXPECT_TRUE(
      everywhere(4.0, 4.75, [&](const Ball& x) { return curvature(X, 3.0, x).is_positive(); }));
  const Ball end = Ball(1.5) * Ball::pi();
  EXPECT_TRUE(end < Ball(4.75) && separation(X, 3.0, end).holds_zero());
  EXPECT_TRUE(slope(X, 3.0, end).holds_zero());
  EXPECT_TRUE(separation(X, std::nextafter(3.0, 0.0), end).is_positive());
  EXPECT_TRUE(separation(X, std::nextafter(3.0, 4.0), end).is_negative());
  EXPECT_EQ(r_star(3.0, 50).middle(), 3.0);
}

TEST(RStar, DoubleResultsAreTheNearestDoubles) {
  for (double odd = 3.0; odd <= largest; odd += 2.0)
    EXPECT_EQ(exact::r_star(odd), r_star(odd, 100).middle()) << "X = " << odd;
  for (const double odd : {400001.0, 999999999.0})
    EXPECT_EQ(exact::r_star(odd), r_star(odd, 160).middle()) << "X = " << odd;
}

TEST(RStar, IsCertainToAnyNumberOfBits) {
  for (const long bits : {20L, 200L, 5000L}) {
    EXPECT_GE(r_star(9.0, bits).accuracy(), bits);
    EXPECT_GE(graze_angle(9.0, bits).accuracy(), bits);
  }
  const auto rough = r_star(9.0, 20), fine = r_star(9.0, 5000);
  EXPECT_TRUE(arb_overlaps(rough.get(), fine.get()));
  // X = 5: sin^2(x/5) is 5/8 and r* is 4.
  EXPECT_TRUE(r_star(5.0, 300).holds(4.0));
}

TEST(RStar, TheProofFindsWhatIsNotTrue) {
  const WorkingBits scope(64);
  EXPECT_FALSE(is_apart_around(9.0, 4.42, 4.5, 4.5));
  EXPECT_FALSE(is_apart_around(5.0, 4.0, 4.5, 4.5));
  EXPECT_TRUE(is_apart_around(9.0, 4.4, 4.5, 4.5));
}

}  // namespace
}  // namespace clackers::certified

#endif
