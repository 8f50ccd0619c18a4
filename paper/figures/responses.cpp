// Figures 1, 3, 4 and 5: displacement and velocity of one motion each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/study/verify.hpp"
#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {
namespace {

Figure displacement_and_velocity(const cases::Case& test_case) {
  Figure figure;
  for (const auto quantity : {Quantity::displacement, Quantity::velocity})
    figure.panels.push_back(response_panel(test_case, quantity, "", ""));
  return figure;
}

}  // namespace

Figure free_mass() {
  const auto test_case = cases::make("sdof");
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "Exact displacement and velocity of ü + 0.1 u̇ + u = 0, u(0) = 1 m, u̇(0) = −0.05 m/s, 0 ≤ t < 20 s.";
  return figure;
}

Figure response_at_stop() {
  const auto test_case = cases::make("stop");
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "Exact displacement and velocity of the mass of Fig. 1 with a rigid stop at its equilibrium, restitution η = 1. At each impact the velocity jumps; both limits are drawn.";
  return figure;
}

Figure symmetric_pair() {
  const auto test_case = cases::make("symmetric-pair");
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "Exact displacements and velocities of two equal masses with opposite starts, Eq. (7): ξ1 = 0.05, η = 1, 0 ≤ t < 20 s.";
  return figure;
}

Figure sample_extension() {
  const auto test_case = cases::make("one-parameter", {{"N", 1.0}});
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "The second mass five times as fast as the first (N = 1, Eq. 19: m2 = 1/3 kg, u2(0) = −0.6 m, ξ1 = 0.05): the masses still meet only at their common equilibrium.";
  return figure;
}

}  // namespace clackers::paper
