#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace clackers::assess {

/// Points joined by straight segments, in a space whose first coordinate is a (scaled) time. Times
/// do not descend; two points of one time are joined as well, by a vertical segment. All
/// coordinates are finite.
struct Polyline {
  std::size_t dimension = 2;
  std::vector<double> points;  ///< row-major (point, coordinate)

  std::size_t size() const { return points.size() / dimension; }
  std::span<const double> point(std::size_t i) const {
    return {points.data() + i * dimension, dimension};
  }
};

/// A distance that a point attains, and what it is certainly not greater than.
struct PolylineDistance {
  double value = 0.0;  ///< attained by a point of the line, or the `at_least` given
  double bound = 0.0;  ///< the supremum is no greater: value (1 + 1e-6) and some roundings
};

/// The one-sided Hausdorff distance sup over points p of `from`, inner points of segments too, of
/// the distance from p to `to`; points are as far apart as their farthest coordinates,
/// max_i |p_i - q_i|. The search starts from `at_least`, so the result is no smaller: with the
/// distance of one side as `at_least` of the other, the two-sided one costs little more than one.
///
/// Method. The distance to one segment, a convex set, is convex along another one. So the part of a
/// segment of `from` that lies within the largest distance seen so far of one segment of `to` is one
/// interval, and its ends follow from the coordinates in closed form. A walk along `from` covers
/// each segment by such parts, first of the segment of `to` that served last, then of those after
/// it and of the one at the same time. Only where none serves, the nearest segment is searched in
/// a tree of boxes over `to`, which may raise the largest distance; a segment that is still not
/// covered is halved until its halves are or the bound above holds.
///
/// Cost. O(n) to build the tree and to walk; O(log n) a search where a line bends slowly against its
/// sampling. A search opens no box farther away than the distance that it finds, so at worst (a
/// line that sweeps up and down within every box) it costs the segments within that distance in
/// time; there is no list of all pairs in any case.
/// Source: early breaking, A. A. Taha, A. Hanbury, IEEE Trans. Pattern Anal. Mach. Intell. 37 (11),
/// 2153-2163 (2015); the convexity of the bound is elementary.
///
/// Throws InputError unless both lines have the same dimension, at least one point, and times that
/// do not descend.
PolylineDistance one_sided_distance(const Polyline& from, const Polyline& to,
                                    double at_least = 0.0);

/// The larger of both one-sided distances.
PolylineDistance hausdorff_distance(const Polyline& one, const Polyline& other);

}  // namespace clackers::assess
