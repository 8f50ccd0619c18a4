#include "clackers/exact/certified/digits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/bodies/bar_mesh.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/orbit/cradle.hpp"
#include "clackers/exact/orbit/forced_pair.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/problem_file.hpp"

namespace clackers::certified {
namespace {

using exact::ExactDataPair;
using exact::PairParameters;
using exact::PiecewiseMotion;
using exact::SynchronizedPair;
using model::Side;

#ifdef CLACKERS_HAS_ARB

using exact::testing_oracle::Real;
using exact::testing_oracle::TaylorSimulator;

std::string code_of(const model::Motion& motion, long long digits) {
  try {
    Digits refused(motion, digits);
    return "accepted";
  } catch (const InputError& error) {
    return std::string(error.code().name());
  }
}

Real real(const std::string& text) { return Real(text); }

// m u'' + c u' + k u = 0 of both masses; between the doubles nearest to two impacts the limits there go on.
TEST(Digits, OfACradleObeyItsEquations) {
  const exact::CradleParameters p{.omega2 = 1.75, .xi2 = 0.3};
  const exact::Cradle cradle(p);
  Digits digits(cradle, 60);
  EXPECT_EQ(digits.at(0.0, Side::right).v[1], "0");
  const Real omegas[] = {p.omega1, p.omega2}, dampings[] = {p.xi1, p.xi2};
  for (double t = 0.4; t < 12.0; t += 1.3) {
    const auto now = digits.at(t, Side::right);
    EXPECT_TRUE((now.u[0] == "0") != (now.u[1] == "0"));
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_LE(abs(Real(real(now.a[i]) + 2 * dampings[i] * omegas[i] * real(now.v[i]) +
                         omegas[i] * omegas[i] * real(now.u[i]))),
                Real("1e-57"));
  }
  for (const long long k : {1LL, 2LL, 3LL}) {
    const auto hit = digits.impact(k);
    const double t = cradle.impact(k).t;
    const Real late = Real(t) - real(hit.t);
    EXPECT_EQ(hit.before.v[0], hit.after.v[1]);
    EXPECT_EQ(hit.before.v[1], hit.after.v[0]);
    for (const auto& [side, limit] :
         {std::pair(Side::left, hit.before), std::pair(Side::right, hit.after)}) {
      const auto near = digits.at(t, side);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LE(abs(Real(real(near.u[i]) - late * real(limit.v[i]))), Real("1e-29"));
        EXPECT_LE(abs(Real(real(near.v[i]) - real(limit.v[i]) - late * real(limit.a[i]))),
                  Real("1e-29"));
      }
    }
  }
  const exact::Cradle undamped({.xi1 = 0.0, .xi2 = 0.0});
  EXPECT_EQ(Digits(undamped, 20).at(0.0, Side::right).v[0], "0");
  EXPECT_EQ(real(Digits(undamped, 20).at(0.0, Side::right).u[0]), 1);
}

const Real least("1e-47");

// u'' + 2 sigma u' + (w^2 + sigma^2) u is a harmonic force, and the law holds at both ends of a flight.
TEST(Digits, OfAForcedPairObeyItsEquations) {
  const exact::ForcedPairParameters p;
  const exact::ForcedPair pair(p);
  Digits digits(pair, 50);
  const Real nu = 2 * exact::testing_oracle::pi() * p.n / p.T;
  const Real speeds[] = {p.V1, -p.V1};
  const double offsets[] = {p.D1, p.D2}, frequencies[] = {p.omega1, p.omega2};
  const auto begin = digits.at(2.5, Side::right), end = digits.at(7.5, Side::left);
  const auto hit = digits.impact(2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(abs(real(begin.u[i]) - offsets[i]), least);
    EXPECT_LE(abs(real(end.u[i]) - offsets[i]), least);
    EXPECT_LE(abs(real(begin.v[i]) - speeds[i]), least);
    EXPECT_LE(abs(Real(real(end.v[i]) * p.eta + speeds[i])), least);
    EXPECT_LE(abs(real(hit.before.v[i]) - real(end.v[i])), least);
    EXPECT_LE(abs(real(hit.before.a[i]) - real(end.a[i])), least);
    EXPECT_LE(abs(real(hit.after.a[i]) - real(begin.a[i])), least);
    Real forces[3];
    const double times[] = {3.0, 4.5, 6.25};
    for (int j = 0; j < 3; ++j) {
      const auto now = digits.at(times[j], Side::right);
      forces[j] =
          real(now.a[i]) + 2 * Real(p.sigma1) * real(now.v[i]) +
          (Real(frequencies[i]) * frequencies[i] + Real(p.sigma1) * p.sigma1) * real(now.u[i]);
    }
    // Of such a force three values are linearly dependent.
    const auto sine = [&](int a, int b) { return sin(Real(nu * (times[b] - times[a]))); };
    const Real sum = forces[0] * sine(1, 2) + forces[1] * sine(2, 0) + forces[2] * sine(0, 1);
    EXPECT_LE(abs(sum), least);
  }
  EXPECT_EQ(real(hit.t), Real("7.5"));
  EXPECT_LE(abs(real(hit.impulse) - Real(p.V1) * (1 + 1 / Real(p.eta))), least);
  Real energy = 0;
  for (std::size_t i = 0; i < 2; ++i)
    energy += (speeds[i] * speeds[i] +
               (Real(frequencies[i]) * frequencies[i] + Real(p.sigma1) * p.sigma1) * offsets[i] *
                   offsets[i]) /
              2;
  EXPECT_LE(abs(Real(real(hit.energy_after) - energy)), least);
}

TEST(Digits, OfAPairUnderBaseExcitationObeyItsEquations) {
  const exact::BaseExcitedParameters p;
  const exact::ForcedPair pair(p);
  Digits digits(pair, 50);
  EXPECT_EQ(digits.at(0.0, Side::right).v[0], "0");
  EXPECT_EQ(digits.at(5.0, Side::right).v[1], "0");
  const Real nu = 2 * exact::testing_oracle::pi() * p.n / p.T;
  const auto before = digits.at(3.75, Side::left), after = digits.at(3.75, Side::right);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(abs(real(before.u[i])), least);
    EXPECT_LE(abs(Real(real(before.v[i]) + real(after.v[i]))), least);
    for (const double t : {4.0, 5.5, 6.0}) {
      const auto now = digits.at(t, Side::right);
      const Real w = i == 0 ? p.omega1 : p.omega2;
      EXPECT_LE(
          abs(Real(real(now.a[i]) + w * w * real(now.u[i]) + p.A_g * cos(Real(nu * (t - 3.75))))),
          least);
    }
  }
}

