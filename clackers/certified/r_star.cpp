#ifdef CLACKERS_HAS_ARB

#include "clackers/certified/r_star.hpp"

namespace clackers::certified {
namespace {

Ball stationary(const Ball& X, const Ball& x) {
  const Ball theta = x / X;
  return X * sin(theta) * cos(x) - sin(x) * cos(theta);
}

Ball slope_of_stationary(const Ball& X, const Ball& x) {
  return -((X - Ball(1.0) / X) * sin(x / X) * sin(x));
}

Ball middle_of(const Ball& x) {
  Ball m;
  arb_get_mid_arb(m.get(), x.get());
  return m;
}

}  // namespace

Ball graze_angle(double X_odd, long bits) {
  for (long working = bits + 64;; working *= 2) {
    const WorkingBits scope(working);
    const Ball X = X_odd;
    // Newton from a point in the middle of where the zeros of all X lie, without any proof.
    Ball x = 4.5;
    for (long known = 1; known < 2 * working; known *= 2)
      x = middle_of(x - stationary(X, x) / slope_of_stationary(X, x));
    // The proof: h is rising and changes its sign within this distance, all within (pi, 3 pi/2).
    const Ball reach = scaled(Ball(1.0), -(bits + 8));
    const Ball low = x - reach, high = x + reach;
    if (pi() < low && high < Ball(1.5) * pi() && stationary(X, low).is_negative() &&
        stationary(X, high).is_positive()) {
      arb_add_error_2exp_si(x.get(), -(bits + 8));
      return x;
    }
  }
}

Ball r_star(double X_odd, long bits) {
  if (X_odd == 3.0) return 3.0;
  // r* changes less than x does, relative to itself (the minimum is flat), and sin and sqrt lose a
  // few bits.
  const Ball x = graze_angle(X_odd, bits + 16);
  const WorkingBits scope(bits + 96);
  const Ball X = X_odd, sine = sin(x / X);
  return sqrt(Ball(1.0) + (X * X - 1.0) * sine * sine);
}

}  // namespace clackers::certified

#endif
