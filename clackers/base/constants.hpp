#pragma once

#include <limits>

namespace clackers {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unknown = nan;  ///< a number that was not measured

/// Synchrony counts as lost when the time between two impacts is wrong by this part of T.
inline constexpr double lost_synchrony = 0.1;

}  // namespace clackers