TEST(Digits, AreThoseOfTheFormulaInMpfr) {
  // The oracle has 90 digits; 70 of them are asked, of which the last is rounded.
  for (const auto& p :
       {PairParameters{}, PairParameters{.m1 = 3.0, .k1 = 7.0, .X = 7.0, .eta = 0.7},
        PairParameters{.X = 1.0 / 5.0, .r = 0.5, .t_end = 200.0}}) {
    const SynchronizedPair motion(p);
    const auto oracle = exact::testing_oracle::oracle_of(p);
    Digits digits(motion, 70);
    for (const double t : {0.1, 1.0, 13.37, 19.0}) {
      const auto texts = digits.at(t, Side::right);
      const auto reference = oracle.state(t, Side::right);
      const auto near = [&](const std::string& text, const Real& value) {
        EXPECT_LE(abs(Real(text) / value - 1), Real("5e-70")) << text;
        EXPECT_EQ(text.substr(text.find_first_of("123456789")).find_first_not_of(".0123456789e-+"),
                  std::string::npos);
      };
      for (std::size_t i = 0; i < 2; ++i) {
        near(texts.u[i], reference.u[i]);
        near(texts.v[i], reference.v[i]);
        near(texts.a[i], reference.a[i]);
      }
    }
    for (const long long k : {1LL, 2LL, 6LL}) {
      const auto hit = digits.impact(k);
      EXPECT_LE(abs(Real(hit.t) / oracle.instant(double(k)) - 1), Real("5e-70"));
      EXPECT_EQ(hit.before.u[0], "0");
      const auto around = motion.impact(k);
      EXPECT_DOUBLE_EQ(std::stod(hit.before.v[1]), around.before.v[1]);
      EXPECT_DOUBLE_EQ(std::stod(hit.after.v[0]), around.after.v[0]);
      EXPECT_DOUBLE_EQ(std::stod(hit.impulse), around.impulse);
      EXPECT_DOUBLE_EQ(std::stod(hit.energy_before), around.energy_before);
      EXPECT_DOUBLE_EQ(std::stod(hit.energy_after), around.energy_after);
    }
  }
}

