#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "clackers/cases/case.hpp"

namespace clackers::cases {

/// The derived constant of this name; fails the test where the case has none.
inline double constant(const Case& test_case, std::string_view name) {
  for (const auto& c : test_case.constants)
    if (c.name == name) return c.value;
  ADD_FAILURE() << "no constant " << name;
  return NAN;
}

}  // namespace clackers::cases
