#include "clackers/assess/metrics/distance/polyline_distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "clackers/assess/metrics/distance/box_tree.hpp"
#include "clackers/assess/metrics/distance/segment_distance.hpp"
#include "clackers/base/error.hpp"

namespace clackers::assess {
namespace {

constexpr double relative_excess = 1e-6;
constexpr std::size_t probes = 64;  // points that are measured before the walk

template <std::size_t Dimension>
class TimeLoop {
  using Point = std::conditional_t<Dimension == 0, std::vector<double>,
                                   std::array<double, std::max<std::size_t>(Dimension, 1)>>;

 public:
  TimeLoop(const Polyline& from, const Polyline& to, double at_least)
      : from_(from), to_(to), measure_(from.dimension), tree_(to, measure_), value_(at_least) {
    // Differences of coordinates and products with s round by a few units of the coordinates.
    double largest = 0.0;
    for (const auto* line : {&from, &to})
      for (const double x : line->points) largest = std::max(largest, std::abs(x));
    rounding_ = 8.0 * std::numeric_limits<double>::epsilon() * largest;
  }

  PolylineDistance run() {
    const auto count = from_.size();
    // A good first value spares searches: what is far away is often far away everywhere.
    const auto stride = std::max<std::size_t>(count / probes, 1);
    for (std::size_t i = count; i > 0; i -= std::min(i, stride)) measure(point(i - 1));
    last_ = 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double* a = point(i);
      while (same_time_ + 1 < tree_.segments() && tree_.finish(same_time_)[0] <= a[0]) ++same_time_;
      cover(a, point(i + 1));
    }
    return {value_, radius()};
  }

 private:
  using Nearest = typename BoxTree<Dimension>::Nearest;

  const double* point(std::size_t i) const {
    return from_.points.data() + i * measure_.dimension();
  }
  // What counts as within the largest distance seen.
  double radius() const { return value_ * (1.0 + relative_excess) + rounding_; }

  Nearest measure(const double* p) {
    const auto found = tree_.nearest(p, last_);
    value_ = std::max(value_, found.distance);
    last_ = found.segment;
    return found;
  }

  // Goes on from `done`, the part of the segment from a to b that is within the radius, to as far
  // as another segment serves.
  bool extend(const double* a, const double* b, std::size_t segment, double& done) {
    if (segment >= tree_.segments()) return false;
    const auto part =
        measure_.part_within(a, b, tree_.start(segment), tree_.finish(segment), radius());
    if (!(part.low <= done && part.high > done)) return false;
    last_ = segment;
    done = part.high;
    return true;
  }

  // The next two find, without a division or with one, that all from a to b is within the radius.
  // Start is near start and end near end of one segment: so is what lies between.
  bool is_beside(const double* a, const double* b, std::size_t segment) {
    if (measure_.to_point(a, tree_.start(segment)) > radius()) return false;
    if (measure_.to_point(b, tree_.finish(segment)) > radius()) return false;
    last_ = segment;
    return true;
  }

  // The same with the way from a part f of this segment over the joint q to part f of the next one:
  // a, the point 1 - f on the way to b, and b are near its three points.
  bool is_along(const double* a, const double* b, std::size_t segment) {
    if (segment + 1 >= tree_.segments()) return false;
    const double *q0 = tree_.start(segment), *q1 = tree_.finish(segment);
    const double* q2 = tree_.finish(segment + 1);
    double ahead = 0.0, length = 0.0;
    for (std::size_t i = 0; i < measure_.dimension(); ++i) {
      ahead += (a[i] - q0[i]) * (q1[i] - q0[i]);
      length += (q1[i] - q0[i]) * (q1[i] - q0[i]);
    }
    const double f = ahead / length, r = radius();
    if (!(f >= 0.0 && f <= 1.0)) return false;
    for (std::size_t i = 0; i < measure_.dimension(); ++i) {
      if (std::abs(q0[i] + f * (q1[i] - q0[i]) - a[i]) > r) return false;
      if (std::abs(a[i] + (1.0 - f) * (b[i] - a[i]) - q1[i]) > r) return false;
      if (std::abs(q1[i] + f * (q2[i] - q1[i]) - b[i]) > r) return false;
    }
    last_ = segment + 1;
    return true;
  }

  // Makes sure that no point from a to b is farther away than radius(), which grows if need be.
  void cover(const double* a, const double* b) {
    for (const auto k : {last_ + 1, last_})
      if (k < tree_.segments() && (is_beside(a, b, k) || is_along(a, b, k))) return;
    double done = 0.0;
    for (;;) {
      extend(a, b, last_, done);
      while (done < 1.0 && (extend(a, b, last_ + 1, done) || extend(a, b, same_time_, done))) {
      }
      if (done >= 1.0) return;
      Point here = between(a, b, done);
      const double before = done, rest = measure_.to_point(here.data(), b);
      const auto nearest = measure(here.data());
      if (extend(a, b, nearest.segment, done) && done - before > 0.1 * (1.0 - before)) continue;
      // On the rest the distance grows by at most the way gone.
      if (nearest.distance + rest <= radius()) return;
      const Point middle = between(a, b, 0.5 * (before + 1.0));
      measure(b);
      measure(middle.data());
      last_ = nearest.segment;
      cover(here.data(), middle.data());
      cover(middle.data(), b);
      return;
    }
  }

  auto between(const double* a, const double* b, double s) const {
    Point made{};
    if constexpr (Dimension == 0) made.resize(measure_.dimension());
    for (std::size_t i = 0; i < measure_.dimension(); ++i) made[i] = a[i] + s * (b[i] - a[i]);
    return made;
  }

  const Polyline &from_, &to_;
  SegmentDistance<Dimension> measure_;
  BoxTree<Dimension> tree_;
  double value_, rounding_ = 0.0;
  std::size_t last_ = 0;       // the segment that served last
  std::size_t same_time_ = 0;  // the segment at the time of the walk
};

void require_line(const Polyline& line) {
  if (line.dimension == 0 || line.points.empty() || line.points.size() % line.dimension != 0)
    throw InputError(fmt::format("polyline: {} coordinates of points with {}; allowed: one point "
                                 "or more.",
                                 line.points.size(), line.dimension),
                     "wrong-size");
  for (std::size_t i = 1; i < line.size(); ++i)
    if (!(line.point(i)[0] >= line.point(i - 1)[0]))
      refuse("polyline", "time of a point", line.point(i)[0], "times that do not descend");
}

}  // namespace

PolylineDistance one_sided_distance(const Polyline& from, const Polyline& to, double at_least) {
  require_line(from);
  require_line(to);
  if (from.dimension != to.dimension)
    throw InputError(
        fmt::format("polyline: lines of {} and {} coordinates; allowed: equal numbers.",
                    from.dimension, to.dimension),
        "wrong-size");
  switch (from.dimension) {
    case 2:
      return TimeLoop<2>(from, to, at_least).run();
    case 3:
      return TimeLoop<3>(from, to, at_least).run();
    case 5:
      return TimeLoop<5>(from, to, at_least).run();
    default:
      return TimeLoop<0>(from, to, at_least).run();
  }
}

PolylineDistance hausdorff_distance(const Polyline& one, const Polyline& other) {
  return one_sided_distance(other, one, one_sided_distance(one, other).value);
}

}  // namespace clackers::assess
