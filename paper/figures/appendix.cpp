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
      "Displacements for ξ1 = 0.1, rows N = 1, 2, 5, columns (a) −u2(0) = 3 u1(0)/(4N + 1), Eq. (A.4), (b) −u2(0) = 1.5 u1(0)/(4N + 1), Eq. (A.18).";
  for (const int N : Ns) {
    for (int column = 0; column < 2; ++column) {
      const double X = 4.0 * N + 1.0, r = column == 0 ? 3.0 : 1.5;
      const auto test_case =
          cases::make("synchronized-pair", {{"X", X}, {"r", r}, {"xi1", 0.1}, {"t_end", 10.0}});
      figure.panels.push_back(response_panel(test_case, Quantity::displacement,
                                             N > Ns[0]     ? ""
                                             : column == 0 ? "a"
                                                           : "b",
                                             fmt::format("N = {}, −u2(0) = {}/{}", N, r, X),
                                             {-0.6, 1.0}));
    }
  }
  figure.choices = {"The duration does not stand in the text; 10 s show three impacts."};
  return figure;
}

}  // namespace clackers::paper
