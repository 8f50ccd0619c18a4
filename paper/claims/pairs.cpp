// What is measured of simulated pairs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/cases/case.hpp"
#include "clackers/exact/quantities/quantities.hpp"
#include "paper/claims/claim.hpp"

namespace clackers::paper {
namespace {

using model::Side;

// Maxima of u2 inside (0, end).
double maxima_of_mass2(const Pair& pair, double end) {
  const auto u = mass2(pair, 0.0, end);
  double count = 0.0;
  for (std::size_t j = 1; j + 1 < u.size(); ++j) count += u[j] > u[j - 1] && u[j] >= u[j + 1];
  return count;
}

// Half turns of mass 2 between the first two impacts, without whose instants.
double half_turns(const Pair& pair, double) {
  const auto u = mass2(pair, pair.quarters(1.0), pair.quarters(3.0));
  double turns = 1.0;
  for (std::size_t j = 2; j + 1 < u.size(); ++j) turns += u[j] * u[j - 1] < 0.0 || u[j] == 0.0;
  return turns;
}

// The least (u1 − u2)/u1 in from < t < to, in quarters, not beside impacts, where both vanish.
template <int from, int to>
double least_gap(const Pair& pair, double) {
  const auto motion = pair.motion(pair.quarters(to));
  const double points = 500.0 * pair.X;
  double least = 2.0;
  for (double j = 1.0; j < points; ++j) {
    const double t = pair.quarters(from + (to - from) * j / points);
    const auto u = u_of(motion, t);
    if (u[0] > 1e-6 * motion.envelope(t).u[0]) least = std::min(least, (u[0] - u[1]) / u[0]);
  }
  return least;
}

// The first impact in periods of a mass alone, to the twelve digits of the simulation.
template <int mass>
double first_impact(const Pair& pair, double) {
  const double decay = pair.c[mass] / (2.0 * pair.m[mass]);
  const double omega = std::sqrt(pair.k[mass] / pair.m[mass] - decay * decay);
  return std::round(pair.motion(pair.quarters(2.0)).impact(1).t * omega / (2.0 * std::numbers::pi) *
                    1e12) /
         1e12;
}

double simulated(const Pair& pair, double end) {
  const auto motion = pair.motion(end);
  double out = 0.0;
  for (int i = 0; i < pair.masses; ++i)
    out = std::max(
        out, largest(0.0, end, [&](double t) { return u_of(motion, t)[i] - pair.written(t, i); }));
  return out / pair.u[0];
}

// In steps of 0.01/X s: (X h)⁴ X t/120 is below 1e-6 for X t < 12000.
double integrated(const Pair& pair, double end) {
  return difference(
             history(pair.problem(end), "rk4", 0.01 / pair.X / std::sqrt(pair.k[0] / pair.m[0])),
             pair) /
         pair.u[0];
}

// Impacts of the simulation, where the run of rk4 has as many.
double agreed_impacts(const Pair& pair, double end) {
  const auto count = pair.motion(end).impact_count(end);
  const auto found = history(pair.problem(end), "rk4", 0.01 / pair.X).impacts->size();
  return std::size_t(count) == found ? double(count) : -1e9;
}

template <int steps>
double error_in(const Pair& pair, double end) {
  return difference(history(pair.problem(end), "rk4", end / steps), pair);
}

template <int mass>
double largest_u(const Pair& pair, double end) {
  const auto motion = pair.motion(end);
  return largest(0.0, end, [&](double t) { return u_of(motion, t)[mass]; });
}

double mirrored(const Pair& pair, double) {
  const double t1 = pair.quarters(1.0), t2 = pair.quarters(3.0);
  return difference(pair.motion(t2), pair.apart().motion(t2), t1, t2, -1.0);
}

double coincident(const Pair& pair, double end) {
  const auto a = pair.motion(end).at(end, Side::right),
             b = pair.apart().motion(end).at(end, Side::right);
  return std::max((a.u - b.u).cwiseAbs().maxCoeff(), (a.v - b.v).cwiseAbs().maxCoeff() / pair.X);
}

// The motion after `end` against that from the start, or from the state then.
double smaller_later(const Pair& pair, double end) {
  return difference(pair.motion(end), pair.motion(2.0 * end), 0.0, end, std::exp(pair.sigma * end),
                    end);
}
double restarted(const Pair& pair, double end) {
  return difference(pair.from(end).motion(end), pair.motion(2.0 * end), 0.0, end, 1.0, end);
}

double moved(const Pair& pair, double end) {
  Pair other = pair;
  other.u[0] += 1e-9;
  return difference(pair.motion(end), other.motion(end), 0.0, end);
}

// By how much the responses to the start and to the state at 0.4 s do not add up, in from < t < to.
template <int from, int to>
double not_added_up(const Pair& pair, double) {
  const Pair later = pair.from(0.4);
  Pair sum = pair;
  for (int i = 0; i < 2; ++i) sum.u[i] += later.u[i], sum.v[i] += later.v[i];
  const auto a = pair.motion(to), b = later.motion(to), c = sum.motion(to);
  return largest(from, to, [&](double t) {
    return (u_of(c, t) - u_of(a, t) - u_of(b, t)).cwiseAbs().maxCoeff();
  });
}

// xi2 of Eq. (9) and (12), by bisection of xi1 sqrt(1 − xi2²)/xi2 = X sqrt(1 − xi1²).
double solved_xi2(const Pair& pair, double) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (pair.xi1 * std::sqrt(1.0 - middle * middle) >
             middle * pair.X * std::sqrt(1.0 - pair.xi1 * pair.xi1)
         ? low
         : high) = middle;
  }
  return low;
}