TEST(Digits, OfMoreAndFewerDigitsAreTheSameNumber) {
  const SynchronizedPair motion({.eta = 0.9});
  const auto most = Digits(motion, 1000).at(7.0, Side::right);
  for (const int n : {1, 2, 17, 60, 999}) {
    const auto fewer = Digits(motion, n).at(7.0, Side::right);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_LE(abs(Real(fewer.u[i]) / Real(most.u[i]) - 1), 5 * pow(Real(10), -n) + Real(1e-88));
  }
  EXPECT_EQ(most.u[0].size(), 1000U + (most.u[0][0] == '-' ? 3 : 2));
}

TEST(Digits, TimesReadBackAsTheDoublesTheyAre) {
  const SynchronizedPair motion({});
  EXPECT_EQ(Digits(motion, 30).time(0.1), "0.100000000000000005551115123126");
  EXPECT_EQ(Digits(motion, 3).time(0.1), "0.10000000000000001");
  EXPECT_EQ(Digits(motion, 3).time(0.0), "0");
  for (const double t : {5e-324, 1e-300, 1.0 / 3.0, 12345.678})
    for (const int n : {1, 17, 800})
      EXPECT_EQ(std::strtod(Digits(motion, n).time(t).c_str(), nullptr), t);
}

TEST(Digits, OfValuesHalfwayBetweenTwoNumbersAreRoundedToEven) {
  // u2(0) = -r A/X = -3 0.25/5 = -0.15 and -0.45, no binary fractions.
  const auto start = [](double A) {
    const SynchronizedPair motion({.A = A, .X = 5.0, .r = 3.0});
    return Digits(motion, 1).at(0.0, Side::left).u[1];
  };
  EXPECT_EQ(start(0.25), "-0.2");
  EXPECT_EQ(start(0.75), "-0.4");
  // Without damping impacts are fractions too: v1 = -A Omega = -0.25, energy (1 + 3) 0.25^2/2 =
  // 0.125, impulse 0.5; k1 = 1/25 of m1 makes Omega 0.2 and v1 = -0.25 again, inexactly.
  const SynchronizedPair undamped({.xi1 = 0.0, .A = 0.25});
  const auto hit = Digits(undamped, 1).impact(1);
  EXPECT_EQ(hit.before.v[0], "-0.2");
  EXPECT_EQ(hit.impulse, "0.5");
  EXPECT_EQ(hit.energy_before, "0.1");
  EXPECT_EQ(Digits(undamped, 2).impact(2).energy_before, "0.12");
  const SynchronizedPair slow({.m1 = 25.0, .k1 = 1.0, .xi1 = 0.0, .A = 1.25, .t_end = 200.0});
  EXPECT_EQ(Digits(slow, 1).impact(3).before.v[0], "-0.2");
  const SynchronizedPair lossy({.m1 = 25.0, .xi1 = 0.0, .A = 1.25, .eta = 0.5, .t_end = 200.0});
  EXPECT_EQ(Digits(lossy, 2).impact(2).before.v[0], "-0.12");
}

TEST(Digits, OfImpactsAreToldForEachSide) {
  const SynchronizedPair motion({.eta = 0.5});
  const double t = motion.impact(2).t;
  Digits digits(motion, 20);
  const auto before = digits.at(t, Side::left), after = digits.at(t, Side::right);
  EXPECT_LT(std::stod(before.v[0]), 0.0);
  EXPECT_DOUBLE_EQ(std::stod(after.v[0]), -0.5 * std::stod(before.v[0]));
  EXPECT_DOUBLE_EQ(std::stod(before.v[0]), motion.at(t, Side::left).v[0]);
}

TEST(Digits, AreToldWhereDoublesUnderflow) {
  const SynchronizedPair motion({.xi1 = 0.9, .t_end = 1e6});
  EXPECT_EQ(motion.at(1e6, Side::right).u[0], 0.0);
  const auto text = Digits(motion, 10).at(1e6, Side::right).u[0];
  EXPECT_NE(text.find("e-390"), std::string::npos) << text;  // exp(-9e5) is 10^-390865
}

class Foreign : public model::Motion {
 public:
  int dof() const override { return 1; }
  double end() const override { return 1.0; }
  void sample(std::span<const double>, Side, model::SampleBuffers) const override {}
  model::Kinematics envelope(double) const override { return {}; }
  model::Kinematics error_bound(double) const override { return {}; }
  long long impact_count(double) const override { return 0; }
  model::MotionImpact impact(long long) const override { return {}; }
};

