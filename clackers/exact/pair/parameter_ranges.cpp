#include "clackers/exact/pair/parameter_ranges.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"

namespace clackers::exact {

void require_scale(std::string_view who, std::string_view name, double value, double smallest,
                   double largest) {
  if (!(value >= smallest && value <= largest))
    refuse(who, name, value, fmt::format("{} <= {} <= {}", smallest, name, largest),
           value > 0.0 ? "Choose other units; beyond, derived quantities leave double precision."
                       : "It must be positive.");
}

void require_damping_ratio(std::string_view who, double xi1) {
  if (xi1 == 0.0 || (xi1 >= smallest_scale && xi1 < 1.0)) return;
  refuse(who, "xi1", xi1, "0 or 1e-60 <= xi1 < 1",
         xi1 >= 1.0  ? "At 1 and beyond mass 1 does not oscillate, so nothing collides again."
         : xi1 > 0.0 ? "Below 1e-60 use 0."
                     : "A negative damping ratio would feed energy in.");
}

void require_restitution(std::string_view who, double eta) {
  if (!(eta >= 0.0 && eta <= 1.0))
    refuse(who, "eta", eta, "0 <= eta <= 1", "0 is perfectly plastic, 1 perfectly elastic.");
}

}  // namespace clackers::exact
