#include "clackers/base/check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers {

double require_finite(std::string_view who, std::string_view name, double value) {
  if (!std::isfinite(value)) refuse(who, name, value, "a finite number", {}, "not-finite");
  return value;
}

double require_positive(std::string_view who, std::string_view name, double value) {
  if (!(value > 0.0 && std::isfinite(value)))
    refuse(who, name, value, fmt::format("0 < {} < infinity", name));
  return value;
}

double require_within(std::string_view who, std::string_view name, double value, double lowest,
                      double highest) {
  if (!(value >= lowest && value <= highest))
    refuse(who, name, value, fmt::format("{} <= {} <= {}", lowest, name, highest));
  return value;
}

double require_step(std::string_view who, double h) {
  if (!(h > 0.0 && std::isfinite(h)))
    refuse(who, "h", h, "0 < h < infinity, in seconds", {}, "step-not-positive");
  return h;
}

}  // namespace clackers
