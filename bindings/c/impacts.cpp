#include "bindings/c/guard.hpp"
#include "bindings/c/handle.hpp"
#include "bindings/c/versioned.hpp"

using namespace clackers;
using namespace clackers::c_api;

clackers_status clackers_motion_impact_count(const clackers_motion* motion, double t,
                                             int64_t* count) {
  return guarded([&] {
    const auto& reference = motion_of("clackers_motion_impact_count", motion);
    require_pointer("clackers_motion_impact_count", "count", count);
    *count = reference.impact_count(t);
  });
}

clackers_status clackers_motion_impact(const clackers_motion* motion, int64_t index,
                                       clackers_impact* impact, const clackers_buffers* before,
                                       const clackers_buffers* after) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_impact";
    const auto& reference = motion_of(who, motion);
    require_pointer(who, "impact", impact);
    require_size(who, *impact);
    const auto arrays = [&](const char* name, const clackers_buffers* given) {
      return given == nullptr ? model::SampleBuffers{}
                              : read_buffers(who, name, given, 1, reference.dof());
    };
    const auto left = arrays("before", before), right = arrays("after", after);
    const auto hit = reference.impact(index);
    write_versioned(*impact, {.struct_size = 0,  // the caller's stays
                              .index = hit.index,
                              .contact = hit.contact,
                              .t = hit.t,
                              .t_lo = hit.when.lo,
                              .t_hi = hit.when.hi,
                              .impulse = hit.impulse,
                              .energy_before = hit.energy_before,
                              .energy_after = hit.energy_after});
    if (before != nullptr) write_state(hit.before, left);
    if (after != nullptr) write_state(hit.after, right);
  });
}