TEST(Digits, RefuseNumbersOfDigitsOutsideTheirRangeAndOtherMotions) {
  const SynchronizedPair motion({});
  for (const long long n : {-1LL, 0LL, 1001LL}) EXPECT_EQ(code_of(motion, n), "out-of-range");
  EXPECT_EQ(code_of(motion, 1), "accepted");
  EXPECT_EQ(code_of(motion, 1000), "accepted");
  EXPECT_EQ(code_of(Foreign(), 20), "no-enclosure");
}

// Three masses with coupled damping, two contacts and a load.
model::ImpactProblem<> chain() {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector3d(1.0, 2.0, 0.7).asDiagonal();
  problem.system.stiffness = Eigen::MatrixXd{{3.0, -1.0, 0.0}, {-1.0, 2.5, -0.8}, {0.0, -0.8, 9.0}};
  problem.system.damping = Eigen::MatrixXd{{0.1, 0.0, 0.0}, {0.0, 0.3, -0.05}, {0.0, -0.05, 0.08}};
  problem.system.add_load = model::HarmonicLoad({{0, 0.4, 1.3, 0.2}, {2, 0.3, 0.0, 0.0}});
  problem.contacts = {model::contact_between(3, 0, 1, 0.8),
                      {Eigen::Vector3d(0.0, 0.0, 1.0), -0.2, 0.9}};
  problem.contacts[0].gap = -0.3;
  problem.start = {0.0, Eigen::Vector3d(0.5, 0.0, 0.1), Eigen::Vector3d(-0.4, 0.9, -1.0)};
  problem.end = 8.0;
  return problem;
}

// A string of four masses, 1.2 kg in all, pulled at one of them above a stop for each.
model::ImpactProblem<> plucked() {
  model::ImpactProblem<> problem;
  problem.system.mass = 0.3 * Eigen::MatrixXd::Identity(4, 4);
  problem.system.damping = Eigen::MatrixXd::Zero(4, 4);
  problem.system.stiffness = 4.0 * Eigen::MatrixXd{{2.0, -1.0, 0.0, 0.0},
                                                   {-1.0, 2.0, -1.0, 0.0},
                                                   {0.0, -1.0, 2.0, -1.0},
                                                   {0.0, 0.0, -1.0, 2.0}};
  for (int i = 0; i < 4; ++i) problem.contacts.push_back({Eigen::VectorXd::Unit(4, i), 0.0, 1.0});
  problem.start = {0.0, Eigen::Vector4d(0.25, 0.5, 0.75, 0.375), Eigen::Vector4d::Zero()};
  problem.end = 4.0;
  return problem;
}

// Three masses in a row above a floor, with plastic contacts: a load presses the lowest down and lifts it again
// while the others fall onto it.
model::ImpactProblem<> stacked(double eta) {
  auto problem = chain();
  problem.system.stiffness(1, 2) = problem.system.stiffness(2, 1) = 0.0;
  problem.system.damping(1, 2) = problem.system.damping(2, 1) = 0.0;
  problem.system.add_load = model::HarmonicLoad(
      {{0, -2.0, 1.7, 0.3}, {1, -1.5, 0.9, 0.0}, {2, -4.0, 2.3, 0.0}, {2, -1.0, 0.0, 0.0}});
  problem.contacts = {{Eigen::Vector3d(0.0, 0.0, 1.0), -0.2, 0.0},
                      {Eigen::Vector3d(0.0, 1.0, -1.0), -0.1, eta},
                      {Eigen::Vector3d(0.7, -0.3, 0.0), -0.4, 0.0}};
  problem.end = 12.0;
  return problem;
}

