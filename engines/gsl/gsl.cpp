// GNU Scientific Library: rkf45, rk8pd or msadams; it has no roots, so an impact is bisected by steps from
// the state before.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "../flights.hpp"

int derivative(double, const double* y, double* out, void* door) {
  static_cast<Flights*>(door)->derivative(y, out);
  return GSL_SUCCESS;
}

int main(int count, char** words) {
  Flights door(count, words);
  gsl_odeiv2_system system{derivative, nullptr, door.size(), &door};
  const auto* method =
      door.settings["method"] == "rk8pd" ? gsl_odeiv2_step_rk8pd : gsl_odeiv2_step_rkf45;
  const double tolerance = door.tolerance();
  const auto advance = [&](double from, double to, const Row& y) {
    auto* driver = gsl_odeiv2_driver_alloc_y_new(&system, method, 1e-3, tolerance, tolerance);
    Row now = y;
    if (from < to && gsl_odeiv2_driver_apply(driver, &from, to, now.data()) != GSL_SUCCESS)
      std::exit(1);
    gsl_odeiv2_driver_free(driver);
    return now;
  };
  auto y = door.first();
  double t = door.start;
  for (long k = 0; k <= door.rows; ++k) {
    for (auto now = advance(t, door.at(k), y);; now = advance(t, door.at(k), y)) {
      if (!door.closed(now.data())) {
        t = door.at(k), y = now;
        break;
      }
      double low = t, high = door.at(k);
      for (double middle; low < (middle = low + (high - low) / 2) && middle < high;)
        (door.closed(advance(t, middle, y).data()) ? high : low) = middle;
      y = advance(t, high, y), t = high;
      door.impact(door.closed(y.data()), t, y.data());
    }
    door.write(t, y.data());
  }
  return door.close();
}
