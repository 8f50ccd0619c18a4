#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

namespace clackers::python {

/// Looks for Ctrl-C during long work that has released the GIL: every 50 ms it takes the GIL for a
/// moment. Throws what the signal's handler raised, KeyboardInterrupt by default.
class Interrupts {
 public:
  void check() {
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(50)) return;
    last_ = now;
    const pybind11::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace clackers::python
