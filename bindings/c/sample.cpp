#include "bindings/c/guard.hpp"
#include "bindings/c/handle.hpp"

using namespace clackers::c_api;

clackers_status clackers_motion_dof(const clackers_motion* motion, int32_t* dof) {
  return guarded([&] {
    const auto& reference = motion_of("clackers_motion_dof", motion);
    require_pointer("clackers_motion_dof", "dof", dof);
    *dof = reference.dof();
  });
}

clackers_status clackers_motion_end(const clackers_motion* motion, double* end) {
  return guarded([&] {
    const auto& reference = motion_of("clackers_motion_end", motion);
    require_pointer("clackers_motion_end", "end", end);
    *end = reference.end();
  });
}

clackers_status clackers_motion_sample(const clackers_motion* motion, const double* times,
                                       size_t count, clackers_side side,
                                       const clackers_buffers* out) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_sample";
    const auto& reference = motion_of(who, motion);
    if (count > 0) require_pointer(who, "times", times);
    const auto limit = read_side(who, side);
    reference.sample({times, count}, limit, read_buffers(who, "out", out, count, reference.dof()));
  });
}

clackers_status clackers_motion_envelope(const clackers_motion* motion, double t,
                                         const clackers_buffers* out) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_envelope";
    const auto& reference = motion_of(who, motion);
    const auto arrays = read_buffers(who, "out", out, 1, reference.dof());
    write_state(reference.envelope(t), arrays);
  });
}

clackers_status clackers_motion_error_bound(const clackers_motion* motion, double t,
                                            const clackers_buffers* out) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_error_bound";
    const auto& reference = motion_of(who, motion);
    const auto arrays = read_buffers(who, "out", out, 1, reference.dof());
    write_state(reference.error_bound(t), arrays);
  });
}