// By how much the design differs from the numbers printed in Eq. (19), (21), (25).
double not_as_printed(const Pair& pair, double) {
  const double root = (1.0 - pair.xi1 * pair.xi1) * pair.X * pair.X + pair.xi1 * pair.xi1,
               d2 = -3.0 / pair.X;
  double off = 0.0;
  for (const double ratio : {pair.m[1] * 3.0, pair.k[1] * 3.0 / root, pair.u[1] / d2,
                             pair.v[1] / (-pair.xi1 * d2), pair.xi2 * std::sqrt(root) / pair.xi1})
    off = std::max(off, std::abs(ratio - 1.0));
  return off;
}

// ω2 with ξ2 = 1/2, as Eq. (9) and (10) have it with any ξ2.
double other_omega2(const Pair& pair) { return pair.X * pair.Omega / std::sqrt(0.75); }

// n = X + 1 is the first harmonic beyond I_ms: up to its size as a threshold Eq. (11) fails.
double failing_threshold(const Pair& pair, double) {
  return harmonics(pair)[std::size_t(pair.X) + 1];
}
double stated_threshold(const Pair& pair, double) {
  return pair.X == 1.0 ? 0.2 : (2.0 * pair.X - 1.0) / ((3.0 * pair.X + 2.0) * (pair.X + 2.0));
}

double counted_harmonics(const Pair& pair, double) {
  const auto sizes = harmonics(pair);
  auto n = sizes.size() - 1;
  while (sizes[n] < cases::default_threshold) --n;
  return double(n);
}
exact::Indicators indicators(const Pair& pair, double end) {
  return exact::indicators(pair.X, pair.Omega, end, cases::default_threshold);
}

// (u1 − u2) exp(σ t) against D' of Eq. (A.13) and D'' of Eq. (A.17).
double not_D(const Pair& pair, double end) {
  const auto motion = pair.motion(end);
  return largest(0.0, end, [&](double t) {
    const auto u = u_of(motion, t);
    const double angle = std::remainder(pair.Omega * t, std::numbers::pi);
    return (u[0] - u[1]) * std::exp(pair.sigma * t) - std::cos(angle) -
           3.0 / pair.X * std::cos(pair.X * angle);
  });
}
double gap(const Pair& pair, double end) {
  const auto u = u_of(pair.motion(end), end);
  return u[0] - u[1];
}
double printed_gap(const Pair& pair, double end) {
  return (std::cos(end) + 3.0 / pair.X) * std::cos(pair.X * end);
}

}  // namespace

std::span<const Measure> measures_of_pairs() {
  using Of = const Pair&;
  static const Measure table[] = {
      {"impacts", [](Of pair, double end) { return double(Impacts(pair, end).count); }},
      {"u", [](Of pair, double end) { return Impacts(pair, end).u; }},
      {"late", [](Of pair, double end) { return Impacts(pair, end).late; }},
      {"turned", [](Of pair, double end) { return Impacts(pair, end).turned; }},
      {"momentum", [](Of pair, double end) { return Impacts(pair, end).momentum; }},
      {"rate", [](Of pair, double end) { return Impacts(pair, end).rate; }},
      {"closing", [](Of pair, double end) { return Impacts(pair, end).closing; }},
      {"simulated", simulated},
      {"integrated", integrated},
      {"agreed impacts", agreed_impacts},
      {"half turns", half_turns},
      {"maxima of u2", maxima_of_mass2},
      {"largest u1", largest_u<0>},
      {"largest u2", largest_u<1>},
      {"error in 40000 steps", error_in<40'000>},
      {"error in 1000000 steps", error_in<1'000'000>},
      {"gap before first", least_gap<0, 1>},
      {"gap before second", least_gap<1, 3>},
      {"gap after second", least_gap<3, 4>},
      {"first impact in slow periods", first_impact<0>},
      {"first impact in fast periods", first_impact<1>},
      {"mirrored", mirrored},
      {"coincident", coincident},
      {"smaller later", smaller_later},
      {"restarted", restarted},
      {"moved", moved},
      {"not added up before", not_added_up<0, 1>},
      {"not added up after", not_added_up<2, 6>},
      {"v1", [](Of pair, double end) { return pair.motion(end).at(end, Side::right).v[0]; }},
      {"v1 at start",
       [](Of pair, double end) { return pair.motion(end).at(0.0, Side::right).v[0]; }},
      {"xi2", solved_xi2},
      {"designed xi2", [](Of pair, double) { return pair.xi2; }},
      {"not as printed", not_as_printed},
      {"other X",
       [](Of pair, double) { return other_omega2(pair) * std::sqrt(0.75) / pair.Omega; }},
      {"X", [](Of pair, double) { return pair.X; }},
      {"other decay", [](Of pair, double) { return 0.5 * other_omega2(pair); }},
      {"failing threshold", failing_threshold},
      {"stated threshold", stated_threshold},
      {"counted n", counted_harmonics},
      {"n", [](Of pair, double end) { return indicators(pair, end).highest_harmonic; }},
      {"I_OC", [](Of pair, double end) { return indicators(pair, end).oscillations; }},
      {"m2", [](Of pair, double) { return pair.m[1]; }},
      {"k2", [](Of pair, double) { return pair.k[1]; }},
      {"k2/m2", [](Of pair, double) { return pair.k[1] / pair.m[1]; }},
      {"m2 u2", [](Of pair, double) { return pair.m[1] * pair.u[1]; }},
      {"left",
       [](Of pair, double end) { return std::exp(-(pair.sigma + Impacts(pair, end).rate) * end); }},
      {"u1", [](Of pair, double end) { return u_of(pair.motion(end), end)[0]; }},
      {"gap", gap},
      {"printed gap", printed_gap},
      {"not D", not_D},
  };
  return table;
}

}  // namespace clackers::paper