TEST(Digits, OfAProblemAreThoseOfASimulation) {
  std::ptrdiff_t held = 0, released = 0;
  for (const auto& problem : {chain(), plucked(), stacked(0.9), stacked(0.0)}) {
    const double end = problem.end;
    const PiecewiseMotion motion(problem);
    ASSERT_GE(motion.impact_count(end), 5);
    held += std::ssize(motion.closed_contacts());
    released += std::ranges::count_if(motion.closed_contacts(), &model::ClosedContact::opens);
    Digits digits(motion, 60);
    TaylorSimulator simulator(problem);
    long long k = 0;
    const auto expect_near = [](const std::string& text, const Real& known) {
      EXPECT_LE(abs(Real(text) - known), Real("1e-57") * (1 + abs(known))) << text;
    };
    for (const double t : {0.0, 0.25 * end, 0.5 * end, end}) {
      while (const auto found = simulator.next(t)) {
        const auto hit = digits.impact(++k);
        expect_near(hit.t, found->t);
        expect_near(hit.impulse, found->impulse);
      }
      const auto now = digits.at(t, Side::right);
      const auto known = simulator.at(t);
      for (std::size_t i = 0; i < now.u.size(); ++i) {
        expect_near(now.u[i], known.u[long(i)]);
        expect_near(now.v[i], known.v[long(i)]);
        expect_near(now.a[i], known.a[long(i)]);
      }
    }
    EXPECT_EQ(k, motion.impact_count(end));
  }
  EXPECT_GE(held, 5);
  EXPECT_GE(released, 5);
}

// Doubles put late impacts some units beside their instants; times between the two have the state of the true side, and
// bounds that hold.
TEST(Digits, BesideAnImpactAreThoseOfTheTrueSide) {
  const auto problem = model::problem_from_text(model::example_problem, "example");
  const PiecewiseMotion motion(problem);
  Digits digits(motion, 20);
  TaylorSimulator simulator(problem);
  int between = 0;
  for (long long k = 1; k <= motion.impact_count(problem.end); ++k) {
    auto beside = simulator;
    const auto found = simulator.next(problem.end);
    ASSERT_TRUE(found);
    const double own = motion.impact(k).t, t = double(Real((found->t + Real(own)) / 2));
    if (t == own || abs(found->t - t) < Real(1e-16) * t) continue;
    ++between;
    while (beside.next(t)) {
    }
    const auto known = beside.at(t);
    for (const auto side : {Side::left, Side::right}) {
      const auto now = digits.at(t, side);
      const auto rounded = motion.at(t, side), bound = motion.error_bound(t);
      for (std::size_t i = 0; i < now.v.size(); ++i) {
        EXPECT_LE(abs(Real(now.v[i]) - known.v[long(i)]), Real(1e-18)) << k;
        EXPECT_LE(abs(known.v[long(i)] - rounded.v[long(i)]), bound.v[long(i)]) << k;
      }
    }
  }
  EXPECT_GE(between, 4);
}

TEST(Digits, OfForcesInBalanceAndOfPlacesOfImpactsAre0) {
  const PiecewiseMotion motion(plucked());
  Digits digits(motion, 20);
  const auto start = digits.at(0.0, Side::right);
  EXPECT_EQ(start.a[0], "0");
  EXPECT_EQ(start.a[1], "0");
  EXPECT_NE(start.a[2], "0");
  const auto hit = digits.impact(1);
  const auto mass = std::size_t(motion.impact(1).contact);
  EXPECT_EQ(hit.before.u[mass], "0");
  EXPECT_EQ(hit.after.u[mass], "0");
  EXPECT_EQ(hit.after.v[mass], hit.before.v[mass].substr(1));
}

// Whose flights are long against its periods, and whose impacts are not known well in double precision.
// Series in balls know no modes. The numbers of the bars are not whole, so that their matrices are rounded.
TEST(Digits, OfBarsThatBounceAreWithinTheBoundsOfTheirMotions) {
  const exact::Bar bar{1.1, 0.9, 1.3, 0.7, -1.0}, other{1.7, 1.2, 0.8, 1.1, 0.3};
  for (const auto& meshed :
       {exact::MeshedBars{.bars = {bar}, .gap = 0.25, .end = 3.1},
        exact::MeshedBars{.bars = {bar}, .gap = 0.25, .end = 3.1, .g = 0.37},
        exact::MeshedBars{.bars = {other, bar}, .gap = 0.25, .end = 3.1},
        exact::MeshedBars{.bars = {bar}, .gap = 0.25, .end = 4.3, .clearance = 0.6},
        exact::MeshedBars{.bars = {exact::Bar{1.1, 0.9, 1.3, 0.7}},
        .gap = 0.25,
        .end = 3.1,
        .striker = 2.0,
        .speed = 1.0,
        .is_fixed = true}}) {
    const auto made = exact::bar_mesh(meshed, 9.0, model::NodeMass::massless, 0.0, "bar");
    const PiecewiseMotion motion(made.problem);
    EXPECT_GT(motion.spring_contacts().size(), 0u);
    const double end = meshed.end;
    const auto now = Digits(motion, 20).at(end, Side::right);
    const auto known = motion.at(end, Side::right), bound = motion.error_bound(end);
    EXPECT_LT(bound.u.maxCoeff(), 1e-10);
    for (std::size_t i = 0; i < now.u.size(); ++i) {
      EXPECT_LE(std::abs(double(Real(now.u[i])) - known.u[long(i)]), bound.u[long(i)]);
      EXPECT_LE(std::abs(double(Real(now.v[i])) - known.v[long(i)]), bound.v[long(i)]);
    }
  }
}

