#include "clackers/measure/metrics/distance/polyline_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>

#include "clackers/base/error.hpp"
#include "clackers/measure/metrics/distance/segment_distance.hpp"

namespace clackers::measure {
namespace {

struct Line {
  std::size_t dimension = 2;
  std::vector<double> points{};

  std::size_t size() const { return points.size() / dimension; }
  const double* point(std::size_t i) const { return points.data() + i * dimension; }
  operator Polyline() const { return {dimension, points}; }
};

Line line(std::initializer_list<std::pair<double, double>> points) {
  Line made;
  for (const auto& [t, x] : points) made.points.insert(made.points.end(), {t, x});
  return made;
}

// The larger of both one-sided distances.
PolylineDistance hausdorff_distance(const Polyline& line, const Polyline& other) {
  const auto first = one_sided_distance(line, other);
  return first.complete ? one_sided_distance(other, line, first.value) : first;
}

// The bound's excess over the value: 1e-6 of it.
constexpr double excess = 1e-6;

TEST(PolylineDistance, OfParallelLinesIsTheirOffset) {
  const auto one = line({{0, 0}, {1, 0}}), other = line({{0, 0.3}, {0.4, 0.3}, {1, 0.3}});
  EXPECT_DOUBLE_EQ(one_sided_distance(one, other).value, 0.3);
  EXPECT_DOUBLE_EQ(one_sided_distance(other, one).value, 0.3);
}

TEST(PolylineDistance, IsZeroForTheSameSetWhateverItsPoints) {
  const auto one = line({{0, 0}, {1, 0.7}, {1, -0.7}, {3, 0.1}});
  EXPECT_EQ(hausdorff_distance(one, one).value, 0.0);
  const auto more = line({{0, 0}, {0.5, 0.35}, {1, 0.7}, {1, 0.2}, {1, 0.5}, {1, -0.7}, {3, 0.1}});
  EXPECT_LT(hausdorff_distance(one, more).value, 4e-16);
}

TEST(PolylineDistance, FindsTheFarthestPointInsideASegment) {
  // Over a bridge from (0, 0) over height 3 to (2, 0): min(t, 2 - t, 3) is 1 in the middle, 0 at
  // both ends.
  const auto flat = line({{0, 0}, {2, 0}});
  const auto bridge = line({{0, 0}, {0, 3}, {2, 3}, {2, 0}});
  const auto found = one_sided_distance(flat, bridge);
  EXPECT_LE(found.value, 1.0);
  EXPECT_GE(found.bound, 1.0);
  EXPECT_LT(found.bound - found.value, 2 * excess);
  // Lower than half its length the bridge itself is nearest.
  const auto low = line({{0, 0}, {0, 0.8}, {2, 0.8}, {2, 0}});
  EXPECT_NEAR(one_sided_distance(flat, low).value, 0.8, 0.8 * excess);
}

TEST(PolylineDistance, ASpikeCountsOnTheSideThatHasIt) {
  const auto flat = line({{0, 0}, {2, 0}}), spike = line({{0, 0}, {1, 0}, {1, 2}, {1, 0}, {2, 0}});
  EXPECT_EQ(one_sided_distance(flat, spike).value, 0.0);
  EXPECT_EQ(one_sided_distance(spike, flat).value, 2.0);
  EXPECT_EQ(hausdorff_distance(flat, spike).value, 2.0);
  EXPECT_EQ(hausdorff_distance(spike, flat).value, 2.0);
}

TEST(PolylineDistance, OfAJumpThatComesLateIsTheDelay) {
  const auto jump = [](double t) { return line({{0, -1}, {t, -1}, {t, 1}, {3, 1}}); };
  for (const double delay : {0.3, 0.01, 1e-6})
    EXPECT_NEAR(hausdorff_distance(jump(1.0), jump(1.0 + delay)).value, delay, 4e-16);
}

TEST(PolylineDistance, OfASmearedJumpIsAlittleLessThanItsLength) {
  // On the ramp (w s, s) the vertical is w s away and the level after it 1 - s: equal at
  // s = 1/(1 + w). From the top of the vertical, (0, 1), the ramp is as far.
  const auto jump = line({{-1, 0}, {0, 0}, {0, 1}, {1, 1}});
  for (const double w : {0.5, 0.01, 1e-5}) {
    const auto ramp = line({{-1, 0}, {0, 0}, {w, 1}, {1, 1}});
    const double exact = w / (1.0 + w);
    EXPECT_NEAR(one_sided_distance(ramp, jump).value, exact, 2 * excess * exact);
    EXPECT_NEAR(one_sided_distance(jump, ramp).value, exact, 2 * excess * exact);
  }
}

TEST(PolylineDistance, NeverFallsBelowTheValueItStartsFrom) {
  const auto one = line({{0, 0}, {1, 0}}), other = line({{0, 0.3}, {1, 0.3}});
  EXPECT_EQ(one_sided_distance(one, other, 0.5).value, 0.5);
  EXPECT_DOUBLE_EQ(one_sided_distance(one, other, 0.1).value, 0.3);
}

TEST(PolylineDistance, TakesLinesOfOnePoint) {
  EXPECT_EQ(hausdorff_distance(line({{1, 1}}), line({{0, 0}})).value, 1.0);
  EXPECT_EQ(one_sided_distance(line({{1, 1}}), line({{0, 0}, {2, 0}})).value, 1.0);
  EXPECT_EQ(one_sided_distance(line({{0, 0}, {2, 0}}), line({{0.5, 0}})).value, 1.5);
}

TEST(PolylineDistance, SeesLongSegmentsBetweenShortOnesWhereverTheyStand) {
  // One after another each segment is the long one, so that it also joins two blocks of the tree.
  for (int gap = 0; gap < 20; ++gap) {
    Line to;
    double t = 0.0, before = 0.0;
    for (int i = 0; i <= 20; ++i) {
      to.points.insert(to.points.end(), {t, 0.0});
      if (i == gap) before = t;
      t += i == gap ? 1.0 : 0.01;
    }
    for (const double s : {0.2, 0.8})
      EXPECT_DOUBLE_EQ(one_sided_distance(line({{before + s, 0.1}}), to).value, 0.1) << gap;
  }
}

// Distances by brute force: every segment, and many points of each.
double to_segment(const double* p, const double* q0, const double* q1, std::size_t dimension,
                  int rounds = 40) {
  double low = 0.0, high = 1.0;
  const auto at = [&](double s) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < dimension; ++i)
      farthest = std::max(farthest, std::abs(q0[i] + s * (q1[i] - q0[i]) - p[i]));
    return farthest;
  };
  for (int i = 0; i < rounds; ++i) {  // convex: thirds; (2/3)^40 = 1e-7
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return at(low);
}

double brute_force(const Line& from, const Line& to, int parts) {
  const auto d = from.dimension;
  double farthest = 0.0;
  std::vector<double> p(d);
  for (std::size_t i = 0; i + 1 < from.size(); ++i)
    for (int part = 0; part <= parts; ++part) {
      for (std::size_t c = 0; c < d; ++c)
        p[c] = from.point(i)[c] + part * (from.point(i + 1)[c] - from.point(i)[c]) / parts;
      double nearest = INFINITY;
      for (std::size_t k = 0; k + 1 < to.size(); ++k)
        nearest = std::min(nearest, to_segment(p.data(), to.point(k), to.point(k + 1), d));
      farthest = std::max(farthest, nearest);
    }
  return farthest;
}

Line random_line(std::mt19937& generator, std::size_t dimension, int points) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Line made{.dimension = dimension, .points = {}};
  double t = 0.0;
  for (int i = 0; i < points; ++i) {
    if (any(generator) > -0.5) t += 0.2 * (1.0 + any(generator));  // one in four stands still
    made.points.push_back(t);
    for (std::size_t c = 1; c < dimension; ++c) made.points.push_back(any(generator));
  }
  return made;
}

