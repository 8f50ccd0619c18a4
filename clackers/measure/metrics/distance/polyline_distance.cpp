#include "clackers/measure/metrics/distance/polyline_distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "clackers/base/block_window.hpp"
#include "clackers/base/error.hpp"
#include "clackers/measure/metrics/distance/segment_distance.hpp"

namespace clackers::measure {
namespace {

constexpr double relative_excess = 1e-6;
constexpr std::size_t probes = 64;  // points that are measured first
constexpr double most_looks = 64.0, least_most_looks = 1e6;
constexpr int largest_exponent = 300;

double largest_of(const std::vector<double>& coordinates) {
  double largest = 0.0;
  for (const double x : coordinates) largest = std::max(largest, std::abs(x));
  return largest;
}

// All coordinates times 2^exponent.
BlockWindow<double> window(const Polyline& line, int exponent) {
  return {line.size(), line.dimension(),
          [&line, exponent](std::size_t first, std::size_t count, double* to) {
            line.copy(first, count, to);
            if (exponent == 0) return;
            for (std::size_t i = 0; i < count * line.dimension(); ++i)
              to[i] = std::ldexp(to[i], exponent);
          }};
}

template <std::size_t Dimension>
class DistanceSearch {
  using Point = std::conditional_t<Dimension == 0, std::vector<double>,
                                   std::array<double, std::max<std::size_t>(Dimension, 1)>>;

 public:
  DistanceSearch(const Polyline& from, const Polyline& to, int exponent, double at_least,
                 double largest)
      : from_(window(from, exponent)),
        to_(window(to, exponent)),
        segments_(std::max<std::size_t>(to.size(), 2) - 1),
        measure_(from.dimension(), 0x1p-100 * largest),
        value_(at_least),
        // Differences of coordinates and products with s round by a few units of the coordinates.
        rounding_(8.0 * std::numeric_limits<double>::epsilon() * largest),
        looks_left_(std::max(least_most_looks, most_looks * double(from.size() + to.size()))) {}

  PolylineDistance run() {
    const auto count = from_.size();
    // A good first value spares searches: what is far away is often far away everywhere.
    const auto stride = std::max<std::size_t>(count / probes, 1);
    for (std::size_t i = 0; i < count; i += stride) measure(jump(point(i)));
    measure(jump(point(count - 1)));
    last_ = 0;
    for (std::size_t i = 0; i + 1 < count && looks_left_ > 0.0; ++i) {
      const double *const a = point(i), *const b = point(i + 1);
      if (is_near(a, b)) continue;
      const double before = value_;
      cover(follow(a), b);
      if (value_ > before) climb(i + 1);
    }
    return {value_, radius(), looks_left_ > 0.0};
  }

 private:
  struct Nearest {
    double distance;
    std::size_t segment;
  };

  const double* point(std::size_t i) { return from_[i]; }
  const double* start(std::size_t segment) { return to_[segment]; }
  const double* finish(std::size_t segment) { return start(std::min(segment + 1, to_.size() - 1)); }
  // What counts as within the largest distance seen.
  double radius() const { return value_ * (1.0 + relative_excess) + rounding_; }

  // Finds the segment of `to` at the time of p, the first that ends later, beside the one used last.
  const double* follow(const double* p) {
    at_time_ = last_;
    while (at_time_ > 0 && finish(at_time_ - 1)[0] > p[0]) --at_time_;
    while (at_time_ + 1 < segments_ && finish(at_time_)[0] <= p[0]) ++at_time_;
    return p;
  }

  // The same by bisection, which makes no blocks on its way.
  const double* jump(const double* p) {
    Point end{};
    if constexpr (Dimension == 0) end.resize(measure_.dimension());
    at_time_ = 0;
    for (auto last = segments_ - 1; at_time_ < last;) {
      const auto middle = (at_time_ + last) / 2;
      to_.copy(middle + 1, end.data());
      if (end[0] <= p[0])
        at_time_ = middle + 1;
      else
        last = middle;
    }
    return p;
  }

  // The distance from p where it is larger than any before, otherwise that of some segment within
  // the largest distance.
  Nearest measure(const double* p) {
    Nearest nearest{measure_.to_segment(p, start(last_), finish(last_)), last_};
    const auto look = [&](std::size_t segment) {
      looks_left_ -= 1.0;
      if (measure_.to_box(p, start(segment), finish(segment)) >= nearest.distance) return;
      const double distance = measure_.to_segment(p, start(segment), finish(segment));
      if (distance < nearest.distance) nearest = {distance, segment};
    };
    std::size_t later = at_time_, earlier = at_time_;
    bool more_later = true, more_earlier = earlier > 0;
    while ((more_later || more_earlier) && nearest.distance > value_ && looks_left_ > 0.0) {
      if (more_later) {
        look(later++);
        more_later = later < segments_ && start(later)[0] - p[0] < nearest.distance;
      }
      if (more_earlier) {
        look(--earlier);
        more_earlier = earlier > 0 && p[0] - finish(earlier - 1)[0] < nearest.distance;
      }
    }
    value_ = std::max(value_, nearest.distance);
    last_ = nearest.segment;
    return nearest;
  }

  // Where the largest distance has grown it often grows on from point to point: looks ahead with
  // doubled strides for as long as it does, without moving on.
  void climb(std::size_t from) {
    const auto last = last_;
    double before = 0.0;
    for (std::size_t stride = 1; from + stride < from_.size() && value_ > before; stride *= 2) {
      before = value_;
      measure(jump(point(from + stride)));
    }
    last_ = last;
  }

