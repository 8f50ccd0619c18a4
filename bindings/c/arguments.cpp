#include "bindings/c/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/c/versioned.hpp"
#include "clackers/base/error.hpp"

namespace clackers::c_api {

void require_pointer(std::string_view who, std::string_view name, const void* pointer) {
  if (pointer == nullptr) refuse(who, name, "NULL", "a valid pointer", {}, "null-pointer");
}

model::Side read_side(std::string_view who, clackers_side side) {
  if (side != CLACKERS_LEFT && side != CLACKERS_RIGHT)
    refuse(who, "side", double(side), "0 (CLACKERS_LEFT) or 1 (CLACKERS_RIGHT)");
  return side == CLACKERS_LEFT ? model::Side::left : model::Side::right;
}

model::SampleBuffers read_buffers(std::string_view who, std::string_view name,
                                  const clackers_buffers* buffers, std::size_t count, int dof) {
  require_pointer(who, name, buffers);
  const auto given = read_versioned(who, *buffers);
  const auto masses = static_cast<std::size_t>(dof);
  if (count > given.capacity / masses)
    refuse(who, fmt::format("{}->capacity", name), fmt::to_string(given.capacity),
           fmt::format("at least {} x {}, the number of times and of masses", count, masses), {},
           "wrong-size");
  const auto size = count * masses;
  if (size > 0) {
    require_pointer(who, fmt::format("{}->u", name), given.u);
    require_pointer(who, fmt::format("{}->v", name), given.v);
  }
  return {{given.u, size}, {given.v, size}, {given.a, given.a == nullptr ? 0 : size}};
}

void write_state(const model::Kinematics& state, const model::SampleBuffers& out) {
  std::copy(state.u.begin(), state.u.end(), out.u.begin());
  std::copy(state.v.begin(), state.v.end(), out.v.begin());
  if (!out.a.empty()) std::copy(state.a.begin(), state.a.end(), out.a.begin());
}

}  // namespace clackers::c_api
