#include <string>
#include <vector>

#include "bindings/c/guard.hpp"
#include "bindings/c/handle.hpp"
#include "bindings/c/versioned.hpp"
#include "clackers/base/check.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::c_api {
namespace {

std::size_t count_of(const cases::Case& test_case) {
  return test_case.constants.size() + test_case.indicators.size();
}

// Constants come first, then indicators.
const Quantity& constant_of(const cases::Case& test_case, std::size_t index) {
  const auto derived = test_case.constants.size();
  return index < derived ? test_case.constants[index] : test_case.indicators[index - derived];
}

const Quantity& constant_of(const cases::Case& test_case, std::string_view name) {
  if (name == "collisions") name = "impacts";  // its former name
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count_of(test_case); ++i) {
    const auto& constant = constant_of(test_case, i);
    if (constant.name == name) return constant;
    names.push_back(constant.name);
  }
  refuse_name(fmt::format("constant of {}", test_case.entry->name), name, names,
              fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace
}  // namespace clackers::c_api

using namespace clackers;
using namespace clackers::c_api;

clackers_status clackers_motion_constant_count(const clackers_motion* motion, size_t* count) {
  return guarded([&] {
    const auto& test_case = case_of("clackers_motion_constant_count", motion);
    require_pointer("clackers_motion_constant_count", "count", count);
    *count = count_of(test_case);
  });
}

clackers_status clackers_motion_constant_at(const clackers_motion* motion, size_t index,
                                            clackers_constant* constant) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_constant_at";
    const auto& test_case = case_of(who, motion);
    require_pointer(who, "constant", constant);
    require_size(who, *constant);
    const auto count = count_of(test_case);
    if (index >= count)
      refuse(who, "index", fmt::to_string(index), fmt::format("0 <= index < {}", count));
    const auto& found = constant_of(test_case, index);
    write_versioned(*constant, {.struct_size = 0,  // the caller's stays
                                .name = found.name.c_str(),
                                .unit = found.unit.c_str(),
                                .meaning = found.meaning.c_str(),
                                .value = found.value});
  });
}

clackers_status clackers_motion_constant(const clackers_motion* motion, const char* name,
                                         double* value) {
  return guarded([&] {
    constexpr auto who = "clackers_motion_constant";
    const auto& test_case = case_of(who, motion);
    require_pointer(who, "name", name);
    require_pointer(who, "value", value);
    *value = constant_of(test_case, name).value;
  });
}

clackers_status clackers_admissibility(double X, double r, double* r_star, double* margin) {
  return guarded([&] {
    require_pointer("clackers_admissibility", "r_star", r_star);
    require_pointer("clackers_admissibility", "margin", margin);
    const auto found = cases::admissibility(X, r);
    *r_star = found.r_star;
    *margin = found.margin;
  });
}
