#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "bindings/c/clackers.h"
#include "clackers/base/error.hpp"

namespace clackers::c_api {

/// The size of a structure in the first header that had it. Members are only ever appended, so it
/// names the last member of that header for good.
template <class Struct>
inline constexpr std::size_t first_size = 0;
template <>
inline constexpr std::size_t first_size<clackers_pair> = offsetof(clackers_pair, t_end) +
                                                         sizeof(double);
template <>
inline constexpr std::size_t first_size<clackers_buffers> = offsetof(clackers_buffers, a) +
                                                            sizeof(double*);
template <>
inline constexpr std::size_t first_size<clackers_impact> = offsetof(clackers_impact, energy_after) +
                                                           sizeof(double);
template <>
inline constexpr std::size_t first_size<clackers_constant> = offsetof(clackers_constant, value) +
                                                             sizeof(double);

/// No structure will ever be longer; a larger struct_size was never set.
inline constexpr std::size_t longest_struct = 4096;

/// Throws InputError unless struct_size can be the size of some version of the structure.
template <class Struct>
void require_size(std::string_view who, const Struct& given) {
  if (given.struct_size < first_size<Struct> || given.struct_size > longest_struct)
    refuse(who, "struct_size", fmt::to_string(given.struct_size),
           fmt::format("sizeof the structure, {} in this version", sizeof(Struct)),
           "Set it before the call.", "wrong-struct-size");
}

/// The caller's structure in the layout of this version; members it does not have are zero. Throws
/// InputError if it has members beyond this version that are not zero.
template <class Struct>
Struct read_versioned(std::string_view who, const Struct& given) {
  require_size(who, given);
  const auto* bytes = reinterpret_cast<const unsigned char*>(&given);
  const auto known = std::min(given.struct_size, sizeof(Struct));
  if (std::any_of(bytes + known, bytes + given.struct_size, [](unsigned char b) { return b != 0; }))
    refuse(who, "struct_size", fmt::to_string(given.struct_size),
           fmt::format("{}, unless every member beyond is zero", sizeof(Struct)),
           "The caller was compiled with a newer clackers.h and uses what this library does not "
           "know; install the library of that version.",
           "wrong-struct-size");
  Struct read{};
  std::memcpy(&read, bytes, known);
  return read;
}

/// Writes `value` as far as the caller's structure reaches, and zeros where it reaches further;
/// struct_size stays. Call require_size() first.
template <class Struct>
void write_versioned(Struct& out, Struct value) {
  value.struct_size = out.struct_size;
  auto* bytes = reinterpret_cast<unsigned char*>(&out);
  const auto known = std::min(value.struct_size, sizeof(Struct));
  std::memcpy(bytes, &value, known);
  std::memset(bytes + known, 0, value.struct_size - known);
}

}  // namespace clackers::c_api
