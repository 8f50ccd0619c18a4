#pragma once

#include <functional>

#include "clackers/base/judgement.hpp"

namespace clackers::assess {

/// The order that a few runs show.
struct ObservedOrder {
  double order = 0.0;   ///< NaN when the errors carry no straight line
  double spread = 0.0;  ///< half width of its 95 % confidence interval, NaN likewise
  Behaviour behaviour = Behaviour::undecided;
};

/// The order of `error(h)` over h, h/2, ..., h/2^(levels-1), by the same fitter that judges
/// ladders: on the finest straight window of at least four levels above rounding. The floor is
/// taken as that of a run of unit length and unit size, 2^-52 / h. For tests of smooth motion,
/// where one run a level is enough. Throws InputError unless 0 < h < infinity and 4 <= levels
/// <= 50.
ObservedOrder observed_order(const std::function<double(double)>& error, double h, int levels);

}  // namespace clackers::assess