TEST(PolylineDistance, AgreesWithEveryPairOfSegments) {
  std::mt19937 generator(7);
  for (const std::size_t dimension : {2u, 3u, 4u, 5u})
    for (int trial = 0; trial < 3; ++trial) {
      SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", trial " << trial);
      const auto one = random_line(generator, dimension, 30);
      const auto other = random_line(generator, dimension, 20);
      const int parts = 10;
      const double sampled = brute_force(one, other, parts);
      const auto found = one_sided_distance(one, other);
      // Samples are at most half a part of the longest segment (length 2) from any point.
      EXPECT_GE(found.bound, sampled - 1e-6);
      EXPECT_LE(found.value, sampled + 1.0 / parts);
    }
}

TEST(PolylineDistance, AgreesWithEveryPairWhereOneLineFollowsTheOther) {
  // Points lie at other parts of the curve, and one of them is off it, by more or less than the
  // rest.
  for (const double shift : {0.002, 0.008})
    for (const double off : {0.003, 0.05}) {
      Line one, other;
      for (int i = 0; i <= 50; ++i) {
        const double t = 0.02 * i;
        one.points.insert(one.points.end(), {t, std::sin(9.0 * t)});
        other.points.insert(other.points.end(),
                            {t + shift, std::sin(9.0 * t) + (i == 30 ? off : 0.0)});
      }
      SCOPED_TRACE(testing::Message() << "shift " << shift << ", off " << off);
      for (const auto& [from, to] : {std::pair{&one, &other}, std::pair{&other, &one}}) {
        const double sampled = brute_force(*from, *to, 6);
        const auto found = one_sided_distance(*from, *to);
        EXPECT_GE(found.bound, sampled - 1e-6);
        // Half of a sixth of the longest segment, 0.18, and what thirds leave of one.
        EXPECT_LE(found.value, sampled + 0.016);
        EXPECT_NEAR(found.bound, found.value, 2e-6 * found.value + 1e-14);
      }
    }
}

