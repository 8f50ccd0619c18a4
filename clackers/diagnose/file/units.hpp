#pragma once

#include <array>
#include <cmath>
#include <string_view>

namespace clackers::diagnose {

/// A unit that is used in place of one of SI.
struct Unit {
  double factor = 1.0;  ///< of numbers in this unit over those in SI
  std::string_view name;
};

/// In place of m; a v with the same factor is in "mm/s".
inline constexpr auto length_units = std::to_array<Unit>({
    {1e3, "mm"},
    {1e2, "cm"},
    {1e1, "dm"},
    {1e6, "um"},
    {1e-3, "km"},
    {1.0 / 0.0254, "in"},
    {39.37, "in"},
    {1.0 / 0.3048, "ft"},
    {3.281, "ft"},
    {9.81, "g"},
    {9.80665, "g"},
    {1.0 / 9.81, "1/g"},
});

/// In place of s. Numbers of a time are multiplied by the factor, those of a velocity divided.
inline constexpr auto time_units = std::to_array<Unit>({
    {1e3, "ms"},
    {1e6, "us"},
    {1e9, "ns"},
    {1.0 / 60.0, "min"},
    {1.0 / 3600.0, "h"},
});

/// The unit whose factor is nearest, within a relative tolerance; nullptr for none.
template <std::size_t size>
const Unit* unit_of(const std::array<Unit, size>& units, double factor, double tolerance) {
  const Unit* nearest = nullptr;
  for (const auto& unit : units) {
    const double off = std::abs(factor / unit.factor - 1.0);
    if (off > tolerance) continue;
    tolerance = off;
    nearest = &unit;
  }
  return nearest;
}

}  // namespace clackers::diagnose
