#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "bindings/c/clackers.h"
#include "clackers/model/motion.hpp"

/// A case with its motion, as the caller of C holds it; defined in handle.hpp.
struct clackers_motion;

namespace clackers::c_api {

/// Throws InputError (null-pointer) if `pointer` is null; `who` is the function, `name` its argument.
void require_pointer(std::string_view who, std::string_view name, const void* pointer);

/// Reads a side; throws InputError for anything but CLACKERS_LEFT and CLACKERS_RIGHT.
model::Side read_side(std::string_view who, clackers_side side);

/// The caller's arrays for `count` states of `dof` masses. Throws InputError unless they are large
/// enough and u and v are there (for no state at all they may be null).
model::SampleBuffers read_buffers(std::string_view who, std::string_view name,
                                  const clackers_buffers* buffers, std::size_t count, int dof);

/// Copies one state into arrays that read_buffers() made.
void write_state(const model::Kinematics& state, const model::SampleBuffers& out);

}  // namespace clackers::c_api
