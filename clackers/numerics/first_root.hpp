#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::numerics {

/// What is known of a function f ahead of a point, for x in [0, reach]:
///
///     f(x) >= value + slope x + second x^2/2 - third x^3/6
///     f(x) >= value + slope x - curvature x^2/2
///
/// and where it is `whole`, value, slope and second are those of f itself, |f'''| <= third.
struct LocalBound {
  double value = 0.0, slope = 0.0, second = 0.0;
  double curvature = 0.0, third = 0.0;
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

/// Where the next zero is: not before lo, and where hi is finite, not after it.
struct NextZero {
  double lo = 0.0, hi = std::numeric_limits<double>::infinity();
};

/// Of a function with value >= 0. On [0, X] the cubic is not below the parabola with second
/// derivative second - third X/3, whose zero is T(X); T decreases, and the zero x of the cubic is
/// T(x). So min(X, T(X)) is not beyond x for any X.
inline NextZero next_zero(const LocalBound& f) {
  const auto below = [&](double x) {
    return first_zero(f.value, f.slope, f.second - f.third * x / 3.0);
  };
  NextZero zero{first_zero(f.value, f.slope, -f.curvature)};
  const double parabola = below(0.0);
  if (std::isfinite(parabola)) {
    const double next = below(parabola);
    zero.lo = std::max(zero.lo, next);
    if (next < 0.9 * parabola) {
      const double middle = std::sqrt(parabola * next);
      zero.lo = std::max(zero.lo, std::min(middle, below(middle)));
    } else if (f.whole) {
      const double beyond = 1.5 * parabola;
      const double above = first_zero(f.value, f.slope, f.second + f.third * beyond / 3.0);
      if (above <= std::min(beyond, f.reach)) zero.hi = above;
    }
  } else {
    for (double x = 2.0 * zero.lo; x > zero.lo && x < f.reach; x *= 4.0) {
      const double next = below(x);
      zero.lo = std::max(zero.lo, std::min(x, next));
      if (next < x) break;
    }
  }
  zero.lo = std::min(zero.lo, f.reach);
  return zero;
}

/// The first s in (from, until] where f turns from positive to negative; f(from) >= 0 give or take
/// a rounding. No sampling: s moves to a point before which its bounds exclude a zero, again and
/// again; near a crossing these are steps of third order from the safe side, and the root is found
/// when its bounds meet. Steps are never shorter than `shortest`, so a dip below 0 of less than
/// curvature shortest^2 / 8 may remain unnoticed. `f(s)` returns a LocalBound, whose value is
/// negative only where f is. Undecided after `most_steps` steps, or where f is not finite.
template <class Function>
FirstRoot first_root(Function&& f, double from, double until, double shortest, int most_steps) {
  using enum FirstRoot::Status;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double s = from;
  LocalBound now = f(s);
  now.value = std::max(now.value, 0.0);
  for (int step = 0; step < most_steps; ++step) {
    if (!std::isfinite(now.value) || !std::isfinite(now.slope)) return {undecided};
    if (s >= until) return {none};
    const auto zero = next_zero(now);
    double root = s + zero.lo;
    if (!(zero.hi - zero.lo <= epsilon * root)) {
      const double next = s + std::max(zero.lo, shortest);
      const LocalBound ahead = f(next);
      if (!(ahead.value < 0.0)) {
        s = next;
        now = ahead;
        continue;
      }
      // A step this short is straight; a longer one ends at the root, give or take a rounding.
      root = s + (next - s) * (now.value / (now.value - ahead.value));
    }
    return root > until ? FirstRoot{none} : FirstRoot{found, root};
  }
  return {undecided};
}

}  // namespace clackers::numerics
