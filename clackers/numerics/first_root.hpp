#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::numerics {

/// What is known of a function f ahead of a point, for x in [0, reach]:
///
///     f(x) >= value + slope x + second x^2/2 - third_bound x^3/6
///     f(x) >= value + slope x - curvature x^2/2
///
/// and where it is `whole`, value, slope, second and third are those of f itself, |f'''| <=
/// third_bound.
struct LocalBound {
  double value = 0.0, slope = 0.0, second = 0.0, third = 0.0;
  double curvature = 0.0, third_bound = 0.0;
  double reach = std::numeric_limits<double>::infinity();
  bool whole = true;
};

struct FirstRoot {
  enum class Status { found, none, undecided };
  Status status = Status::none;
  double s = 0.0;  ///< of the root, where one was found
};

/// The first x >= 0 where c0 + c1 x + c2 x^2/2 is 0, for c0 >= 0; infinite where there is none.
inline double first_zero(double c0, double c1, double c2) {
  const double square = c1 * c1 - 2.0 * c0 * c2;
  if (c2 >= 0.0) {
    if (!(c1 < 0.0 && square >= 0.0)) return std::numeric_limits<double>::infinity();
    return 2.0 * c0 / (std::sqrt(square) - c1);
  }
  // Both forms of the zero; neither subtracts.
  const double root = std::sqrt(square);
  return c1 > 0.0 ? (c1 + root) / -c2 : root > 0.0 ? 2.0 * c0 / (root - c1) : 0.0;
}

/// Where the next zero is: not before lo, and where hi is finite, before hi, with a negative slope on
/// the whole way.
struct NextZero {
  double lo = 0.0, hi = std::numeric_limits<double>::infinity();
};

/// Of a function with value >= 0. With the cubic c and the parabola p (c without its third
/// derivative) of LocalBound, and x0 the first zero of p: c is concave, or falls, on [0, x0], so it is
/// nowhere negative up to a point where it is not; that point is x0 less two terms of the inverse
/// series of c and a little more. Where c differs too much from p: on [0, X] it is not below the
/// parabola with second derivative second - third_bound X/3, whose zero is T(X); T decreases, and the
/// zero x of c is T(x), so min(X, T(X)) is not beyond x for any X.
inline NextZero next_zero(const LocalBound& f) {
  const double v = f.value, slope = f.slope, second = f.second, b = f.third_bound;
  const auto below = [&](double x) { return first_zero(v, slope, second - b * x / 3.0); };
  NextZero zero;
  const double parabola = first_zero(v, slope, second);
  if (std::isfinite(parabola)) {
    const double fall = -(slope + second * parabola) + 0.5 * b * parabola * parabola;
    const double over = 1.0 / fall;
    const double first = b * parabola * parabola * parabola / 6.0 * over;
    const double near = parabola - first - 0.7 * (b * parabola - second) * over * first * first;
    if (near > 0.0 && near <= parabola &&
        v + near * (slope + near * (second / 2.0 - near * b / 6.0)) >= 0.0) {
      zero.lo = near;
    } else {
      zero.lo = below(parabola);
      const double middle = std::sqrt(parabola * zero.lo);
      zero.lo = std::max(zero.lo, std::min(middle, below(middle)));
    }
    if (f.whole && slope < 0.0 && zero.lo > 0.8 * parabola) {
      const double x = std::min(1.5 * parabola, f.reach);
      const bool is_above = v + x * (slope + x * (second / 2.0 + x * b / 6.0)) > 0.0;
      if (!is_above && slope + x * (second + x * b / 2.0) < 0.0) zero.hi = x;
    }
  } else {
    zero.lo = first_zero(v, slope, -f.curvature);
    for (double x = 2.0 * zero.lo; x > zero.lo && x < f.reach; x *= 4.0) {
      const double next = below(x);
      zero.lo = std::max(zero.lo, std::min(x, next));
      if (next < x) break;
    }
  }
  zero.lo = std::min(zero.lo, f.reach);
  return zero;
}

/// The root between s + zero.lo and s + zero.hi, of a function that falls there, by the zeros of its
/// Taylor polynomials of third degree. Not a number where they leave that interval.
double falling_root(auto&& f, double s, LocalBound now, const NextZero& zero) {
  const double from = s + zero.lo * (1.0 - 1e-12), to = s + zero.hi;
  for (int step = 0; step < 8; ++step) {
    // Newton's step for the polynomial from the zero of its parabola.
    const double square = now.slope * now.slope - 2.0 * now.value * now.second;
    double x = 2.0 * now.value / (std::sqrt(square) - now.slope);
    x -= now.third * x * x * x / 6.0 / (now.slope + x * (now.second + x * now.third / 2.0));
    const double root = s + x;
    if (!(root >= from && root <= to)) break;
    // The term of fourth degree, whose derivative is about the bound of the third times that over
    // the bound of the second.
    const double b = now.third_bound, allowed = 0.25 * std::numeric_limits<double>::epsilon();
    if (b * b * x * x * x * x <= 24.0 * now.curvature * -now.slope * allowed * root) return root;
    s = root;
    now = f(s);
    if (!now.whole || !(now.slope < 0.0)) break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// The first s in (from, until] where f turns from positive to negative; f(from) >= 0 give or take
/// a rounding. No sampling: s moves to a point before which its bounds exclude a zero, again and
/// again, with third order near a crossing, until they show that f falls through 0. Steps are never
/// shorter than `shortest`, so a dip below 0 of less than curvature shortest^2 / 8 may remain
/// unnoticed. `f(s)` returns a LocalBound, whose value is negative only where f is. Undecided after
/// `most_steps` steps, or where f is not finite.
FirstRoot first_root(auto&& f, double from, double until, double shortest, int most_steps) {
  using enum FirstRoot::Status;
  double s = from;
  LocalBound now = f(s);
  now.value = std::max(now.value, 0.0);
  for (int step = 0; step < most_steps; ++step) {
    if (!std::isfinite(now.value) || !std::isfinite(now.slope)) return {undecided};
    const auto zero = next_zero(now);
    if (s >= until || s + zero.lo > until) return {none};
    if (std::isfinite(zero.hi)) {
      const double root = falling_root(f, s, now, zero);
      if (root > until) return {none};
      if (root > s) return {found, root};
    }
    const double next = s + std::max(zero.lo, shortest);
    const LocalBound ahead = f(next);
    if (ahead.value < 0.0) {
      // A step this short is straight; a longer one ends at the root, give or take a rounding.
      const bool is_straight = zero.lo < shortest && (now.value > 0.0 || s > from);
      const double root =
          is_straight ? s + (next - s) * (now.value / (now.value - ahead.value)) : next;
      return root > until ? FirstRoot{none} : FirstRoot{found, root};
    }
    s = next;
    now = ahead;
  }
  return {undecided};
}

}  // namespace clackers::numerics
