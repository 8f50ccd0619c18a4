#pragma once

#include <algorithm>
#include <cmath>

namespace clackers::numerics {

/// An interval at whose ends a function has opposite signs: f(a) >= 0 > f(b), a < b.
struct Bracket {
  double a = 0.0, fa = 0.0;
  double b = 0.0, fb = 0.0;

  double width() const { return b - a; }
};

/// Shrinks a bracket until it is no wider than `width` > 0, or until no double lies between its
/// ends. Only signs decide, so a function that is noise near its root still gives a bracket of the
/// signs it showed. Takes at most two evaluations more than bisection (n0, and one for the
/// rounding of the ends), few for a smooth function.
/// Method ITP: I. F. D. Oliveira, R. H. C. Takahashi, ACM Trans. Math. Softw. 47 (1), 5 (2020),
/// with k1 = 0.2 / (first width), k2 = 2, n0 = 1.
Bracket shrink(auto&& f, Bracket k, double width) {
  const double epsilon = 0.5 * width, k1 = 0.2 / k.width();
  // Half of the width that bisection would have left, n0 = 1 step ago: no step may do worse.
  double allowance =
      2.0 * epsilon * std::exp2(std::max(0.0, std::ceil(std::log2(k.width() / width))));
  while (k.width() > width) {
    const double middle = k.a + 0.5 * k.width();
    if (!(middle > k.a && middle < k.b)) break;
    const double radius = std::max(0.0, allowance - 0.5 * k.width());
    const double secant = (k.fb * k.a - k.fa * k.b) / (k.fb - k.fa);
    // Truncation: a little towards the middle, so that both ends of the bracket move.
    const double delta = k1 * k.width() * k.width();
    const double side = middle >= secant ? 1.0 : -1.0;
    double x = std::abs(middle - secant) >= delta ? secant + side * delta : middle;
    // Projection onto what bisection would still allow; also catches a secant that is no number.
    if (!(std::abs(x - middle) <= radius)) x = middle - side * radius;
    if (!(x > k.a && x < k.b)) x = middle;
    const double fx = f(x);
    if (fx >= 0.0) {
      k.a = x;
      k.fa = fx;
    } else {
      k.b = x;
      k.fb = fx;
    }
    allowance *= 0.5;
  }
  return k;
}

}  // namespace clackers::numerics
