// Figures 7, 8 and 9: what N, damping and duration do.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "clackers/paper/catalogue.hpp"
#include "clackers/paper/curves.hpp"

namespace clackers::paper {
namespace {

// Values with their common unit, "a, b, c unit", and whether each is larger than the one before.
struct Sequence {
  std::vector<double> values;
  const char* unit = "";

  std::string words() const {
    std::string out;
    for (const double value : values)
      out += fmt::format("{}{:.4g}", out.empty() ? "" : ", ", value);
    return *unit == '\0' ? out : out + " " + unit;
  }
  bool rising() const {
    for (std::size_t i = 1; i < values.size(); ++i)
      if (!(values[i] > values[i - 1])) return false;
    return true;
  }
  bool falling() const {
    for (std::size_t i = 1; i < values.size(); ++i)
      if (!(values[i] < values[i - 1])) return false;
    return true;
  }
};

constexpr std::array letters{"a", "b", "c"};
constexpr std::array Ns{2, 5, 20};

}  // namespace

Figure effect_of_N() {
  Figure figure;
  figure.width = 640.0;
  figure.height = 150.0;
  figure.caption =
      "Exact displacements of the one-parameter system, Eq. (19): ξ1 = 0.05, m2 = 1/3 kg, 0 ≤ t < "
      "20 s.";
  Sequence frequency{{}, "rad/s"}, amplitude{{}, "m"}, stiffness;
  for (std::size_t i = 0; i < Ns.size(); ++i) {
    const auto which = cases::make("one-parameter", {{"N", double(Ns[i])}});
    figure.panels.push_back(response_panel(which, Quantity::displacement, letters[i],
                                           fmt::format("N = {}", Ns[i]), {-0.4, 1.0}));
    frequency.values.push_back(constant(which, "omega_D2"));
    amplitude.values.push_back(std::abs(constant(which, "d2")));
    stiffness.values.push_back(indicator(which, "I_ms"));
  }
  figure.claims = {
      {"Section 2.2: as N increases, mass 2 oscillates with higher frequencies and smaller "
       "amplitudes.",
       fmt::format("N = 2, 5, 20: ω_D2 = {}, |u2(0)| = {}.", frequency.words(), amplitude.words()),
       frequency.rising() && amplitude.falling()},
      {"Section 2.2: the ratio between the largest and smallest frequencies increases with N.",
       fmt::format("I_ms = ω_D2/ω_D1 = {}.", stiffness.words()), stiffness.rising()}};
  return figure;
}

Figure effect_of_damping() {
  constexpr std::array damping{0.05, 0.10, 0.15};
  Figure figure;
  figure.columns = 3;
  figure.width = 270.0;
  figure.height = 150.0;
  figure.caption =
      "Exact displacements of the two-parameter system, Eq. (21), rows N = 2, 5, 20, columns "
      "ξ1 = 0.05, 0.10, 0.15; 0 ≤ t < 20 s.";
  Sequence left, ratio2, sharp{{}, "rad/s"};
  for (std::size_t i = 0; i < Ns.size(); ++i)
    for (const double xi1 : damping) {
      const auto which = cases::make("two-parameter", {{"N", double(Ns[i])}, {"xi1", xi1}});
      figure.panels.push_back(response_panel(which, Quantity::displacement, letters[i],
                                             fmt::format("N = {}, ξ1 = {:.2f}", Ns[i], xi1),
                                             {-0.4, 1.0}));
      if (i == 0) {
        left.values.push_back(which.motion->envelope(20.0).u[0] / which.motion->envelope(0.0).u[0]);
        ratio2.values.push_back(constant(which, "xi2"));
      }
      if (xi1 == damping[1]) sharp.values.push_back(constant(which, "omega_D2"));
    }
  figure.claims = {
      {"Section 2.2: the rate of decay increases with the damping coefficient.",
       fmt::format("Of the initial amplitude {} are left after 20 s for ξ1 = 0.05, 0.10, 0.15, the "
                   "same for both masses and every N.",
                   left.words()),
       left.falling()},
      {"Section 2.2: by Eq. (15) and (16) an increase in ξ1 increases ξ2.",
       fmt::format("N = 2: ξ2 = {}.", ratio2.words()), ratio2.rising()},
      {"Section 2.2: as N increases, the frequency of mass 2 increases sharply.",
       fmt::format("ξ1 = 0.10, N = 2, 5, 20: ω_D2 = {}.", sharp.words()), sharp.rising()}};
  figure.choices = {
      "The values of ξ1 do not stand in the text of Fig. 8. Taken: 0.05 (Fig. 7), 0.10 (named for "
      "Fig. 8(b) by the caption of Fig. 9) and 0.15 (used in Fig. 10)."};
  return figure;
}

Figure effect_of_duration() {
  constexpr std::array factors{2.0, 5.0, 20.0};
  Figure figure;
  figure.width = 640.0;
  figure.height = 150.0;
  figure.caption =
      "Exact displacements of the three-parameter system for N = 5, ξ1 = 0.10 over 20 a_t seconds.";
  Sequence oscillations, collisions;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto which =
        cases::make("three-parameter", {{"N", 5.0}, {"xi1", 0.10}, {"a_t", factors[i]}});
    figure.panels.push_back(response_panel(which, Quantity::displacement, letters[i],
                                           fmt::format("a_t = {}", factors[i]), {-0.2, 1.0}));
    oscillations.values.push_back(indicator(which, "I_OC"));
    collisions.values.push_back(constant(which, "collisions"));
  }
  figure.claims = {{"Section 2.2: the behaviour is more oscillatory when a_t is larger.",
                    fmt::format("a_t = 2, 5, 20: I_OC = t_end/T_S = {} with the threshold 0.1, and "
                                "{} collisions.",
                                oscillations.words(), collisions.words()),
                    oscillations.rising() && collisions.rising()}};
  return figure;
}

}  // namespace clackers::paper
