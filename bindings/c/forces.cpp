#include <fmt/format.h>

#include <algorithm>

#include "bindings/c/guard.hpp"
#include "bindings/c/handle.hpp"
#include "clackers/base/error.hpp"
#include "clackers/model/forces.hpp"

using namespace clackers;
using namespace clackers::c_api;

clackers_status clackers_motion_force_count(const clackers_motion* motion, size_t* contacts,
                                            size_t* springs, size_t* frictions) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_force_count";
    const auto counts = model::force_counts(case_of(who, motion).problem);
    require_pointer(who, "contacts", contacts);
    require_pointer(who, "springs", springs);
    require_pointer(who, "frictions", frictions);
    *contacts = size_t(counts.contacts);
    *springs = size_t(counts.springs);
    *frictions = size_t(counts.frictions);
  });
}

clackers_status clackers_motion_forces(const clackers_motion* motion, double t, clackers_side side,
                                       size_t capacity, double* forces) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_forces";
    const auto& test_case = case_of(who, motion);
    const auto limit = read_side(who, side);
    const auto count = model::force_counts(test_case.problem).all();
    if (count > 0) require_pointer(who, "forces", forces);
    if (capacity < size_t(count))
      refuse(who, "capacity", fmt::to_string(capacity),
             fmt::format("at least {}, one for each force", count), {}, "wrong-size");
    const auto now = model::forces(test_case.problem, *test_case.motion, t, limit);
    std::copy(now.begin(), now.end(), forces);
  });
}
