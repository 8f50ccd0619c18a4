#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/orbit/bouncing_ball.hpp"
#include "clackers/exact/orbit/circle_billiard.hpp"
#include "clackers/exact/pair/parameters.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/double_double.hpp"

// Masses that come to rest on a stop or on each other:
// docs/manual/explanation/derivations/resting.md.
namespace clackers::cases {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double pi = std::numbers::pi;

// Where all impacts are over; infinite for a motion that has another one always.
void add_rest(std::vector<Quantity>& list, double t) {
  list.push_back({"t_rest", t, "s", "the impacts accumulate here, and the contact stays closed"});
}

void use(Case& test_case, const std::shared_ptr<const model::Motion>& motion) {
  test_case.motion = motion;
  const double end = motion->end();
  test_case.constants.insert(
      test_case.constants.end(),
      {{"error_bound", motion->error_bound(end).u.maxCoeff(), "m",
        "of the displacements of the reference solution at t_end"},
       {"closed_contacts", double(motion->closed_contacts().size()), "",
        "intervals up to t_end in which a contact stays closed"},
       {"t_end", end, "s", "end of the run"},
       {"impacts", double(motion->impact_count(end)), "",
        "number of impacts up to t_end; of those that accumulate the resolved ones"}});
}

void use_flights(Case& test_case) {
  use(test_case,
      std::make_shared<const exact::PiecewiseMotion>(test_case.problem, test_case.entry->name));
}

model::ImpactProblem<> mass_above_stop(double m, double c, double k, double eta,
                                       std::vector<model::HarmonicForce> forces) {
  const auto number = [](double x) { return MatrixXd::Constant(1, 1, x); };
  model::ImpactProblem<> problem;
  problem.system.mass = number(m);
  problem.system.damping = number(c);
  problem.system.stiffness = number(k);
  problem.system.add_load = model::HarmonicLoad(std::move(forces));
  problem.contacts = {{VectorXd::Ones(1), 0.0, eta}};
  return problem;
}

void build_ball(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::BallParameters p{require_within(who, "h0", value("h0"), 0.0, 1e30),
                                require_within(who, "v0", value("v0"), -1e30, 1e30),
                                require_within(who, "g", value("g"), 1e-30, 1e30), value("eta"),
                                end_of(test_case, value)};
  const auto motion = std::make_shared<const exact::BouncingBall>(p, who);
  test_case.problem = motion->problem();
  const double V = motion->speed(), once = 1.0 - p.eta;
  test_case.damped_periods = {2.0 * V / p.g};
  test_case.constants = {{"m", 1.0, "kg", "the mass, of no influence"},
                         {"V", V, "m/s", "speed before the first impact; V eta^j after the j-th"},
                         {"t_1", motion->first_impact(), "s", "time of the first impact"}};
  add_rest(test_case.constants, motion->rest().nearest());
  test_case.constants.push_back(
      {"impulse", V * ((1.0 + p.eta) / once), "N s", "sum of all impulses up to t_rest"});
  test_case.constants.push_back({"lost", 0.5 * V * V, "J", "energy lost at all impacts"});
  use(test_case, motion);
}

// sum over j >= 0 of atan(x eta^j): terms until x eta^j <= 1/2, then the power series of the rest,
// whose geometric sums are closed. At most 27 terms of it count.
double sum_of_atans(double x, double eta) {
  double sum = 0.0;
  for (; x > 0.5; x *= eta) sum += std::atan(x);
  double power = x;
  for (int n = 1; n < 60; n += 2, power *= -x * x)
    sum += power / (n * (eta > 0.0 ? -std::expm1(n * std::log(eta)) : 1.0));
  return sum;
}

// Without damping and with a constant force F > 0: flights return with the speed they left with.
void add_undamped_rest(Case& test_case, double m, double k, double F, double eta) {
  const double G = F / m, u0 = test_case.problem.start.u[0], v0 = test_case.problem.start.v[0];
  auto& list = test_case.constants;
  if (k == 0.0) {
    const double V = std::hypot(v0, std::sqrt(2.0 * G * u0));
    const double t_1 = v0 > 0.0 ? (v0 + V) / G : 2.0 * u0 / (V - v0);
    list.push_back({"V", V, "m/s", "speed before the first impact"});
    return add_rest(list, t_1 + 2.0 * V / G * (eta / (1.0 - eta)));
  }
  const double omega = std::sqrt(k / m);
  const double gained = (k / m * u0 + 2.0 * G) * u0, V = std::sqrt(v0 * v0 + gained);
  // Phases from the top of the flight, tan(start) = -v0/x and tan(first) = V/y. The sine of their
  // difference times (x^2 + v0^2) is V x + v0 y; for v0 < 0 without cancellation.
  const double y = G / omega, x = omega * u0 + y;
  const double sine = v0 >= 0.0
                          ? V * x + v0 * y
                          : (v0 * v0 * (omega * u0) * (x + y) + gained * x * x) / (V * x - v0 * y);
  const double first = std::atan2(sine, x * y - V * v0);
  list.push_back({"V", V, "m/s", "speed before the first impact"});
  constexpr double most_terms = 1e6;
  const double next = omega * eta * V / G;
  if (next > 0.5 && std::log(0.5 / next) < most_terms * std::log(eta)) return;
  add_rest(list, (first + 2.0 * sum_of_atans(next, eta)) / omega);
}

void build_pressed(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const auto within = [&](const char* name, double least) {
    return require_within(who, name, value(name), least, 1e30);
  };
  const double m = within("m", 1e-30), c = within("c", 0.0), k = within("k", 0.0),
               F = within("F", 1e-30), f1 = within("f1", 0.0), nu = within("nu", 1e-30),
               phi = within("phi", -1e30), u0 = within("u0", 0.0), v0 = within("v0", -1e30),
               eta = value("eta");
  exact::require_restitution(who, eta);
  if (u0 == 0.0 && v0 < 0.0)
    refuse(who, "v0", v0, "v0 >= 0 where u0 = 0", "The mass starts on the stop.");
  std::vector<model::HarmonicForce> forces{{0, -F, 0.0, 0.0}};
  if (f1 > 0.0) forces.push_back({0, -f1, nu, phi});
  auto& problem = test_case.problem;
  problem = mass_above_stop(m, c, k, eta, std::move(forces));
  problem.start = {0.0, VectorXd::Constant(1, u0), VectorXd::Constant(1, v0)};
  problem.end = end_of(test_case, value);
  const double end = problem.end, square = k / m - 0.25 * (c / m) * (c / m);
  test_case.damped_periods = {square > 0.0 ? 2.0 * pi / std::sqrt(square) : end};
  if (f1 > 0.0) test_case.damped_periods[0] = std::min(test_case.damped_periods[0], 2.0 * pi / nu);
  test_case.constants = {
      {"omega", std::sqrt(k / m), "rad/s", "undamped frequency without contact"}};
  if (k > 0.0)
    test_case.constants.push_back(
        {"u_static", -F / k, "m", "where the mass would rest without the stop"});
  if (c == 0.0 && f1 == 0.0 && eta < 1.0 && (u0 > 0.0 || v0 > 0.0))
    add_undamped_rest(test_case, m, k, F, eta);
  use_flights(test_case);
  for (const auto& closed : test_case.motion->closed_contacts())
    if (closed.opens) {
      test_case.constants.push_back({"t_release", closed.until, "s",
                                     "the stop is left for the first time, without speed and "
                                     "acceleration"});
      break;
    }
}

// What the problem holds, refused if it is rounded: the masses would not land with equal velocities.
double unrounded(const Case& test_case, const char* name, const numerics::DoubleDouble& value) {
  if (value.lo != 0.0)
    refuse(test_case.entry->name, name, value.hi, "a binary64 number without rounding",
           "Take m1, m2, W and sigma as short binary fractions such as 0.375.", "not-exact-data");
  return value.hi;
}

// A point in the box [0, a] x [0, b], its coordinates as the two masses.
void build_billiard(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  auto& problem = test_case.problem;
  problem.system.mass = MatrixXd::Identity(2, 2);
  problem.system.damping = problem.system.stiffness = MatrixXd::Zero(2, 2);
  problem.start = {0.0, VectorXd(2), VectorXd(2)};
  problem.end = end_of(test_case, value);
  const char* const names[2][3] = {{"a", "x0", "vx"}, {"b", "y0", "vy"}};
  for (Eigen::Index i = 0; i < 2; ++i) {
    const auto& [side, place, speed] = names[i];
    const double length = within(test_case, value, side), x = value(place),
                 v = within(test_case, value, speed, -1e30);
    if (!(x > 0.0 && x < length))
      refuse(who, place, x, fmt::format("0 < {} < {} = {}", place, side, length),
             "The point starts inside the box.");
    problem.start.u[i] = x;
    problem.start.v[i] = v;
    problem.contacts.push_back({VectorXd::Unit(2, i), 0.0, 1.0});
    problem.contacts.push_back({-VectorXd::Unit(2, i), -length, 1.0});
    // Of each coordinate; one that stands still has the run's length.
    test_case.damped_periods.push_back(v != 0.0 ? 2.0 * length / std::abs(v) : problem.end);
  }
  test_case.plane = 0.0;
  test_case.constants = {
      {"T_x", test_case.damped_periods[0], "s", "2 a/|vx|: x is a triangle wave"},
      {"T_y", test_case.damped_periods[1], "s", "2 b/|vy|"}};
  use_flights(test_case);
}

void build_circle(Case& test_case, const Values& value, double) {
  const auto number = [&](const char* name) { return within(test_case, value, name, -1e30); };
  const exact::CircleBilliardParameters p{
      within(test_case, value, "R"), number("x0"), number("y0"), number("vx"), number("vy"),
      end_of(test_case, value)};
  const auto motion = std::make_shared<const exact::CircleBilliard>(p, test_case.entry->name);
  test_case.problem = motion->problem();
  test_case.motion = motion;
  test_case.plane = p.R;
  const double d = motion->distance(), chord = motion->chord(), v = std::hypot(p.vx, p.vy);
  test_case.damped_periods.assign(2, chord / v);
  test_case.constants = {
      {"chord", chord, "m", "from each impact to the next"},
      {"d", d, "m",
       "distance of the chords from the center, positive where it circles to the left"},
      {"turn", 2.0 * std::atan2(0.5 * chord, d), "rad", "of the direction at each impact"},
      {"L", v * d, "kg m^2/s", "angular momentum, of 1 kg"},
      {"error_bound", motion->error_bound(p.end).u.maxCoeff(), "m",
       "of the displacements of the reference solution at t_end"}};
  add_run(test_case);
}

void build_plastic(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const auto within = [&](const char* name, double least, double most) {
    return require_within(who, name, value(name), least, most);
  };
  const double m1 = within("m1", 1e-3, 1e3), m2 = within("m2", 1e-3, 1e3), X = value("X"),
               W = within("W", 1e-3, 1e3), sigma = within("sigma", 0.0, 1e3),
               V = within("V", 1e-3, 1e3);
  if (!(X >= 3.0 && X <= 99.0)) refuse(who, "X", X, "an odd whole number, 3 <= X <= 99");
  if (std::fmod(X, 2.0) != 1.0)
    refuse(who, "X", X, "an odd whole number, 3 <= X <= 99",
           "Only with X odd the masses meet again with equal velocities.", "not-odd");
  const auto product = [&](const char* name, double a, double b) {
    return unrounded(test_case, name, numerics::two_product(a, b));
  };
  const auto stiffness = [&](const char* name, double m, double omega) {
    const auto square = numerics::two_sum(product("the square of a frequency", omega, omega),
                                          product("sigma^2", sigma, sigma));
    return product(name, m, unrounded(test_case, name, square));
  };
  auto& problem = test_case.problem;
  const double k1 = stiffness("k1", m1, product("X W", X, W)), k2 = stiffness("k2", m2, W);
  const auto diagonal = [](double a, double b) { return MatrixXd(Vector2d(a, b).asDiagonal()); };
  problem.system.mass = diagonal(m1, m2);
  problem.system.stiffness = diagonal(k1, k2);
  problem.system.damping = diagonal(product("c1", 2.0 * m1, sigma), product("c2", 2.0 * m2, sigma));
  problem.contacts = {model::contact_between(2, 0, 1, 0.0)};
  problem.start = {0.0, VectorXd::Zero(2), VectorXd::Constant(2, V)};
  problem.end = end_of(test_case, value);
  using numerics::Bounded;
  const auto w_c = Bounded(W) * sqrt((Bounded(m1) * X * X + Bounded(m2)) / (Bounded(m1) + m2)),
             T_c = Bounded::pi() / w_c, T = Bounded::pi() / W;
  test_case.damped_periods = {2.0 * pi / (X * W), 2.0 * pi / W};
  test_case.constants = {
      {"k1", k1, "N/m", "stiffness of mass 1, above"},
      {"k2", k2, "N/m", "stiffness of mass 2"},
      {"c1", problem.system.damping(0, 0), "N s/m", "damping of mass 1"},
      {"c2", problem.system.damping(1, 1), "N s/m", "damping of mass 2"},
      {"w_c", w_c.nearest(), "rad/s", "damped frequency of the masses together"},
      {"T_c", T_c.nearest(), "s", "length of each time together; then they are apart for pi/W"},
      {"factor", exp(-(Bounded(sigma) * (T_c + T))).nearest(), "",
       "of all amplitudes from one T_c + pi/W to the next"}};
  use_flights(test_case);
}

Parameter not_negative(const char* name, double standard, const char* unit, const char* meaning) {
  return {name, standard, unit, std::string("0 <= ") + name + " <= 1e+30", meaning};
}
Parameter any(const char* name, double standard, const char* unit, const char* meaning) {
  return {name, standard, unit, std::string("-1e+30 <= ") + name + " <= 1e+30", meaning};
}
Parameter moderate(const char* name, double standard, const char* unit, const char* meaning) {
  return {name, standard, unit,
          std::string("1e-3 <= ") + name + " <= 1e+3, a short binary fraction", meaning};
}

}  // namespace

