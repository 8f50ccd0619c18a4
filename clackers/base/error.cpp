#include "clackers/base/error.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clackers {

void refuse(std::string_view who, std::string_view name, std::string_view value,
            std::string_view allowed, std::string_view hint, Code code) {
  auto message = fmt::format("{}: {} = {}; allowed: {}.", who, name, value, allowed);
  if (!hint.empty()) message.append(" ").append(hint);
  throw InputError(message, code);
}

void refuse(std::string_view who, std::string_view name, double value, std::string_view allowed,
            std::string_view hint, Code code) {
  if (std::isnan(value)) code = "not-a-number";
  if (std::isinf(value)) code = "not-finite";
  refuse(who, name, fmt::format("{}", value), allowed, hint, code);
}

}  // namespace clackers
