#include "clackers/paper/answers.hpp"

#include <fmt/format.h>

#include "clackers/cases/case.hpp"
#include "clackers/exact/quantities/indicators.hpp"

namespace clackers::paper {
namespace {

// T_L / T_S of the paper's system for some N, as words.
std::string ratios(double threshold) {
  std::string out;
  for (const int N : {0, 1, 2, 5, 10, 20}) {
    const double X = 4.0 * N + 1.0;
    const auto found = exact::indicators(X, 1.0, 20.0, threshold);
    out += fmt::format("{}N = {}: {:.0f} {} {:.0f}", out.empty() ? "" : ", ", N, X,
                       found.bound_holds ? "≥" : "<", found.highest_harmonic);
  }
  return out;
}

Answer shortest_period() {
  return {
      "What is T_S in Eq. (11) and (23)?",
      "T_S = π/(n Ω), Ω = ω_D1, where n is the highest harmonic of mass 2 whose amplitude is at "
      "least ε times the largest one: n = ⌊½ √(X² + (2X − 1)/ε)⌋ for X = 4N + 1 ≥ 3. No numerical "
      "effort is needed, however large N is. Then T_L/T_S = n and I_OC = t_end n Ω/π.",
      {"Without damping u2/u2(0) repeats every T = π/Ω, so it is a Fourier series in cos(2nΩt). "
       "The "
       "integral over one flight gives |a_n| = (4X/π)/|X² − 4n²|, largest for 2n = X − 1, where it "
       "is (4X/π)/(2X − 1).",
       "For 2n > X the condition |a_n| ≥ ε |a_peak| reads 4n² − X² ≤ (2X − 1)/ε, which is the "
       "formula. "
       "For X = 1 the peak is taken at n = 1 and n = ⌊½ √(1 + 3/ε)⌋. Damping is the same factor "
       "for "
       "every harmonic and widens each line by σ."}};
}

Answer threshold() {
  return {"Which oscillations contribute non-trivially, and does Eq. (11) hold?",
          fmt::format(
              "The answer needs a threshold ε of the spectral peak; ours is 0.1, named wherever "
              "T_S or I_OC appears. Eq. (11), I_ms ≥ T_L/T_S, holds if and only if "
              "ε > (2X − 1)/((3X + 2)(X + 2)), for X = 1 if and only if ε > 1/5. With ε = 0.1, "
              "I_ms and T_L/T_S are {}; with ε = 0.001 {}.",
              ratios(0.1), ratios(0.001)),
          {"n > X means n ≥ X + 1, since n is whole. That happens if and only if 4(X + 1)² − X² ≤ "
           "(2X − 1)/ε, and "
           "4(X + 1)² − X² = (3X + 2)(X + 2). The bound falls with X and is below 0.1 from X = 3 "
           "on: it is 5/55 = 0.0909 there. For X = 1, n = 1 is demanded: ε > 3/15 = 1/5."}};
}

Answer sign_at_zero() {
  return {
      "What is the velocity at a collision, where sgn(0) = 0?",
      "Eq. (6) with Eq. (26) gives the displacement at collisions correctly, 0, and makes its "
      "factor "
      "of the velocity 0 too. Both one-sided limits differ from 0: v1(−) = −Ω A exp(−σ t_k) "
      "and v1(+) = −η v1(−), and v2 = −r v1 on either side. So a collision is asked for by its "
      "number and its side, and never found by testing cos = 0.",
      {"Let θ = Ωt − kπ in [−π/2, π/2), k = ⌊Ωt/π + ½⌋. Since X is odd, cos(X(θ + kπ)) = "
       "(−1)^k cos(Xθ): the sign of cos(Ωt) cancels and u1 = A E cos θ, u2 = u2(0) E cos(Xθ) with "
       "E = η^k exp(−σt). The sign function is not needed, and left and right limits are those of "
       "two neighbouring flights at θ = ±π/2.",
       "No double is a collision time, since these are odd multiples of π/(2Ω)."}};
}

Answer factor_three() {
  const auto star = [](double X) { return cases::admissibility(X, 3.0).r_star; };
  return {
      "Where does the factor 3 of Eq. (18) come from, and is it sharp?",
      fmt::format(
          "It is sufficient for every X = 4N + 1 and every ξ1, and not sharp. With "
          "−u2(0) = r u1(0)/X the masses stay apart between collisions if and only if r < r*(X) = "
          "−1/min sin(Xθ)/(X sin θ): r* = {:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f} for N = 1, 2, 5, "
          "10, 20, "
          "rising to 4.6033. For N = 0 any r is admissible. The factor 3 is sharp only for X = 3, "
          "which the paper leaves out: there r = 3 grazes at t = 0.",
          star(5.0), star(9.0), star(21.0), star(41.0), star(81.0)),
      {"Both masses carry the factor E > 0, so the gap has the sign of cos θ + (r/X) cos(Xθ) up to "
       "the sign of u2(0), and damping cancels. Counted from the collision, x = X(π/2 − |θ|), it "
       "is "
       "X sin(x/X) + r sin x, to be positive on (0, Xπ/2].",
       "Take r = 3, X ≥ 5. For x ≤ π both terms are positive or zero, not both zero. For π ≤ x ≤ "
       "5π/2, X sin(x/X) ≥ "
       "5 sin(x/5), as X sin(x/X) rises with X; with y = sin²(x/5), 5 sin(x/5) + 3 sin x = "
       "sin(x/5)(48y² − 60y + 20), whose discriminant 60² − 4·48·20 = −240 is negative. Beyond, "
       "X sin(x/X) ≥ 2x/π ≥ 5 > 3.",
       "The sharp value: the minimum lies where X sin(x/X) cos x = sin x cos(x/X), x in (π, 3π/2), "
       "and r* = √(1 + (X² − 1) sin²(x/X)). For X → ∞ this is tan x = x and r* = √(1 + x²)."}};
}

}  // namespace

std::vector<Answer> answers() {
  return {shortest_period(), threshold(), sign_at_zero(), factor_three()};
}

}  // namespace clackers::paper
