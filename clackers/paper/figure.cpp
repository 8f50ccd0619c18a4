#include "clackers/paper/figure.hpp"

namespace clackers::paper {

Stroke first_mass() { return {"var(--m1)", {1, 0}, 2.0}; }

Stroke second_mass() { return {"var(--m2)", {5, 2}, 1.3}; }

}  // namespace clackers::paper
