// Figures 1, 3, 4 and 5: displacement and velocity of one motion each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/study/verify.hpp"
#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {
namespace {

constexpr double step = 0.001;  // [s]

// A phase formed in plain double precision is wrong by up to X t ulp of the amplitude, to which the
// exponential and the products add four.
double plain_precision(double X, double end) { return 0x1p-52 * (X * end + 4.0); }

// rk4 at 0.001 s of a motion that is 20 s long: X h = 0.005 to the fourth power, times X t / 120, is
// 5e-10 for X = 5; 1e-8 leaves room for the error of the impacts.
constexpr double most_integration_error = 1e-8;

// A run of rk4, which knows nothing of the closed form.
Claim integrated(const std::string& says, const std::string& name,
                 const cases::Settings& settings) {
  study::VerifyRequest request;
  request.methods = {"rk4"};
  request.cases = {name};
  request.settings = settings;
  request.plan = {.coarsest = step, .levels = 1, .samples_per_level = 1};
  request.jobs = 1;
  const auto record = study::verify(request).cases.at(0);
  const auto score = record::worst_of_finest(record.subjects.at(0)).worst;
  const long long expected = record.problem.impact_count;
  const long long found = score.impacts ? score.impacts->found : 0;
  auto measured = fmt::format("rk4 with located impacts, step {} s: largest error {}", step,
                              number(score.u_error));
  if (expected > 0) measured += fmt::format(", {} of {} impacts", found, expected);
  return {says, measured + ".", score.u_error < most_integration_error && found == expected};
}

Figure displacement_and_velocity(const cases::Case& test_case) {
  Figure figure;
  for (const auto quantity : {Quantity::displacement, Quantity::velocity})
    figure.panels.push_back(response_panel(test_case, quantity, "", ""));
  return figure;
}

// Eq. (4), or with sgn Eq. (5), as the paper writes it.
Series as_written(const Series& like, bool with_sign) {
  Series out = like;
  for (std::size_t i = 0; i < out.x.size(); ++i) {
    const double t = out.x[i], c = std::cos(std::sqrt(0.9975) * t);
    out.y[i] = (with_sign ? std::abs(c) : c) * std::exp(-0.05 * t);
  }
  return out;
}

Claim formula(const std::string& says, const Panel& panel, bool with_sign) {
  const auto& u = panel.series.front();
  const double difference = largest_difference(u, as_written(u, with_sign));
  return {says,
          fmt::format(
              "The formula in double precision and our motion differ by at most {} m at {} times.",
              number(difference), u.x.size()),
          difference <= plain_precision(1.0, 20.0)};
}

}  // namespace

Figure free_mass() {
  const auto test_case = cases::make("sdof");
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "Exact displacement and velocity of ü + 0.1 u̇ + u = 0, u(0) = 1 m, u̇(0) = −0.05 m/s, 0 ≤ t < 20 s.";
  figure.claims = {
      formula("Section 2.1: Eq. (4) is the exact response.", figure.panels.front(), false),
      integrated("Section 2.1: it solves Eq. (3).", "sdof", {})};
  return figure;
}

Figure response_at_stop() {
  const auto test_case = cases::make("stop");
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "Exact displacement and velocity of the mass of Fig. 1 with a rigid stop at its equilibrium, restitution η = 1. At each impact the velocity jumps; both limits are drawn.";
  figure.claims = {
      formula("Section 2.1: with the stop the response becomes Eq. (5).", figure.panels.front(),
              true),
      integrated("Section 2.1: it solves Eq. (3) with elastic impacts at u = 0.", "stop", {})};
  return figure;
}

Figure symmetric_pair() {
  const auto test_case = cases::make("symmetric-pair"), stop = cases::make("stop");
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "Exact displacements and velocities of two equal masses with opposite starts, Eq. (7): ξ1 = 0.05, η = 1, 0 ≤ t < 20 s.";
  double difference = 0.0;
  for (const auto quantity : {Quantity::displacement, Quantity::velocity})
    difference = std::max(
        difference, largest_difference(curve(test_case, 1, quantity), curve(stop, 1, quantity)));
  figure.claims = {
      {"Section 2.1: displacement and velocity of mass 1 are identical to those of Fig. 3.",
       fmt::format("The largest difference of displacements [m] and velocities [m/s] is {}.",
                   number(difference)),
       difference <= 0x1p-53},
      integrated("Section 2.1: Eq. (8) is the exact response of Eq. (7).", "symmetric-pair", {})};
  return figure;
}

Figure sample_extension() {
  const auto test_case = cases::make("one-parameter", {{"N", 1.0}});
  auto figure = displacement_and_velocity(test_case);
  figure.caption =
      "The second mass five times as fast as the first (N = 1, Eq. 19: m2 = 1/3 kg, u2(0) = −0.6 m, ξ1 = 0.05): the masses still meet only at their common equilibrium.";
  const FreeFlight mass1(test_case, 1), mass2(test_case, 2);
  const auto& mass = test_case.problem.system.mass;
  const double t1 = constant(test_case, "t_1");
  const double apart = std::max(std::abs(mass1.u(t1)), std::abs(mass2.u(t1)));
  const double p1 = mass(0, 0) * mass1.v(t1), p2 = mass(1, 1) * mass2.v(t1);
  const double momentum = std::abs(p1 + p2) / std::abs(p1);
  const int counted = maxima(figure.panels.front().series.at(1), t1);
  figure.claims = {
      {"Section 2.2: the first impact is at the common equilibrium, the momenta equal and opposite.",
       fmt::format(
           "Each mass alone, from its own m, c, k: at t = π/(2 ω_D1) = {:.6f} s both displacements are below {} m and the momenta add up to {} of one of them.",
           t1, number(apart), number(momentum)),
       // 25 ulp of phase, as in plain_precision, at up to five times the slope
       apart < 5.0 * plain_precision(5.0, t1) && momentum < 5.0 * plain_precision(5.0, t1)},
      {"Section 2.2: N is the number of maxima of mass 2 before the first impact; Fig. 5 shows N = 1.",
       fmt::format("{} maximum of u2 in 0 < t < {:.4f} s.", counted, t1), counted == 1},
      integrated("Section 2.2: Eq. (20) is the exact response of Eq. (19).", "one-parameter",
                 {{"N", 1.0}})};
  return figure;
}

}  // namespace clackers::paper