TEST(PolylineDistance, ScalesWithCoordinatesOfAnySize) {
  std::mt19937 generator(3);
  const auto one = random_line(generator, 3, 30), other = random_line(generator, 3, 20);
  const double value = one_sided_distance(one, other).value;
  const auto times = [](Line line, int exponent) {
    for (double& x : line.points) x = std::ldexp(x, exponent);
    return line;
  };
  // At 2^-1060 coordinates have ten binary digits or more left.
  for (const int exponent : {-1060, -1000, -300, 300, 1000}) {
    const double found = one_sided_distance(times(one, exponent), times(other, exponent)).value;
    EXPECT_NEAR(std::ldexp(found, -exponent), value, exponent < -1022 ? 0.01 : 1e-9) << exponent;
  }
}

TEST(PolylineDistance, SubnormalSegmentsOfALineAreCovered) {
  const auto one = line({{450, 3e-311}, {453, 8e-313}}), other = line({{450, 0}, {453, -5e-324}});
  EXPECT_LT(hausdorff_distance(one, other).value, 1e-300);
  EXPECT_NEAR(hausdorff_distance(one, line({{450, 1}, {453, 1}})).value, 1.0, 1e-12);
}

TEST(PolylineDistance, SearchOfLinesFarApartIsGivenUp) {
  // Every other point is farther away than all before it, and all of the other line is nearer in
  // time than that.
  Line one, other;
  for (int i = 0; i < 100000; ++i) {
    one.points.insert(one.points.end(), {1e-3 * i, i % 2 == 0 ? 1e3 + 1e-2 * i : 0.0});
    other.points.insert(other.points.end(), {1e-3 * i, 0.0});
  }
  EXPECT_FALSE(one_sided_distance(one, other).complete);
  EXPECT_FALSE(hausdorff_distance(one, other).complete);
  EXPECT_TRUE(one_sided_distance(other, one).complete);
}

TEST(SegmentDistance, IsTheMinimumOverTheSegmentAndDecidesAlike) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    double p[5], q0[5], q1[5];
    for (int i = 0; i < 5; ++i) {
      p[i] = any(generator);
      q0[i] = any(generator);
      q1[i] = any(generator) > 0.5 ? q0[i] : any(generator);
    }
    const SegmentDistance<5> five(5);
    const SegmentDistance<0> any_number(4);
    const double exact = to_segment(p, q0, q1, 5, 120);
    // Both round by a few units of numbers below 2; thirds stop at 1e-8 of a flat minimum at most.
    EXPECT_NEAR(five.to_segment(p, q0, q1), exact, 1e-14) << "trial " << trial;
    EXPECT_NEAR(any_number.to_segment(p, q0, q1), to_segment(p, q0, q1, 4, 120), 1e-14);
    const auto part = five.part_within(p, p, q0, q1, exact + 1e-14);
    EXPECT_TRUE(part.low <= part.high);
    const auto none = five.part_within(p, p, q0, q1, exact - 1e-14);
    EXPECT_FALSE(none.low <= none.high);
  }
}

TEST(PolylineDistance, LinesOfRowsAreThoseOfTheirPoints) {
  constexpr std::size_t first = 3, last = 1700, stride = 2;
  std::vector<double> t, x;
  for (std::size_t i = 0; i < last; ++i) {
    t.push_back(double(i));
    x.insert(x.end(), {std::sin(0.01 * double(i)), 1e9});
  }
  const std::vector<std::size_t> places = {3, 3, 400, 512, 1024, 1024, 1024, last};
  std::vector<double> more, points;
  for (const auto place : places)
    more.insert(more.end(), {(double(place) - 0.5) / 3.0, double(more.size())});
  for (std::size_t row = first, k = 0; row <= last; ++row) {
    for (; k < places.size() && places[k] == row; ++k)
      points.insert(points.end(), {more[2 * k], more[2 * k + 1]});
    if (row < last) points.insert(points.end(), {t[row] / 3.0, x[stride * row] / 0.1});
  }
  const auto made =
      LineOfRows{{{t.data(), 1, 3.0}, {x.data(), stride, 0.1}}, first, last, places, more}.line();
  const Polyline expected(2, points);
  ASSERT_EQ(made.size(), expected.size());
  EXPECT_EQ(made.largest(), expected.largest());
  for (std::size_t from = 0; from < made.size(); from += 97) {
    const auto count = std::min<std::size_t>(97, made.size() - from);
    std::vector<double> found(2 * count), wanted(2 * count);
    made.copy(from, count, found.data());
    expected.copy(from, count, wanted.data());
    EXPECT_EQ(found, wanted) << from;
  }
  EXPECT_EQ(hausdorff_distance(made, expected).value, 0.0);
}

TEST(PolylineDistance, RefusesLinesThatCannotBeCompared) {
  const auto good = line({{0, 0}, {1, 0}});
  EXPECT_THROW(one_sided_distance(good, Line{}), InputError);
  EXPECT_THROW(one_sided_distance(Line{}, good), InputError);
  EXPECT_THROW(one_sided_distance(good, Line{.dimension = 3, .points = {0, 0, 0}}), InputError);
  EXPECT_THROW(one_sided_distance(good, Line{.dimension = 2, .points = {0, 0, 0}}), InputError);
  EXPECT_THROW(one_sided_distance(line({{1, 0}, {0, 0}}), good), InputError);
}

}  // namespace
}  // namespace clackers::measure
