#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// The most points of a curve in a figure.
inline constexpr std::size_t most_points = 1000;

/// The points 0, ..., n-1 that a figure of `rows` curves needs, ascending: all of them, or at most
/// `most`, of every stretch the lowest and the highest point of each curve. `value(row, point)`.
std::vector<std::size_t> kept_points(std::size_t n, std::size_t rows, const auto& value,
                                     std::size_t most = most_points) {
  std::vector<std::size_t> kept;
  const bool all = n <= most;
  const auto stretches =
      all ? n : std::max<std::size_t>(most / (2 * std::max<std::size_t>(rows, 1)), 1);
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto from = n * s / stretches, to = n * (s + 1) / stretches;
    if (all) kept.push_back(from);
    for (std::size_t row = 0; row < rows && !all; ++row) {
      auto lowest = from, highest = from;
      auto least = value(row, from), most_of_all = least;
      for (auto i = from; i < to; ++i) {
        const auto now = value(row, i);
        if (now < least) lowest = i, least = now;
        if (!(now < most_of_all)) highest = i, most_of_all = now;
      }
      kept.push_back(lowest);
      kept.push_back(highest);
    }
  }
  std::ranges::sort(kept);
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

/// The curve through kept_points of n points at `time(point)`.
template <class Time, class Value>
Curve reduced(std::size_t n, std::size_t rows, const Time& time, const Value& value,
              std::size_t most = most_points) {
  Curve out;
  out.y.resize(rows);
  for (const auto point : kept_points(n, rows, value, most)) {
    out.t.push_back(time(point));
    for (std::size_t row = 0; row < rows; ++row) out.y[row].push_back(value(row, point));
  }
  return out;
}

/// The curve with at most `most` points.
inline Curve reduced(const Curve& curve, std::size_t most = most_points) {
  return reduced(
      curve.t.size(), curve.y.size(), [&](std::size_t i) { return curve.t[i]; },
      [&](std::size_t row, std::size_t i) { return curve.y[row][i]; }, most);
}

}  // namespace clackers::record