  // Goes on from `done`, the part of the segment from a to b that is within the radius, to as far
  // as another segment is.
  bool extend(const double* a, const double* b, std::size_t segment, double& done) {
    if (segment >= segments_) return false;
    const auto part = measure_.part_within(a, b, start(segment), finish(segment), radius());
    if (!(part.low <= done && part.high > done)) return false;
    last_ = segment;
    done = part.high;
    return true;
  }

  bool is_near(const double* a, const double* b) {
    return is_near(a, b, last_ + 1) || is_near(a, b, last_);
  }
  // Start near start and end near end of one segment: so is what lies between. Without a division.
  bool is_near(const double* a, const double* b, std::size_t segment) {
    if (segment >= segments_ || measure_.to_point(a, start(segment)) > radius() ||
        measure_.to_point(b, finish(segment)) > radius())
      return false;
    last_ = segment;
    return true;
  }

  // Makes sure that no point from a to b is farther away than radius(), which grows if need be.
  void cover(const double* a, const double* b) {
    if (is_near(a, b)) return;
    double done = 0.0;
    while (looks_left_ > 0.0) {
      extend(a, b, last_, done);
      while (done < 1.0 && (extend(a, b, last_ + 1, done) || extend(a, b, at_time_, done))) {
      }
      if (done >= 1.0) return;
      const Point here = between(a, b, done);
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

  Point between(const double* a, const double* b, double s) const {
    Point point{};
    if constexpr (Dimension == 0) point.resize(measure_.dimension());
    for (std::size_t i = 0; i < measure_.dimension(); ++i) point[i] = a[i] + s * (b[i] - a[i]);
    return point;
  }

  BlockWindow<double> from_, to_;
  std::size_t segments_;  // a line of one point counts as one segment of length 0
  SegmentDistance<Dimension> measure_;
  double value_, rounding_;
  double looks_left_;
  std::size_t last_ = 0;     // the segment used last
  std::size_t at_time_ = 0;  // the segment at the time of the point of `from`
};

}  // namespace

Polyline::Polyline(std::size_t dimension, std::vector<double> points)
    : Polyline(dimension, dimension == 0 ? 0 : points.size() / dimension, largest_of(points), {}) {
  if (size_ == 0 || points.size() % dimension != 0)
    throw InputError(fmt::format("polyline: {} coordinates of points with {}; allowed: one point "
                                 "or more.",
                                 points.size(), dimension),
                     "wrong-size");
  for (std::size_t i = dimension; i < points.size(); i += dimension)
    if (!(points[i] >= points[i - dimension]))
      refuse("polyline", "time of a point", points[i], "times that do not descend");
  points_ = [dimension, all = std::move(points)](std::size_t first, std::size_t count, double* to) {
    std::copy_n(all.data() + first * dimension, count * dimension, to);
  };
}

Polyline LineOfRows::line() && {
  const auto dimension = columns.size(), size = last - first + places.size();
  double largest = largest_of(more);
  for (const auto& column : columns) {
    double most = 0.0;
    for (auto row = first; row < last; ++row)
      most = std::max(most, std::abs(column.first[row * column.stride]));
    largest = std::max(largest, most / column.scale);  // division keeps the order
  }
  for (std::size_t k = 0; k < places.size(); ++k) places[k] += k - first;  // numbers of points
  const auto make = [dimension, rows = std::move(*this)](std::size_t from, std::size_t count,
                                                         double* to) {
    const auto& numbers = rows.places;
    auto k = std::size_t(std::ranges::lower_bound(numbers, from) - numbers.begin());
    for (auto i = from; i < from + count;) {
      const auto next = k < numbers.size() ? std::min(numbers[k], from + count) : from + count;
      const auto row = rows.first + i - k, run = next - i;
      for (std::size_t c = 0; c < dimension; ++c) {
        const auto [column, stride, scale] = rows.columns[c];
        for (std::size_t j = 0; j < run; ++j)
          to[j * dimension + c] = column[(row + j) * stride] / scale;
      }
      to += run * dimension;
      i = next;
      if (i == from + count) break;
      to = std::copy_n(rows.more.data() + dimension * k++, dimension, to);
      ++i;
    }
  };
  return {dimension, size, largest, make};
}

std::vector<double> Polyline::point(std::size_t i) const {
  std::vector<double> coordinates(dimension_);
  points_(i, 1, coordinates.data());
  return coordinates;
}

PolylineDistance one_sided_distance(const Polyline& from, const Polyline& to, double at_least) {
  if (from.dimension() != to.dimension())
    throw InputError(
        fmt::format("polyline: lines of {} and {} coordinates; allowed: equal numbers.",
                    from.dimension(), to.dimension()),
        "wrong-size");
  const double largest = std::max(from.largest(), to.largest());
  int exponent = 0;
  if (largest > 0.0) std::frexp(largest, &exponent);
  if (std::abs(exponent) <= largest_exponent) exponent = 0;
  const auto search = [&](auto dimension) {
    auto found = DistanceSearch<dimension>(from, to, -exponent, std::ldexp(at_least, -exponent),
                                           std::ldexp(largest, -exponent))
                     .run();
    found.value = std::ldexp(found.value, exponent);
    found.bound = std::ldexp(found.bound, exponent);
    return found;
  };
  switch (from.dimension()) {
    case 2:
      return search(std::integral_constant<std::size_t, 2>());
    case 5:
      return search(std::integral_constant<std::size_t, 5>());
    default:
      return search(std::integral_constant<std::size_t, 0>());
  }
}

}  // namespace clackers::measure