// Springs close and open while contacts are held.
TEST(Digits, OfHeldContactsAndSpringsAreWithinTheBoundsOfTheirMotion) {
  auto problem = stacked(0.9);
  problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
      std::vector<model::Contact<>>{{Eigen::Vector3d(1.0, 0.0, 0.0), -0.1, 1.0}}, std::vector{3.0});
  const PiecewiseMotion motion(problem);
  EXPECT_GT(motion.spring_contacts().size(), 1u);
  EXPECT_GT(motion.closed_contacts().size(), 1u);
  Digits digits(motion, 20);
  for (double t = 0.5; t <= problem.end; t += 0.5) {
    const auto now = digits.at(t, Side::right);
    const auto known = motion.at(t, Side::right), bound = motion.error_bound(t);
    for (std::size_t i = 0; i < now.u.size(); ++i) {
      EXPECT_LE(std::abs(double(Real(now.u[i]) - known.u[long(i)])), bound.u[long(i)]);
      EXPECT_LE(std::abs(double(Real(now.v[i]) - known.v[long(i)])), bound.v[long(i)]);
      EXPECT_LE(std::abs(double(Real(now.a[i]) - known.a[long(i)])), bound.a[long(i)]);
    }
  }
}

// The closed form of a mass that meets a spring at its equilibrium: half
// periods of two frequencies.
TEST(Digits, OfSpringsThatCloseAndOpen) {
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = Eigen::MatrixXd::Identity(1, 1);
  problem.system.damping = Eigen::MatrixXd::Zero(1, 1);
  problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
      std::vector<model::Contact<>>{{Eigen::VectorXd::Ones(1), 0.0, 1.0}}, std::vector{8.0});
  problem.start = {0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
  problem.end = 6.0;
  const PiecewiseMotion motion(problem);
  Digits digits(motion, 50);
  const Real pi = exact::testing_oracle::pi();
  // Closed from pi/2 to pi/2 + pi/3, then a free half period.
  const auto at = [&](double t) { return Real(digits.at(t, Side::right).u[0]); };
  EXPECT_LE(abs(at(2.0) + sin(3 * (2 - pi / 2)) / 3), Real("1e-49"));
  EXPECT_LE(abs(at(4.0) - sin(4 - 5 * pi / 6)), Real("1e-49"));
  EXPECT_LE(abs(at(6.0) + sin(3 * (6 - 11 * pi / 6)) / 3), Real("1e-49"));
}

// Series whose steps are short enough for what is fast: a spring and a light mass, and a dashpot.
TEST(Digits, OfFastMassesAreThoseOfTheirClosedForms) {
  const double fast = std::exp2(100.0), t = std::exp2(-103.0);
  const auto digits_of = [&](double mass, double stiffness, double damping, double u, double v) {
    model::ImpactProblem<> problem;
    problem.system.mass = Eigen::MatrixXd::Constant(1, 1, mass);
    problem.system.stiffness = Eigen::MatrixXd::Constant(1, 1, stiffness);
    problem.system.damping = Eigen::MatrixXd::Constant(1, 1, damping);
    problem.start = {0.0, Eigen::VectorXd::Constant(1, u), Eigen::VectorXd::Constant(1, v)};
    problem.end = 2.0 * t;
    const PiecewiseMotion motion(problem);
    const auto now = Digits(motion, 20).at(t, Side::right);
    return std::pair{Real(now.u[0]), Real(now.v[0])};
  };
  const Real eighth = Real(1) / 8, least("5e-21");
  const auto [u, v] = digits_of(1.0 / (fast * fast), 1.0, 0.0, 1.0, 0.0);
  EXPECT_LE(abs(u - cos(eighth)), least);
  EXPECT_LE(abs(v / fast + sin(eighth)), least);
  const auto [w, slowed] = digits_of(1.0, 0.0, fast, 0.0, 1.0);
  EXPECT_LE(abs(w * fast - (1 - exp(-eighth))), 10 * least);
  EXPECT_LE(abs(slowed - exp(-eighth)), 10 * least);
}

