#include "clackers/cases/case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/files/files.hpp"
#include "clackers/base/testing/refusal.hpp"
#include "clackers/model/problem_file.hpp"

namespace clackers::cases {
namespace {

double constant(const std::vector<Quantity>& list, std::string_view name) {
  for (const auto& c : list)
    if (c.name == name) return c.value;
  ADD_FAILURE() << "no constant " << name;
  return NAN;
}

std::string refusal(std::string_view name, const Settings& settings, double threshold = 0.1) {
  return test::refusal_of([&] { make(name, settings, threshold); });
}

// Half a unit in the last place for each of the handful of roundings of the formula in the test.
constexpr double roundings = 8.0 * 2.3e-16;

void expect_near(double value, double expected, std::string_view what) {
  EXPECT_NEAR(value, expected, roundings * std::abs(expected)) << what;
}

TEST(Cases, StartWithTheDefaultOne) { EXPECT_EQ(default_case(), "three-parameter"); }

TEST(Cases, BuildAProblemAndItsReferenceThatFitTogether) {
  for (const auto& entry : entries()) {
    SCOPED_TRACE(entry.name);
    const auto test_case = make(entry.name);
    EXPECT_EQ(test_case.entry->name, entry.name);
    EXPECT_NO_THROW(model::validate(test_case.problem));
    EXPECT_EQ(test_case.problem.dof(), test_case.motion->dof());
    EXPECT_EQ(test_case.problem.start.t, 0.0);
    EXPECT_EQ(test_case.problem.end, test_case.motion->end());
    EXPECT_EQ(test_case.damped_periods.size(), static_cast<std::size_t>(test_case.motion->dof()));
    const auto start = test_case.motion->at(0.0, model::Side::right);
    const auto bound = test_case.motion->error_bound(0.0);
    EXPECT_TRUE(((test_case.problem.start.u - start.u).array().abs() <= bound.u.array()).all());
    EXPECT_TRUE(((test_case.problem.start.v - start.v).array().abs() <= bound.v.array()).all());
    for (Eigen::Index i = 0; i < start.v.size(); ++i)
      EXPECT_TRUE(test_case.problem.start.v[i] != 0.0 || start.v[i] == 0.0) << start.v[i];
    // The equation of motion at the start, with the problem's own numbers; each of the terms carries
    // three roundings, and the reference its bound.
    const auto& s = test_case.problem.system;
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(start.u.size());
    if (s.nonlinear) s.nonlinear->add(start.u, start.v, forces);
    forces = -forces;
    if (s.add_load) s.add_load(0.0, {forces.data(), std::size_t(forces.size())});
    const Eigen::VectorXd rest =
        s.mass * start.a + s.damping * start.v + s.stiffness * start.u - forces;
    const Eigen::VectorXd size = s.stiffness.cwiseAbs() * start.u.cwiseAbs() + forces.cwiseAbs() +
                                 s.damping.cwiseAbs() * start.v.cwiseAbs();
    // Friction has any force up to its limit; contacts, and friction at them, have none at the start.
    Eigen::VectorXd friction = Eigen::VectorXd::Zero(rest.size());
    for (const auto& f : test_case.problem.frictions)
      if (!f.contact) friction += f.limit * f.direction.cwiseAbs();
    const Eigen::VectorXd error = friction + s.mass.cwiseAbs() * bound.a +
                                  s.damping.cwiseAbs() * bound.v + s.stiffness.cwiseAbs() * bound.u;
    for (Eigen::Index i = 0; i < rest.size(); ++i)
      EXPECT_LE(std::abs(rest[i]), roundings * size[i] + error[i]);
    for (const auto* list : {&test_case.constants, &test_case.indicators})
      for (const auto& c : *list) EXPECT_FALSE(c.name.empty() || c.meaning.empty());
    EXPECT_EQ(constant(test_case.constants, "impacts"),
              double(test_case.motion->impact_count(test_case.problem.end)));
    EXPECT_EQ(constant(test_case.constants, "t_end"), test_case.problem.end);
    EXPECT_FALSE(entry.summary.empty() || entry.equations.empty());
  }
}

// Eq. (25) in the paper's own words, N and xi1 free.
void expect_three_parameter_system(const Case& test_case, double N, double xi1, double end) {
  SCOPED_TRACE(testing::Message() << test_case.entry->name << " N=" << N << " xi1=" << xi1);
  const double X = 4.0 * N + 1.0, square = (1.0 - xi1 * xi1) * X * X + xi1 * xi1;
  const double d2 = -3.0 / X;
  const auto& s = test_case.problem.system;
  expect_near(s.mass(0, 0), 1.0, "m1");
  expect_near(s.mass(1, 1), 1.0 / 3.0, "m2");
  expect_near(s.stiffness(0, 0), 1.0, "k1");
  expect_near(s.stiffness(1, 1), square / 3.0, "k2");
  expect_near(s.damping(0, 0), 2.0 * xi1, "c1");
  expect_near(s.damping(1, 1), 2.0 / 3.0 * std::sqrt(square) * (xi1 / std::sqrt(square)), "c2");
  EXPECT_EQ(s.mass(0, 1), 0.0);
  EXPECT_EQ(s.stiffness(0, 1), 0.0);
  EXPECT_EQ(s.damping(0, 1), 0.0);
  expect_near(test_case.problem.start.u[0], 1.0, "u1(0)");
  expect_near(test_case.problem.start.u[1], d2, "u2(0)");
  expect_near(test_case.problem.start.v[0], -xi1, "v1(0)");
  expect_near(test_case.problem.start.v[1], -xi1 * d2, "v2(0)");
  EXPECT_EQ(test_case.problem.end, end);
  ASSERT_EQ(test_case.problem.contacts.size(), 1u);
  const auto& contact = test_case.problem.contacts[0];
  EXPECT_EQ(contact.direction[0], 1.0);
  EXPECT_EQ(contact.direction[1], -1.0);
  EXPECT_EQ(contact.gap, 0.0);
  EXPECT_EQ(contact.restitution, 1.0);
  // The words of `show`.
  const auto& c = test_case.constants;
  const double omega_d1 = std::sqrt(1.0 - xi1 * xi1), T = std::numbers::pi / omega_d1;
  expect_near(constant(c, "m2"), 1.0 / 3.0, "m2");
  expect_near(constant(c, "k2"), square / 3.0, "k2");
  expect_near(constant(c, "c1"), 2.0 * xi1, "c1");
  expect_near(constant(c, "c2"), 2.0 / 3.0 * xi1, "c2");
  expect_near(constant(c, "xi2"), xi1 / std::sqrt(square), "xi2");
  expect_near(constant(c, "sigma"), xi1, "sigma");
  expect_near(constant(c, "omega1"), 1.0, "omega1");
  expect_near(constant(c, "omega2"), std::sqrt(square), "omega2");
  expect_near(constant(c, "omega_D1"), omega_d1, "omega_D1");
  expect_near(constant(c, "omega_D2"), X * omega_d1, "omega_D2");
  expect_near(constant(c, "d2"), d2, "d2");
  expect_near(constant(c, "v1(0)"), -xi1, "v1(0)");
  expect_near(constant(c, "v2(0)"), -xi1 * d2, "v2(0)");
  EXPECT_EQ(constant(c, "X"), X);
  EXPECT_EQ(constant(c, "r"), 3.0);
  EXPECT_EQ(constant(c, "eta"), 1.0);
  expect_near(constant(c, "T"), T, "T");
  expect_near(constant(c, "t_1"), 0.5 * T, "t_1, Eq. (28)");
  EXPECT_EQ(constant(c, "impacts"), std::floor(end / T + 0.5));
  expect_near(test_case.damped_periods[0], 2.0 * T, "period 1");
  expect_near(test_case.damped_periods[1], 2.0 * T / X, "period 2");
}

TEST(Cases, OneParameterIsEq19) {
  for (const double N : {0.0, 1.0, 2.0, 20.0})
    expect_three_parameter_system(make("one-parameter", {{"N", N}}), N, 0.05, 20.0);
  expect_three_parameter_system(make("one-parameter"), 2.0, 0.05, 20.0);
}

TEST(Cases, TwoParameterIsEq21) {
  for (const double xi1 : {0.0, 0.05, 0.25})
    expect_three_parameter_system(make("two-parameter", {{"xi1", xi1}, {"N", 5}}), 5.0, xi1, 20.0);
}

TEST(Cases, ThreeParameterIsEq25) {
  expect_three_parameter_system(make("three-parameter"), 2.0, 0.05, 20.0);
  for (const double N : {0.0, 1.0, 5.0, 20.0, 100000.0})
    for (const double xi1 : {0.0, 0.05, 0.25})
      for (const double a_t : {0.5, 1.2, 20.0})
        expect_three_parameter_system(
            make("three-parameter", {{"N", N}, {"xi1", xi1}, {"a_t", a_t}}), N, xi1, 20.0 * a_t);
}

TEST(Cases, DisplacementsAreThoseOfEq26) {
  const auto test_case = make("three-parameter", {{"N", 1}, {"xi1", 0.1}});
  const double omega = std::sqrt(0.99);
  for (const double t : {0.3, 1.9, 4.0, 9.0, 19.5}) {
    const double slow = std::cos(omega * t), sign = slow < 0.0 ? -1.0 : 1.0, e = std::exp(-0.1 * t);
    const auto now = test_case.motion->at(t, model::Side::left);
    // 5 omega t is 97 at most: its rounding moves the cosine by 97 * 2^-53 or less, twice.
    EXPECT_NEAR(now.u[0], sign * slow * e, 1e-14);
    EXPECT_NEAR(now.u[1], -0.6 * sign * std::cos(5.0 * omega * t) * e, 1e-13);
  }
}

TEST(Cases, SymmetricPairIsEq7) {
  const auto test_case = make("symmetric-pair");
  const auto& s = test_case.problem.system;
  for (const Eigen::Index i : {0, 1}) {
    const double sign = i == 0 ? 1.0 : -1.0;
    EXPECT_EQ(s.mass(i, i), 1.0);
    EXPECT_EQ(s.stiffness(i, i), 1.0);
    EXPECT_EQ(s.damping(i, i), 0.1);
    EXPECT_EQ(test_case.problem.start.u[i], sign);
    EXPECT_EQ(test_case.problem.start.v[i], -0.05 * sign);
  }
  EXPECT_EQ(constant(test_case.constants, "X"), 1.0);
  EXPECT_EQ(constant(test_case.constants, "r"), 1.0);
  EXPECT_TRUE(std::isinf(constant(test_case.constants, "r*")));
  EXPECT_EQ(constant(test_case.constants, "margin"), 2.0);
  EXPECT_EQ(make("symmetric-pair", {{"eta", 0.5}}).problem.contacts[0].restitution, 0.5);
  EXPECT_EQ(make("symmetric-pair", {{"t_end", 7.0}}).motion->end(), 7.0);
  EXPECT_EQ(make("symmetric-pair", {{"xi1", 0.25}}).problem.system.damping(1, 1), 0.5);
}

TEST(Cases, StopIsEq5AndSdofEq3) {
  for (const auto* name : {"sdof", "stop"}) {
    const auto test_case = make(name, {{"xi1", 0.25}, {"t_end", 12.0}});
    EXPECT_EQ(test_case.problem.system.mass(0, 0), 1.0);
    EXPECT_EQ(test_case.problem.system.damping(0, 0), 0.5);
    EXPECT_EQ(test_case.problem.system.stiffness(0, 0), 1.0);
    EXPECT_EQ(test_case.problem.start.u[0], 1.0);
    EXPECT_EQ(test_case.problem.start.v[0], -0.25);
    EXPECT_EQ(test_case.problem.end, 12.0);
    const double omega_d = std::sqrt(1.0 - 0.0625);
    expect_near(test_case.damped_periods[0], 2.0 * std::numbers::pi / omega_d, "period");
    expect_near(constant(test_case.constants, "omega_D1"), omega_d, "omega_D1");
    EXPECT_EQ(constant(test_case.constants, "c1"), 0.5);
    EXPECT_EQ(constant(test_case.constants, "v1(0)"), -0.25);
  }
  EXPECT_TRUE(make("sdof").problem.contacts.empty());
  EXPECT_TRUE(make("sdof").indicators.empty());
  const auto stop = make("stop", {{"eta", 0.5}});
  ASSERT_EQ(stop.problem.contacts.size(), 1u);
  EXPECT_EQ(stop.problem.contacts[0].direction[0], 1.0);
  EXPECT_EQ(stop.problem.contacts[0].restitution, 0.5);
  EXPECT_EQ(constant(stop.constants, "eta"), 0.5);
  expect_near(constant(stop.constants, "T"), std::numbers::pi / std::sqrt(0.9975), "T");
  expect_near(constant(stop.constants, "t_1"), 0.5 * std::numbers::pi / std::sqrt(0.9975), "t_1");
  EXPECT_EQ(constant(stop.constants, "impacts"), 6.0);
}

TEST(Cases, SynchronizedPairPassesEveryParameterOn) {
  const auto test_case = make("synchronized-pair", {{"m1", 2.0},
                                                    {"k1", 8.0},
                                                    {"xi1", 0.125},
                                                    {"A", 0.5},
                                                    {"X", 3.0},
                                                    {"r", 2.5},
                                                    {"eta", 0.75},
                                                    {"t_end", 7.0}});
  const auto& s = test_case.problem.system;
  const double sigma = 0.25, own = (2.0 * 2.0 * (1.0 - 0.015625)) * 9.0 + sigma * sigma;
  expect_near(s.mass(0, 0), 2.0, "m1");
  expect_near(s.mass(1, 1), 0.8, "m2");
  expect_near(s.stiffness(0, 0), 8.0, "k1");
  expect_near(s.stiffness(1, 1), 0.8 * own, "k2");
  expect_near(s.damping(0, 0), 1.0, "c1");
  expect_near(s.damping(1, 1), 0.4, "c2");
  EXPECT_EQ(test_case.problem.start.u[0], 0.5);
  // s = -1 for X = 3: u2(0) has the sign of u1(0).
  expect_near(test_case.problem.start.u[1], 2.5 * 0.5 / 3.0, "u2(0)");
  EXPECT_EQ(test_case.problem.contacts[0].restitution, 0.75);
  EXPECT_EQ(test_case.motion->end(), 7.0);
  EXPECT_EQ(constant(test_case.constants, "r*"), 3.0);
  expect_near(constant(test_case.constants, "margin"), 1.0 - 2.5 / 3.0, "margin");
}

TEST(Cases, ExchangedRolesAreOneOverAnOddNumber) {
  const auto test_case = make("synchronized-pair", {{"X", 1.0 / 5.0}, {"r", 0.5}});
  expect_near(constant(test_case.constants, "omega_D1") / constant(test_case.constants, "omega_D2"),
              5.0, "X");
  EXPECT_EQ(constant(test_case.constants, "X"), 0.2);
  EXPECT_EQ(constant(test_case.constants, "r"), 0.5);
  EXPECT_EQ(constant(test_case.constants, "r*"), 4.0);
  EXPECT_EQ(constant(test_case.constants, "margin"), 0.5);
  EXPECT_EQ(constant(test_case.indicators, "I_ms"), 5.0);
  // The slow mass, here the second, makes the longest period.
  expect_near(constant(test_case.indicators, "T_L"), 5.0 * std::numbers::pi / std::sqrt(0.9975),
              "T_L");
}

TEST(Cases, ExactDataPairHasTheExactInputsOfItsFormulas) {
  const auto test_case = make("exact-data-pair");
  const auto& s = test_case.problem.system;
  EXPECT_EQ(s.mass(0, 0), 0.5);
  EXPECT_EQ(s.mass(1, 1), 1.0);
  EXPECT_EQ(s.stiffness(0, 0), 0.5 * (1.0 + 0.00390625));
  EXPECT_EQ(s.stiffness(1, 1), 81.0 + 0.00390625);
  EXPECT_EQ(s.damping(0, 0), 0.0625);
  EXPECT_EQ(s.damping(1, 1), 0.125);
  EXPECT_EQ(test_case.problem.start.u[0], 1.125);
  EXPECT_EQ(test_case.problem.start.u[1], -0.0625);
  EXPECT_EQ(test_case.problem.start.v[0], -0.0625 * 1.125);
  EXPECT_EQ(test_case.problem.start.v[1], 0.0625 * 0.0625);
  const auto other = make("exact-data-pair", {{"m2", 2.0},
                                              {"Omega", 0.5},
                                              {"sigma", 0.25},
                                              {"A_over_X", 0.25},
                                              {"X", 5.0},
                                              {"r", 2.0},
                                              {"eta", 0.5},
                                              {"t_end", 9.0}});
  EXPECT_EQ(other.problem.system.mass(0, 0), 4.0);
  EXPECT_EQ(other.problem.system.stiffness(1, 1), 2.0 * (6.25 + 0.0625));
  EXPECT_EQ(other.problem.start.u[0], 1.25);
  EXPECT_EQ(other.problem.contacts[0].restitution, 0.5);
  EXPECT_EQ(other.motion->end(), 9.0);
}

TEST(Cases, IndicatorsNameTheirThreshold) {
  // X = 9: harmonics up to n = floor(sqrt(81 + 17/eps)/2), 7 for eps = 0.1 and 4 for 0.9.
  const double T = std::numbers::pi / std::sqrt(0.9975);
  const auto usual = make("three-parameter").indicators;
  EXPECT_EQ(constant(usual, "threshold"), 0.1);
  EXPECT_EQ(constant(usual, "I_ms"), 9.0);
  expect_near(constant(usual, "T_L"), T, "T_L");
  expect_near(constant(usual, "T_S"), T / 7.0, "T_S");
  expect_near(constant(usual, "I_OC"), 140.0 / T, "I_OC");
  const auto coarse = make("three-parameter", {}, 0.9).indicators;
  EXPECT_EQ(constant(coarse, "threshold"), 0.9);
  expect_near(constant(coarse, "T_S"), T / 4.0, "T_S");
  // Eq. (11) holds iff eps > (2X-1)/((3X+2)(X+2)) = 17/319.
  const auto words = [](double threshold) {
    for (const auto& c : make("three-parameter", {}, threshold).indicators)
      if (c.name == "T_S") return c.meaning;
    return std::string();
  };
  EXPECT_NE(words(0.0534).find("= 9, holds"), std::string::npos) << words(0.0534);
  EXPECT_NE(words(0.0532).find("= 10, does not hold"), std::string::npos) << words(0.0532);
  EXPECT_EQ(constant(make("stop").indicators, "I_ms"), 1.0);
}

TEST(Cases, SayWhatAnErrorMayBeBlamedOn) {
  const auto find = [](const Case& test_case, std::string_view name) -> const Quantity* {
    for (const auto& c : test_case.constants)
      if (c.name == name) return &c;
    return nullptr;
  };
  const auto fragile = make("three-parameter");
  EXPECT_EQ(constant(fragile.constants, "perturbation_growth"), 1.0);
  expect_near(constant(fragile.constants, "detuning_rate"), 1.5 * std::numbers::pi, "lambda");
  const auto neutral = make("synchronized-pair", {{"r", 0.5}});
  EXPECT_EQ(constant(neutral.constants, "perturbation_growth"), 1.0);
  EXPECT_EQ(find(neutral, "detuning_rate"), nullptr);
  const auto growing = make("synchronized-pair", {{"eta", 0.5}});
  EXPECT_EQ(constant(growing.constants, "perturbation_growth"), 2.0);
  expect_near(constant(growing.constants, "detuning_rate"), 1.5 * std::numbers::pi, "lambda");
  EXPECT_TRUE(std::isinf(
      constant(make("symmetric-pair", {{"eta", 0.0}}).constants, "perturbation_growth")));
  // A rigid stop has no common motion that an impact could leave unscaled.
  EXPECT_EQ(constant(make("stop", {{"eta", 0.5}}).constants, "perturbation_growth"), 1.0);
  EXPECT_EQ(find(make("sdof"), "perturbation_growth"), nullptr);
}

TEST(Cases, RefuseUnknownNamesWithASuggestion) {
  EXPECT_EQ(refusal("three-paramter", {}),
            "clackers: no case \"three-paramter\". Did you mean \"three-parameter\"? All names: "
            "clackers list cases [unknown-name]");
  EXPECT_EQ(refusal("three-parameter", {{"xi", 0.1}}),
            "clackers: no parameter of three-parameter \"xi\". Did you mean \"xi1\"? All names: N, "
            "xi1, a_t (clackers show three-parameter) [unknown-name]");
  EXPECT_EQ(refusal("one-parameter", {{"xi1", 0.1}}).find("no parameter of one-parameter \"xi1\""),
            10u);
  EXPECT_THROW(entry("nothing"), InputError);
  EXPECT_EQ(entry("stop").name, "stop");
}

TEST(Cases, RefuseAParameterThatIsSetTwice) {
  EXPECT_EQ(refusal("stop", {{"eta", 1.0}, {"eta", 0.5}}),
            "stop: eta = 0.5; allowed: each parameter once. It was set twice. [bad-syntax]");
}

TEST(Cases, RefuseAnNThatIsNoCount) {
  const std::string rule = "allowed: a whole number, 0 <= N <= 249999999.";
  for (const auto* name : {"one-parameter", "two-parameter", "three-parameter"}) {
    const std::string who = name;
    EXPECT_EQ(refusal(name, {{"N", -1.0}}),
              who + ": N = -1; " + rule +
                  " Mass 2 is X = 4N + 1 times as fast as mass 1. [out-of-range]");
    EXPECT_EQ(refusal(name, {{"N", 2.5}}),
              who + ": N = 2.5; " + rule +
                  " Only with X = 4N + 1 odd both masses pass equilibrium together at every "
                  "impact. [not-whole]");
    EXPECT_EQ(refusal(name, {{"N", 25e7}}), who + ": N = 250000000; " + rule + " [out-of-range]");
    EXPECT_EQ(refusal(name, {{"N", NAN}}), who + ": N = nan; " + rule + " [not-a-number]");
    EXPECT_EQ(refusal(name, {{"N", INFINITY}}), who + ": N = inf; " + rule + " [not-finite]");
    EXPECT_EQ(refusal(name, {{"N", 249'999'999.0}}), "accepted");
  }
}

TEST(Cases, RefuseEveryParameterOutsideItsRangeNamingTheCase) {
  for (const auto& entry : entries())
    for (const auto& parameter : entry.parameters) {
      if (!parameter.words.empty()) continue;
      for (const double bad : {-1.0, double(NAN), double(INFINITY), -double(INFINITY)}) {
        // Displacements and accelerations have both signs.
        const bool is_signed =
            parameter.allowed.starts_with('-') || parameter.allowed.find('|') != std::string::npos;
        if (bad == -1.0 && is_signed) continue;
        const auto text = refusal(entry.name, {{parameter.name, bad}});
        const auto start = entry.name + ": " + parameter.name + " = ";
        EXPECT_EQ(text.substr(0, start.size()), start) << text;
        EXPECT_NE(text.find("; allowed: "), std::string::npos) << text;
        const auto code = std::isnan(bad)   ? "[not-a-number]"
                          : std::isinf(bad) ? "[not-finite]"
                                            : "[out-of-range]";
        EXPECT_NE(text.find(code), std::string::npos) << text;
      }
    }
}

TEST(Cases, RefuseWhatLiesJustOutside) {
  EXPECT_EQ(refusal("three-parameter", {{"a_t", 0.0}}),
            "three-parameter: a_t = 0; allowed: 0 < a_t < infinity. [out-of-range]");
  for (const auto* name : {"sdof", "stop", "symmetric-pair", "two-parameter", "three-parameter",
                           "synchronized-pair"}) {
    const auto text = refusal(name, {{"xi1", 1.0}});
    EXPECT_EQ(text.find(std::string(name) + ": xi1 = 1; allowed: 0 or 1e-60 <= xi1 < 1."), 0u)
        << text;
    EXPECT_EQ(refusal(name, {{"xi1", 0.0}}), "accepted") << name;
  }
  for (const auto* name : {"stop", "symmetric-pair", "synchronized-pair", "exact-data-pair"}) {
    const auto text = refusal(name, {{"eta", 1.5}});
    EXPECT_EQ(text.find(std::string(name) + ": eta = 1.5; allowed: 0 <= eta <= 1."), 0u) << text;
    EXPECT_EQ(refusal(name, {{"eta", 0.0}}), "accepted") << name;
    EXPECT_EQ(refusal(name, {{"t_end", 0.0}})
                  .find(std::string(name) + ": t_end = 0; allowed: 0 < t_end < infinity."),
              0u);
  }
  EXPECT_NE(refusal("synchronized-pair", {{"X", 8.0}}).find("[not-odd]"), std::string::npos);
  EXPECT_NE(refusal("exact-data-pair", {{"X", 1.0 / 3.0}}).find("[not-odd]"), std::string::npos);
  EXPECT_NE(refusal("exact-data-pair", {{"r", 0.3}}).find("[not-exact-data]"), std::string::npos);
}

TEST(Cases, RefuseAMassRatioBeyondItsLimitAndSayWhatWouldHappen) {
  const auto text = refusal("synchronized-pair", {{"r", 5.0}});
  EXPECT_EQ(text.find("synchronized-pair: r = 5; allowed: 0 < r < r*(9) = 4.41367"), 0u) << text;
  EXPECT_NE(text.find(" at t = "), std::string::npos);
  EXPECT_NE(text.find("[not-admissible]"), std::string::npos);
}

TEST(Cases, RefuseAThresholdThatIsNoShare) {
  for (const auto* name : {"sdof", "three-parameter"})
    for (const double threshold : {0.0, 1.0, -0.1})
      EXPECT_NE(refusal(name, {}, threshold).find("[out-of-range]"), std::string::npos);
  EXPECT_EQ(
      refusal("stop", {}, NAN),
      "stop: threshold = nan; allowed: 0 < threshold < 1. It is the share of the spectral peak "
      "from which a harmonic counts. [not-a-number]");
}

TEST(Admissibility, IsKnownOnBothSidesOfTheLimit) {
  // r*(3) = 3 exactly, admissibility.md. 1 - r/3 is rounded twice.
  EXPECT_EQ(admissibility(3.0, 1.5).r_star, 3.0);
  EXPECT_NEAR(admissibility(3.0, 1.5).margin, 0.5, 2e-16);
  EXPECT_NEAR(admissibility(3.0, 6.0).margin, -1.0, 4e-16);
  EXPECT_EQ(admissibility(3.0, 3.0).margin, 0.0);
}

TEST(Admissibility, ExchangedRolesTakeTheInverseMassRatio) {
  EXPECT_EQ(admissibility(1.0 / 3.0, 0.5).r_star, 3.0);
  EXPECT_NEAR(admissibility(1.0 / 3.0, 0.5).margin, 1.0 / 3.0, 2e-16);
  EXPECT_NEAR(admissibility(1.0 / 3.0, 0.25).margin, -1.0 / 3.0, 3e-16);
}

TEST(Admissibility, EqualFrequenciesHaveNoLimit) {
  EXPECT_EQ(admissibility(1.0, 7.0).r_star, HUGE_VAL);
  EXPECT_EQ(admissibility(1.0, 7.0).margin, 8.0);
}

TEST(Admissibility, IsRefusedOutsideTheClass) {
  for (const double X : {2.0, 0.4, 0.0, -3.0, double(NAN), double(INFINITY)})
    EXPECT_THROW(admissibility(X, 1.0), InputError) << "X = " << X;
  for (const double r : {0.0, -1.0, 1e61, double(NAN), double(INFINITY)})
    EXPECT_THROW(admissibility(3.0, r), InputError) << "r = " << r;
}

TEST(Piecewise, ReadsTheExampleOrAFileAsShowWritesIt) {
  const auto example = make("piecewise");
  EXPECT_GT(example.motion->impact_count(20.0), 3);
  const auto path = testing::TempDir() + "clackers_case_test.json";
  write_file(path, model::problem_json(example.problem));
  const auto again = make("piecewise", {{"problem", path}});
  EXPECT_EQ(again.problem.system.stiffness, example.problem.system.stiffness);
  EXPECT_EQ(again.motion->impact_count(20.0), example.motion->impact_count(20.0));
  EXPECT_REFUSED(make("piecewise", {{"problem", "/no/such.toml"}}), "cannot-read", "/no/such.toml",
                 "TOML");
}

}  // namespace
}  // namespace clackers::cases
