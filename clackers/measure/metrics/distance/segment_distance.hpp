#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace clackers::measure {

/// Distances max_i |p_i - q_i| from points to segments, for a number of coordinates known at
/// compile time, or 0 for any. Points are pointers to `dimension` doubles. Extents of a segment of
/// at most `negligible` count as 0 where they would be divided by.
template <std::size_t Dimension>
class SegmentDistance {
 public:
  explicit SegmentDistance(std::size_t dimension, double negligible = 0.0)
      : dimension_(dimension), negligible_(negligible) {}

  std::size_t dimension() const {
    if constexpr (Dimension > 0)
      return Dimension;
    else
      return dimension_;
  }

  double to_point(const double* p, const double* q) const {
    double farthest = 0.0;
    for (std::size_t i = 0; i < dimension(); ++i)
      farthest = std::max(farthest, std::abs(p[i] - q[i]));
    return farthest;
  }

  /// The distance from p to the smallest box that holds the segment: no more than that to it.
  double to_box(const double* p, const double* q0, const double* q1) const {
    double farthest = 0.0;
    for (std::size_t i = 0; i < dimension(); ++i)
      farthest = std::max({farthest, std::min(q0[i], q1[i]) - p[i], p[i] - std::max(q0[i], q1[i])});
    return farthest;
  }

  /// A part [low, high] of a segment, in its parameter from 0 to 1; empty if high < low.
  struct Part {
    double low = 0.0, high = 1.0;
  };

  /// The part of the segment from p0 to p1 within `radius` of the segment from q0 to q1. It is one
  /// interval, as the distance to a convex set is convex along a line. A point at s and one at x on
  /// the other segment are near enough if, coordinate by coordinate, x lies between two lines over
  /// s; the s for which every lower line lies below every upper one are the interval.
  Part part_within(const double* p0, const double* p1, const double* q0, const double* q1,
                   double radius) const {
    auto lower = lines(), upper = lines();
    lower[0] = {0.0, 0.0};
    upper[0] = {1.0, 0.0};
    std::size_t count = 1;
    Part part;
    for (std::size_t i = 0; i < dimension(); ++i) {
      const double a = p0[i] - q0[i], c = p1[i] - p0[i], b = q1[i] - q0[i];
      if (std::abs(b) <= negligible_) {
        keep(part, {radius - a, -c});
        keep(part, {radius + a, c});
        continue;
      }
      const double inverse = 1.0 / b, reach = radius * std::abs(inverse);
      lower[count] = {a * inverse - reach, c * inverse};
      upper[count] = {a * inverse + reach, c * inverse};
      ++count;
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        keep(part, {upper[i].at0 - lower[j].at0, upper[i].slope - lower[j].slope});
    return part;
  }

  /// The distance from p to the segment from q0 to q1. It is the minimum over s of the largest of
  /// the lines |a_i + b_i s|, a convex function: a falling line to its left and a rising one to its
  /// right are replaced by the one that is largest where they meet, until none is larger.
  double to_segment(const double* p, const double* q0, const double* q1) const {
    Line left = steepest(p, q0, q1, 0.0, 1.0), right = steepest(p, q0, q1, 1.0, -1.0);
    if (left.slope >= 0.0) return left.value;  // the minimum is q0
    if (right.slope <= 0.0) return right.value;
    double left_s = 0.0, right_s = 1.0, best = std::min(left.value, right.value);
    // Each round takes a line that was not taken before, of 2 a coordinate.
    for (std::size_t round = 0; round < 2 * dimension(); ++round) {
      // left(s) = right(s) with both lines through their own points.
      const double s = (right.value - right.slope * right_s - left.value + left.slope * left_s) /
                       (left.slope - right.slope);
      if (!(s > left_s && s < right_s)) break;
      const double crossing = left.value + left.slope * (s - left_s);
      const Line top = steepest(p, q0, q1, s, 1.0);
      best = std::min(best, top.value);
      if (top.value <= crossing || top.slope == 0.0) break;
      if (top.slope < 0.0) {
        left = top;
        left_s = s;
      } else {
        right = top;
        right_s = s;
      }
    }
    return best;
  }

 private:
  struct Line {
    double value, slope;
  };
  // A line over s, or what has to be >= 0 there.
  struct Over {
    double at0, slope;
  };

  auto lines() const {
    if constexpr (Dimension > 0)
      return std::array<Over, Dimension + 1>{};
    else
      return std::vector<Over>(dimension_ + 1);
  }

  // Most pairs hold all along, which needs no division.
  static void keep(Part& part, const Over& positive) {
    const double at1 = positive.at0 + positive.slope;
    if (positive.at0 >= 0.0 && at1 >= 0.0) return;
    if (positive.at0 >= 0.0)
      part.high = std::min(part.high, positive.at0 / -positive.slope);
    else if (at1 >= 0.0)
      part.low = std::max(part.low, -positive.at0 / positive.slope);
    else
      part.low = std::numeric_limits<double>::infinity();
  }

  // The largest line at s and its slope; of several the one that is largest towards `side`.
  Line steepest(const double* p, const double* q0, const double* q1, double s, double side) const {
    Line top{-1.0, 0.0};
    for (std::size_t i = 0; i < dimension(); ++i) {
      const double b = q1[i] - q0[i];
      // At the ends no rounding of a + b s: a shared point has distance 0.
      const double x = s == 1.0 ? q1[i] - p[i] : q0[i] - p[i] + b * s;
      const double value = std::abs(x);
      const double slope = x > 0.0 ? b : x < 0.0 ? -b : side * std::abs(b);
      if (value > top.value || (value == top.value && side * slope > side * top.slope))
        top = {value, slope};
    }
    return top;
  }

  std::size_t dimension_;
  double negligible_;
};

}  // namespace clackers::measure
