// What the programs of SUNDIALS share: y' and the gaps, from `door`, the user data.
#pragma once

#include <nvector/nvector_serial.h>

#include "flights.hpp"

inline int derivative(realtype, N_Vector y, N_Vector out, void* door) {
  static_cast<Flights*>(door)->derivative(N_VGetArrayPointer(y), N_VGetArrayPointer(out));
  return 0;
}
inline int gaps(realtype, N_Vector y, realtype* out, void* data) {
  auto& door = *static_cast<Flights*>(data);
  for (std::size_t k = 1; k <= door.contacts; ++k) out[k - 1] = door.gap(k, N_VGetArrayPointer(y));
  return 0;
}
