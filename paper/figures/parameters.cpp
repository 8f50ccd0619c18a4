// Figures 7 to 10: the effect of N, damping and duration; ten members of the class.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {
namespace {

constexpr std::array panel_letters{"a", "b", "c"};
constexpr std::array Ns{2, 5, 20};

struct Member {
  const char* label;
  int N;
  double xi1, a_t;
};

// (a) to (h) stand in the caption. (i) and (j) are garbled there; see the figure's choices.
constexpr auto members = std::to_array<Member>({{"a", 0, 0.05, 4.0},
                                                {"b", 0, 0.05, 1.0},
                                                {"c", 0, 0.10, 1.0},
                                                {"d", 1, 0.10, 1.0},
                                                {"e", 1, 0.15, 1.0},
                                                {"f", 1, 0.15, 1.2},
                                                {"g", 2, 0.15, 1.2},
                                                {"h", 2, 0.25, 1.2},
                                                {"i", 2, 0.25, 0.5},
                                                {"j", 5, 0.25, 1.0}});

}  // namespace

Figure effect_of_N() {
  Figure figure;
  figure.width = 640.0;
  figure.height = 150.0;
  figure.caption =
      "Exact displacements of the one-parameter system, Eq. (19): ξ1 = 0.05, m2 = 1/3 kg, 0 ≤ t < 20 s.";
  for (std::size_t i = 0; i < Ns.size(); ++i) {
    const auto test_case = cases::make("one-parameter", {{"N", double(Ns[i])}});
    figure.panels.push_back(response_panel(test_case, Quantity::displacement, panel_letters[i],
                                           fmt::format("N = {}", Ns[i]), {-0.4, 1.0}));
  }
  return figure;
}

Figure effect_of_damping() {
  constexpr std::array damping{0.05, 0.10, 0.15};
  Figure figure;
  figure.columns = 3;
  figure.width = 270.0;
  figure.height = 150.0;
  figure.caption =
      "Exact displacements of the two-parameter system, Eq. (21), rows (a) N = 2, (b) N = 5, (c) N = 20, columns ξ1 = 0.05, 0.10, 0.15; 0 ≤ t < 20 s.";
  for (std::size_t i = 0; i < Ns.size(); ++i)
    for (const double xi1 : damping) {
      const auto test_case = cases::make("two-parameter", {{"N", double(Ns[i])}, {"xi1", xi1}});
      figure.panels.push_back(response_panel(
          test_case, Quantity::displacement, xi1 == damping[0] ? panel_letters[i] : "",
          fmt::format("N = {}, ξ1 = {:.2f}", Ns[i], xi1), {-0.4, 1.0}));
    }
  figure.choices = {
      "The values of ξ1 do not stand in the text of Fig. 8. Taken: 0.05 (Fig. 7), 0.10 (named for Fig. 8(b) by the caption of Fig. 9) and 0.15 (used in Fig. 10)."};
  return figure;
}

Figure effect_of_duration() {
  constexpr std::array factors{2.0, 5.0, 20.0};
  Figure figure;
  figure.width = 640.0;
  figure.height = 150.0;
  figure.caption =
      "Exact displacements of the three-parameter system for N = 5, ξ1 = 0.10 over 20 a_t seconds.";
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto test_case =
        cases::make("three-parameter", {{"N", 5.0}, {"xi1", 0.10}, {"a_t", factors[i]}});
    figure.panels.push_back(response_panel(test_case, Quantity::displacement, panel_letters[i],
                                           fmt::format("a_t = {}", factors[i]), {-0.2, 1.0}));
  }
  return figure;
}

Figure three_parameters() {
  Figure figure;
  figure.columns = 2;
  figure.width = 330.0;
  figure.height = 130.0;
  figure.caption =
      "Exact displacements of ten members of the three-parameter class, Eq. (25)-(26): m1 = k1 = 1, m2 = 1/3 kg, 0 ≤ t < 20 a_t.";
  for (const auto& [label, N, xi1, a_t] : members)
    figure.panels.push_back(response_panel(
        cases::make("three-parameter", {{"N", double(N)}, {"xi1", xi1}, {"a_t", a_t}}),
        Quantity::displacement, label, fmt::format("N = {}, ξ1 = {:.2f}, a_t = {}", N, xi1, a_t),
        N == 0 ? std::vector{-3.0, 1.0} : std::vector{-0.6, 1.0}));
  figure.choices = {
      "The caption is garbled from (i) on: it repeats the line of (h). The text says that (g) to (i) have N = 2, that (i) differs from (h) in one parameter, and that (j) has N = 5 and differs from (i) in N and a_t. So ξ1 = 0.25 for (i) and (j), and a_t is free. Taken: a_t = 0.5 for (i) and 1 for (j), where the motion is still to be seen: exp(−0.25·24) = 0.0025 is left of it at the end of (h).",
      "For N = 0, Eq. (25) has m2 = 1/3 kg and u2(0) = −3 m; this is not the system (7)."};
  return figure;
}

}  // namespace clackers::paper