model::ImpactProblem<> pressed_masses(const Eigen::VectorXd& mass, double gap, double force) {
  const auto n = mass.size();
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = mass.asDiagonal();
  problem.system.damping = Eigen::MatrixXd::Zero(n, n);
  std::vector<model::HarmonicForce> forces;
  for (int i = 0; i < n; ++i) {
    problem.contacts.push_back({Eigen::VectorXd::Unit(n, i), gap, 0.5});
    forces.push_back({i, force, 0.0, 0.0});
  }
  problem.system.add_load = model::HarmonicLoad(forces);
  problem.start = {0.0, Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n)};
  problem.end = 10.0;
  return problem;
}

TEST(Digits, EnergiesHalfwayBetweenDecimalNumbersAreRoundedToEven) {
  const PiecewiseMotion motion(pressed_masses(Eigen::VectorXd::Ones(1), 0.0, -0.5));
  Digits digits(motion, 20);
  EXPECT_EQ(digits.impact(16).energy_before, "9.3132257461547851562e-10");  // 2^-30
  EXPECT_EQ(digits.impact(16).energy_after, "2.3283064365386962891e-10");   // 2^-32
}

TEST(Digits, RefusalsNameTheirReason) {
  const PiecewiseMotion rests(pressed_masses(Eigen::VectorXd::Ones(1), 0.0, -0.5)),
      meets(pressed_masses(Eigen::Vector2d(1.0, 2.0), 0.5, 0.0));
  EXPECT_REFUSED(
      Digits(rests, 20).at(5.75515, model::Side::right), "no-enclosure",
      "digits: impacts accumulate, or a contact closes without a speed; allowed: times before");
  EXPECT_REFUSED(Digits(meets, 20).at(3.0, model::Side::right), "no-enclosure",
                 "digits: contacts close together by chance; allowed: motions of impacts");
}

// After a slow impact the phase of mass 1 has an error of 1e-10; whether it meets mass 2 at the least distance of
// them, within 2e-11, needs the state by balls. Mass 3
// is held all the time.
TEST(PiecewiseMotion, ErrorsThatLeaveAContactUndecidedAreMadeSmaller) {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::MatrixXd::Identity(3, 3);
  problem.system.stiffness = Eigen::Vector3d(1.0, 5.0, 1.0).asDiagonal();
  problem.system.damping = Eigen::MatrixXd::Zero(3, 3);
  problem.system.add_load = model::HarmonicLoad({{2, -1.0, 0.0, 0.0}});
  problem.contacts = {{Eigen::Vector3d(0.0, 0.0, 1.0), 0.0, 0.5},
                      {Eigen::Vector3d(1.0, 0.0, 0.0), 1e-10 - 1.0, 0.5}};
  problem.start = {0.0, Eigen::Vector3d::Zero(), Eigen::Vector3d(-1.0, -3.0, 0.0)};
  problem.end = 6.0;
  const Eigen::Vector3d apart(1.0, -1.0, 0.0);
  const PiecewiseMotion alone(problem);
  EXPECT_GT(alone.error_bound(4.0).v[0], 1e-11);
  const auto slope = [&](double t) { return apart.dot(alone.at(t, Side::right).v); };
  double lo = 2.0, hi = 2.0;
  while (!(slope(lo) < 0.0 && slope(hi) > 0.0)) lo = std::exchange(hi, hi + 0.01);
  for (int halving = 0; halving < 60; ++halving)
    (slope(0.5 * (lo + hi)) < 0.0 ? lo : hi) = 0.5 * (lo + hi);
  const double least = apart.dot(alone.at(lo, Side::right).u);
  for (const double distance : {-2e-11, 2e-11}) {
    problem.contacts.resize(2);
    problem.contacts.push_back({apart, least + distance, 1.0});
    EXPECT_EQ(PiecewiseMotion(problem).impact_count(lo + 0.01), distance > 0.0 ? 2 : 1) << distance;
  }
}

#else

TEST(Digits, AreRefusedInWordsWithoutArb) {
  const SynchronizedPair motion({});
  try {
    Digits digits(motion, 20);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code().name(), "needs-arb");
    EXPECT_NE(std::string(error.what()).find("libflint-arb-dev"), std::string::npos);
  }
}

#endif

}  // namespace
}  // namespace clackers::certified
