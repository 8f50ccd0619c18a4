// Figures A.1 and A.2: no contact away from equilibrium.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "clackers/cases/case.hpp"
#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {
namespace {

constexpr double quarter = std::numbers::pi / 2.0;

// D'(t) = cos(t) + 3/X cos(X t) for X = 4N + 1, in the angle s from the impact, where it is
// sin(s) + 3/X sin(X s): the cosines would cancel. pi/2 is `quarter` plus 6.1e-17.
double relative_gap(double X, double t) {
  const double s = (quarter - std::abs(t)) + 6.123233995736766e-17;
  return std::sin(s) + 3.0 / X * std::sin(X * s);
}

struct Minimum {
  double value = 1.0, x = 0.0;
};

// The least D'(t)/cos(t) over (-pi/2, pi/2). With x = X (pi/2 - |t|) and X = 4N + 1 it is
// 1 + 3 sin(x)/(X sin(x/X)); beyond x = 60 it is above 1 - 3 pi/(2 * 60) > 0.9.
Minimum least_relative(double X) {
  Minimum out;
  const double last = std::min(X * quarter, 60.0);
  for (double j = 1.0; j * 1e-3 <= last; ++j) {
    const double x = j * 1e-3, value = 1.0 + 3.0 * std::sin(x) / (X * std::sin(x / X));
    if (value < out.value) out = {value, x};
  }
  return out;
}

// The curvature of the ratio is below r = 3 times (1 + small): a scan by 1e-3 is at most 3/2 (5e-4)^2
// above the minimum; 1e-6 is more than rounding adds.
constexpr double scan_error = 1e-6;

Claim positive(int N) {
  const double X = 4.0 * N + 1.0;
  const auto found = least_relative(X);
  const double proved = cases::admissibility(X, 3.0).margin;
  return {
      fmt::format("Appendix A: D' is positive in −π/2 < t̄ < π/2 for N = {}.", N),
      fmt::format(
          "D'/cos t̄ is least, {:.6f}, at X(π/2 − |t̄|) = {:.3f}; the proof gives 1 − 3/r* = {:.6f}.",
          found.value, found.x, proved),
      found.value > 0.0 && std::abs(found.value - proved) <= scan_error};
}

// Smallest (u1 - u2)/u1 where u1 is not at equilibrium, from drawn points.
double nearest(const cases::Case& test_case) {
  const auto two = curve(test_case, 2, Quantity::displacement, 200);
  double least = 2.0;
  const auto& motion = *test_case.motion;
  for (std::size_t i = 0; i < two.x.size(); ++i) {
    const double u1 = motion.at(two.x[i], model::Side::right).u[0];
    // Beside an impact both vanish; 1e-6 of the amplitude is far inside the last tenth of a turn.
    if (u1 > 1e-6 * motion.envelope(two.x[i]).u[0]) least = std::min(least, (u1 - two.y[i]) / u1);
  }
  return least;
}

}  // namespace

Figure positive_definite() {
  constexpr std::array Ns{1, 2, 5, 20, 100, 100'000};
  constexpr std::array letters{"a", "b", "c", "d", "e", "f"};
  Figure figure;
  figure.columns = 3;
  figure.width = 250.0;
  figure.height = 150.0;
  figure.caption =
      "D'(t̄) = cos t̄ + 3/(4N + 1) cos((4N + 1) t̄), Eq. (A.13): the gap of the masses without its exponential factor, for r = 3.";
  for (std::size_t i = 0; i < Ns.size(); ++i) {
    const double X = 4.0 * Ns[i] + 1.0;
    Series line{"D'", {}, {}, first_mass()};
    constexpr int points = 2000;
    for (int j = 0; j <= points; ++j) {
      const double t = quarter * (2.0 * j / points - 1.0);
      line.x.push_back(t);
      line.y.push_back(relative_gap(X, t));
    }
    Panel panel{letters[i],
                Ns[i] < 1000 ? fmt::format("N = {}", Ns[i]) : "N = 10⁵",
                {.title = "t̄ [rad]", .lowest = -quarter, .highest = quarter},
                {.title = "D'", .lowest = 0.0, .highest = 1.8},
                {line}};
    figure.panels.push_back(panel);
    figure.claims.push_back(positive(Ns[i]));
  }
  return figure;
}

Figure amplitudes() {
  constexpr std::array Ns{1, 2, 5};
  Figure figure;
  figure.columns = 2;
  figure.width = 330.0;
  figure.height = 140.0;
  figure.caption =
      "Displacements for ξ1 = 0.1 and N = 1, 2, 5: (a) −u2(0) = 3 u1(0)/(4N + 1), Eq. (A.4), (b) −u2(0) = 1.5 u1(0)/(4N + 1), Eq. (A.18).";
  for (const int N : Ns) {
    double margin[2], measured[2];
    for (int column = 0; column < 2; ++column) {
      const double X = 4.0 * N + 1.0, r = column == 0 ? 3.0 : 1.5;
      const auto test_case =
          cases::make("synchronized-pair", {{"X", X}, {"r", r}, {"xi1", 0.1}, {"t_end", 10.0}});
      figure.panels.push_back(
          response_panel(test_case, Quantity::displacement, column == 0 ? "a" : "b",
                         fmt::format("N = {}, −u2(0) = {}/{}", N, r, X), {-0.6, 1.0}));
      margin[column] = cases::admissibility(X, r).margin;
      measured[column] = nearest(test_case);
    }
    // 200 points in each half turn: the minimum is missed by at most 3/2 (pi/400)^2 = 9e-5.
    constexpr double missed = 1e-4;
    figure.claims.push_back(
        {fmt::format("Appendix A: a smaller −u2(0) is conservative (N = {}).", N),
         fmt::format(
             "Between impacts (u1 − u2)/u1 is at least {:.4f} for 3 and {:.4f} for 1.5; 1 − r/r* is {:.4f} and {:.4f}.",
             measured[0], measured[1], margin[0], margin[1]),
         measured[1] > measured[0] && std::abs(measured[0] - margin[0]) < missed &&
             std::abs(measured[1] - margin[1]) < missed});
  }
  figure.choices = {"The duration does not stand in the text; 10 s show three impacts."};
  return figure;
}

}  // namespace clackers::paper
