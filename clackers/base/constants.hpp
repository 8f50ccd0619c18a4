#pragma once

#include <limits>

namespace clackers {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unknown = nan;  ///< a number that was not measured

}  // namespace clackers
