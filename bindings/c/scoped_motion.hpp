#pragma once

#include <initializer_list>
#include <memory>
#include <vector>

#include "bindings/c/clackers.h"

namespace clackers::c_api {

struct Destroy {
  void operator()(clackers_motion* motion) const { clackers_motion_destroy(motion); }
};
/// A motion that the tests need not end by hand.
using ScopedMotion = std::unique_ptr<clackers_motion, Destroy>;

/// A named case, or null with the error of this thread.
inline ScopedMotion make_case(const char* name, std::vector<clackers_setting> settings = {}) {
  clackers_motion* motion = nullptr;
  clackers_case_create(name, settings.data(), settings.size(), &motion);
  return ScopedMotion(motion);
}

/// Arrays of `size` doubles, filled with 7, and the structure that names them.
struct Arrays {
  explicit Arrays(std::size_t size) : u(size, 7.0), v(size, 7.0), a(size, 7.0) {
    out = {sizeof(clackers_buffers), size, u.data(), v.data(), a.data()};
  }
  std::vector<double> u, v, a;
  clackers_buffers out;
};

}  // namespace clackers::c_api
