#pragma once

#include "clackers/certified/ball.hpp"

namespace clackers::certified {

/// Where sin(x) / (X sin(x/X)) has its minimum, x = X theta: the only zero in (pi, 3 pi/2) of
/// h(x) = X sin(x/X) cos(x) - sin(x) cos(x/X), for odd X >= 5. It is the only one because
/// h' = -(X - 1/X) sin(x/X) sin(x) > 0 there. Certain to `bits`.
Ball graze_angle(double X, long bits);

/// r*(X) = sqrt(1 + (X^2 - 1) sin^2(x/X)) at that x, for odd X >= 3; exactly 3 for X = 3, where
/// x = 3 pi/2. Certain to `bits`.
Ball r_star(double X, long bits);

}  // namespace clackers::certified
