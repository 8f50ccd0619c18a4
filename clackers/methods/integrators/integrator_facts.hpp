#pragma once

#include <string>

namespace clackers::methods {

/// An integrator's card as data: its claims while nothing collides.
struct IntegratorFacts {
  std::string name;    ///< as typed: "newmark:beta=0.3"
  double order = 0.0;  ///< of u and v
  bool unconditionally_stable = false;
  double stability_limit = 0.0;  ///< largest omega h of undamped motion; infinity if unconditional
};

}  // namespace clackers::methods
