#include "clackers/cases/admissibility.hpp"

#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/parameters.hpp"

namespace clackers::cases {

Admissibility admissibility(double X, double r) {
  const auto ratio = exact::frequency_ratio("admissibility", X);
  exact::require_scale("admissibility", "r", r);
  return {exact::r_star(ratio.odd), exact::admissibility_margin(ratio, r)};
}

}  // namespace clackers::cases
