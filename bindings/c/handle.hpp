#pragma once

#include "bindings/c/arguments.hpp"
#include "clackers/cases/case.hpp"

struct clackers_motion {
  clackers::cases::Case test_case;
};

namespace clackers::c_api {

/// The case behind a handle; throws InputError if it is null.
inline const cases::Case& case_of(std::string_view who, const clackers_motion* motion) {
  require_pointer(who, "motion", motion);
  return motion->test_case;
}

inline const model::Motion& motion_of(std::string_view who, const clackers_motion* motion) {
  return *case_of(who, motion).motion;
}

}  // namespace clackers::c_api
