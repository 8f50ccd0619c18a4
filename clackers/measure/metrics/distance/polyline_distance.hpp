#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace clackers::measure {

/// Points joined by straight segments, in a space whose first coordinate is a (scaled) time. Times
/// do not descend; two points of one time are joined as well, by a vertical segment. All
/// coordinates are finite.
class Polyline {
 public:
  /// Writes points, row-major (point, coordinate): `count` of them from number `first` on.
  using Points = std::function<void(std::size_t first, std::size_t count, double* to)>;

  /// Of `size` points, one or more, which are made block by block whenever they are needed: a long line
  /// takes no memory. `largest` is their largest coordinate, by size.
  Polyline(std::size_t dimension, std::size_t size, double largest, Points points)
      : dimension_(dimension), size_(size), largest_(largest), points_(std::move(points)) {}
  /// Of points in memory. Throws InputError for none and for times that descend.
  Polyline(std::size_t dimension, std::vector<double> points);

  std::size_t dimension() const { return dimension_; }
  std::size_t size() const { return size_; }
  double largest() const { return largest_; }
  void copy(std::size_t first, std::size_t count, double* to) const { points_(first, count, to); }
  std::vector<double> point(std::size_t i) const;

 private:
  std::size_t dimension_, size_;
  double largest_;
  Points points_;
};

/// A line whose coordinates are numbers of a table over scales, row by row, with more points between.
struct LineOfRows {
  struct Column {
    const double* first;  ///< of row 0
    std::size_t stride;
    double scale;
  };
  std::vector<Column> columns;  ///< the time first
  std::size_t first, last;      ///< rows from the first to before the last
  /// Number k of the other points, row-major and scaled, stands before row places[k]; these ascend.
  std::vector<std::size_t> places{};
  std::vector<double> more{};

  Polyline line() &&;
};

/// A one-sided distance.
struct PolylineDistance {
  double value = 0.0;    ///< attained by a point of the line, or the `at_least` given
  double bound = 0.0;    ///< the supremum is no greater: value (1 + 1e-6) and some roundings
  bool complete = true;  ///< false: the search was given up, value and bound mean nothing
};

/// The reason of a metric whose search was given up.
inline constexpr auto too_far_apart =
    "The motions are so far apart that the search for their distance was given up.";

/// The one-sided Hausdorff distance sup over points p of `from`, inner points of segments too, of
/// the distance from p to `to`; points are as far apart as their farthest coordinates,
/// max_i |p_i - q_i|. The search starts from `at_least`, so the result is no smaller: with the
/// distance of one side as `at_least` of the other, the two-sided one costs little more than one.
///
/// Method. The distance to one segment, a convex set, is convex along another one. So the part of a
/// segment of `from` that lies within the largest distance seen so far of one segment of `to` is
/// one interval, and its ends follow from the coordinates in closed form. Each segment of `from` is
/// covered by such parts, first of the segment of `to` used last, then of those after it and of the
/// one at the same time. Only where none covers it, segments of `to` are searched outwards from the
/// time of the point, until one is within the largest distance seen or those left are farther in
/// time alone than the nearest found; then the largest distance grows. A segment that is still not
/// covered is halved until its halves are or the bound above holds.
///
/// Cost. O(n) where lines are close to each other. A search costs the segments within the distance
/// that it finds; one that looks at more than 64 segments for each point of both lines, and 1e6, in
/// all gives up (docs/decisions/0009). Coordinates of any finite size are handled: lines are scaled
/// by a power of two where the largest coordinate is outside [2^-300, 2^300], and coordinates below
/// 2^-100 of it count as 0.
/// Source: early breaking, A. A. Taha, A. Hanbury, IEEE Trans. Pattern Anal. Mach. Intell. 37 (11),
/// 2153-2163 (2015); the convexity of the bound is elementary.
///
/// Throws InputError unless both lines have the same dimension.
PolylineDistance one_sided_distance(const Polyline& from, const Polyline& to,
                                    double at_least = 0.0);

}  // namespace clackers::measure