std::vector<CaseRow> resting_rows() {
  return {
      {{"ball",
        "A ball dropped on a floor: infinitely many impacts, or one with eta = 0, then rest.",
        "none; u'' = -g, u >= 0",
        {not_negative("h0", 1.0, "m", "initial height"),
         any("v0", 0.0, "m/s", "initial velocity, upwards"),
         positive("g", 9.81, "m/s^2", "gravity"),
         {"eta", 0.8, "", "0 <= eta < 1", "restitution"},
         t_end(5.0)}},
       build_ball},
      {{"pressed-oscillator",
        "A damped mass that a force presses on a stop, with or without a harmonic part: it comes to "
        "rest, and is released.",
        "none; m u'' + c u' + k u = -F - f1 cos(nu t + phi), u >= 0",
        {positive("m", 1.0, "kg", "mass"),
         not_negative("c", 0.0, "N s/m", "damping"),
         not_negative("k", 1.0, "N/m", "stiffness"),
         positive("F", 0.5, "N", "constant force towards the stop"),
         not_negative("f1", 0.0, "N", "amplitude of the harmonic force; beyond F it releases"),
         positive("nu", 1.0, "rad/s", "its frequency"),
         any("phi", 0.0, "rad", "its phase"),
         not_negative("u0", 1.0, "m", "initial displacement from the stop"),
         any("v0", 0.0, "m/s", "initial velocity"),
         {"eta", 0.5, "", "0 <= eta <= 1", "restitution; 1 is elastic"},
         t_end()}},
       build_pressed},
      {{"plastic-pair",
        "Two masses after a plastic impact: they stick, part without speed, and land softly.",
        "none; damped frequencies X W and W, a common decay",
        {moderate("m1", 1.0, "kg", "mass 1, above, the fast one"),
         moderate("m2", 1.0, "kg", "mass 2"),
         {"X", 3.0, "", "an odd whole number, 3 <= X <= 99",
          "frequency of mass 1 over that of mass 2"},
         moderate("W", 1.0, "rad/s", "damped frequency of mass 2"),
         {"sigma", 0.0625, "1/s", "0 <= sigma <= 1e+3, a short binary fraction",
          "common rate of decay"},
         moderate("V", 1.0, "m/s", "common velocity at the start"),
         t_end()}},
       build_plastic},
      {{"billiard",
        "A point in a rectangular box with elastic walls: two triangle waves.",
        "none; u1 = x, u2 = y, without forces",
        {positive("a", 1.0, "m", "side along x"),
         positive("b", 0.75, "m", "side along y"),
         {"x0", 0.25, "m", "0 < x0 < a", "start"},
         {"y0", 0.5, "m", "0 < y0 < b", "start"},
         any("vx", 0.75, "m/s", "velocity along x"),
         any("vy", 0.40625, "m/s", "velocity along y"),
         t_end(20.0)}},
       build_billiard},
      {{"circle-billiard",
        "A point in a circle with an elastic wall: chords of one length, turned by one angle.",
        "none; u1 = x, u2 = y, without forces; a round wall is no row of the problem, so that methods refuse it: for "
        "check and verify --exec",
        {positive("R", 1.0, "m", "radius"), any("x0", 0.25, "m", "start, x0^2 + y0^2 < R^2"),
         any("y0", 0.5, "m", "start"), any("vx", 0.75, "m/s", "velocity along x"),
         any("vy", 0.40625, "m/s", "velocity along y"), t_end(20.0)}},
       build_circle},
  };
}

}  // namespace clackers::cases
