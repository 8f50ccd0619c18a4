#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "clackers/assess/metrics/distance/polyline_distance.hpp"
#include "clackers/assess/metrics/distance/segment_distance.hpp"

namespace clackers::assess {

/// Finds the segment of a line that is nearest to a point: boxes around blocks of consecutive
/// segments, in a binary tree. A line of one point counts as one segment of length 0.
template <std::size_t Dimension>
class BoxTree {
 public:
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t segment = 0;
  };

  /// The line must outlive the tree.
  BoxTree(const Polyline& line, const SegmentDistance<Dimension>& measure)
      : line_(line), measure_(measure), segments_(std::max<std::size_t>(line.size(), 2) - 1) {
    leaves_ = std::bit_ceil((segments_ + block - 1) / block);
    const auto d = measure_.dimension();
    const double infinity = std::numeric_limits<double>::infinity();
    low_.assign(2 * leaves_ * d, infinity);
    high_.assign(2 * leaves_ * d, -infinity);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const double* p = line.points.data() + i * d;
      // A point ends one segment and starts the next.
      if (i < segments_) widen(leaves_ + i / block, p);
      if (i > 0) widen(leaves_ + (i - 1) / block, p);
    }
    for (std::size_t node = leaves_ - 1; node > 0; --node)
      for (std::size_t i = 0; i < d; ++i) {
        low_[node * d + i] = std::min(low_[2 * node * d + i], low_[(2 * node + 1) * d + i]);
        high_[node * d + i] = std::max(high_[2 * node * d + i], high_[(2 * node + 1) * d + i]);
      }
  }

  std::size_t segments() const { return segments_; }
  const double* start(std::size_t segment) const {
    return line_.points.data() + segment * measure_.dimension();
  }
  const double* finish(std::size_t segment) const {
    return start(std::min(segment + 1, line_.size() - 1));
  }

  /// The segment nearest to p, starting from a guess.
  Nearest nearest(const double* p, std::size_t guess) const {
    Nearest found{measure_.to_segment(p, start(guess), finish(guess)), guess};
    visit(1, p, found);
    return found;
  }

 private:
  static constexpr std::size_t block = 8;

  void widen(std::size_t node, const double* p) {
    const auto d = measure_.dimension();
    for (std::size_t i = 0; i < d; ++i) {
      low_[node * d + i] = std::min(low_[node * d + i], p[i]);
      high_[node * d + i] = std::max(high_[node * d + i], p[i]);
    }
  }

  double to_box(std::size_t node, const double* p) const {
    const auto d = measure_.dimension();
    double farthest = 0.0;
    for (std::size_t i = 0; i < d; ++i)
      farthest = std::max({farthest, low_[node * d + i] - p[i], p[i] - high_[node * d + i]});
    return farthest;
  }

  void visit(std::size_t node, const double* p, Nearest& found) const {
    if (node >= leaves_) {
      const auto first = (node - leaves_) * block;
      for (auto k = first; k < std::min(first + block, segments_); ++k) {
        const double distance = measure_.to_segment(p, start(k), finish(k));
        if (distance < found.distance) found = {distance, k};
      }
      return;
    }
    std::size_t near = 2 * node, far = near + 1;
    double near_distance = to_box(near, p), far_distance = to_box(far, p);
    if (far_distance < near_distance) {
      std::swap(near, far);
      std::swap(near_distance, far_distance);
    }
    if (near_distance < found.distance) visit(near, p, found);
    if (far_distance < found.distance) visit(far, p, found);
  }

  const Polyline& line_;
  const SegmentDistance<Dimension>& measure_;
  std::size_t segments_, leaves_ = 1;
  std::vector<double> low_, high_;  // (node, coordinate); node 1 is the root, 2n and 2n+1 its parts
};

}  // namespace clackers::assess
