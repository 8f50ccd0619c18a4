#include "clackers/exact/flights/piecewise_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <random>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/orbit/cradle.hpp"
#include "clackers/exact/orbit/forced_pair.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/testing/impact_simulator.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Side;
using testing_oracle::Box;
using testing_oracle::RawPair;
using testing_oracle::Real;
using testing_oracle::trials;

// The doubles of the problem, as they stand.
RawPair raw_pair_of(const model::ImpactProblem<>& problem) {
  const auto& s = problem.system;
  RawPair pair{s.mass(0, 0),
               s.mass(1, 1),
               s.stiffness(0, 0),
               s.stiffness(1, 1),
               s.damping(0, 0),
               s.damping(1, 1),
               problem.contacts[0].restitution,
               -Real(problem.contacts[0].gap),
               problem.start.u[0],
               problem.start.u[1],
               problem.start.v[0],
               problem.start.v[1]};
  if (const auto* load = s.add_load.target<model::HarmonicLoad>())
    for (const auto& f : load->forces())
      (f.dof == 0 ? pair.force1 : pair.force2) = {f.amplitude, f.frequency, f.phase};
  return pair;
}

model::ImpactProblem<> random_pair(Box& box) {
  model::ImpactProblem<> problem;
  const auto diagonal = [&](double a, double b) {
    return MatrixXd(Eigen::Vector2d(a, b).asDiagonal());
  };
  const double m1 = box.decades(-1.0, 1.0), m2 = box.decades(-1.0, 1.0);
  const double w1 = box.uniform(0.5, 2.0), w2 = box.uniform(0.5, 6.0);
  problem.system.mass = diagonal(m1, m2);
  problem.system.stiffness = diagonal(m1 * w1 * w1, m2 * w2 * w2);
  problem.system.damping =
      diagonal(box.uniform(0.0, 0.3) * m1 * w1, box.uniform(0.0, 0.3) * m2 * w2);
  problem.contacts = {{Eigen::Vector2d(1.0, -1.0), box.uniform(-0.4, 0.1),
                       box.one_in(3) ? 1.0 : box.uniform(0.6, 1.0)}};
  problem.start = {0.0, Eigen::Vector2d(1.0, box.uniform(-0.5, 0.5)),
                   Eigen::Vector2d(box.uniform(-1.0, 1.0), box.uniform(-1.0, 1.0))};
  problem.end = 12.0;
  if (box.one_in(2))
    problem.system.add_load = model::HarmonicLoad(
        {{0, box.uniform(-1.0, 1.0), box.uniform(0.3, 3.0), box.uniform(0.0, 6.0)},
         {1, box.uniform(-1.0, 1.0), box.one_in(3) ? 0.0 : box.uniform(0.3, 3.0), 0.5}});
  return problem;
}

// The same motion in coordinates q = S^-1 u, in which everything is coupled.
model::ImpactProblem<> seen_through(const MatrixXd& s, const model::ImpactProblem<>& problem) {
  auto seen = problem;
  const auto through = [&](const MatrixXd& x) {
    const MatrixXd y = s.transpose() * x * s;
    return MatrixXd(0.5 * (y + y.transpose()));
  };
  seen.system.mass = through(problem.system.mass);
  seen.system.damping = through(problem.system.damping);
  seen.system.stiffness = through(problem.system.stiffness);
  for (auto& contact : seen.contacts) contact.direction = s.transpose() * contact.direction;
  seen.start.u = s.fullPivLu().solve(problem.start.u);
  seen.start.v = s.fullPivLu().solve(problem.start.v);
  return seen;
}

Real time_of(const testing_oracle::RawPairImpact& impact) { return impact.before.t; }
Real time_of(const testing_oracle::TaylorSimulator::Impact& impact) { return impact.t; }
int contact_of(const testing_oracle::RawPairImpact&) { return 0; }
int contact_of(const testing_oracle::TaylorSimulator::Impact& impact) { return impact.contact; }

Real entry(const std::array<Real, 2>& values, Eigen::Index j) { return values[std::size_t(j)]; }
Real entry(const testing_oracle::RealVector& values, Eigen::Index j) { return values[j]; }

// What a motion showed beside its simulation.
struct Followed {
  int impacts = 0;
  double widest = 0.0;  // bound on u over its envelope
};

// Impacts and states at every `spacing` seconds are those of the simulation within their bounds.
void expect_simulated(const PiecewiseMotion& motion, auto simulator, double spacing,
                      Followed& seen) {
  long long k = 0;
  for (int i = 1; spacing * i <= motion.end(); ++i) {
    const double t = spacing * i;
    while (const auto found = simulator.next(t)) {
      ASSERT_GE(motion.impact_count(motion.end()), ++k);
      const auto hit = motion.impact(k);
      EXPECT_EQ(hit.contact, contact_of(*found));
      EXPECT_TRUE(Real(hit.when.lo) <= time_of(*found) && time_of(*found) <= Real(hit.when.hi));
      EXPECT_LT(hit.when.hi - hit.when.lo, 1e-7);
      const double v_error = motion.error_bound(hit.t).v.cwiseAbs().sum();
      EXPECT_NEAR(hit.impulse, double(found->impulse), 1e-9 * hit.impulse + 4.0 * v_error);
      ++seen.impacts;
    }
    EXPECT_EQ(motion.impact_count(t), k);
    const auto x = simulator.at(t);
    const auto state = motion.at(t, Side::right);
    const auto bound = motion.error_bound(t), size = motion.envelope(0.0);
    for (Eigen::Index j = 0; j < state.u.size(); ++j) {
      EXPECT_LE(abs(Real(entry(x.u, j) - Real(state.u[j]))), Real(bound.u[j]));
      EXPECT_LE(abs(Real(entry(x.v, j) - Real(state.v[j]))), Real(bound.v[j]));
      EXPECT_LE(abs(Real(entry(x.a, j) - Real(state.a[j]))), Real(bound.a[j]));
      seen.widest = std::max(seen.widest, bound.u[j] / size.u[j]);
    }
  }
}

TEST(PiecewiseMotion, IsTheSimulationWithNinetyDigitsWithinItsBound) {
  Box box(21);
  int members = 0;
  Followed seen;
  for (int trial = 0; members < trials(50) && trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 21, trial " << trial);
    const auto problem = random_pair(box);
    const auto text = test::refusal_of([&] { PiecewiseMotion{problem}; });
    if (text != "accepted") continue;
    const PiecewiseMotion motion(problem);
    if (!motion.closed_contacts().empty()) continue;
    ++members;
    expect_simulated(motion, testing_oracle::ImpactSimulator(raw_pair_of(problem)), 0.497, seen);
  }
  EXPECT_GE(members, trials(50));
  EXPECT_GT(seen.impacts, 2 * members);
  // Two-sided: some of these motions amplify errors at each of ten impacts, none by more than 1e4.
  EXPECT_LT(seen.widest, 1e-8);
}

// Two or three masses with dashpots that couple all modes, some overdamped, some with forces.
model::ImpactProblem<> random_dashpots(Box& box) {
  const Eigen::Index n = box.one_in(2) ? 2 : 3;
  const auto product = [&](double size) {
    MatrixXd x(n, n);
    for (auto& entry : x.reshaped()) entry = box.uniform(-size, size);
    return MatrixXd(x * x.transpose());
  };
  model::ImpactProblem<> problem;
  problem.system.mass = product(0.5) + MatrixXd::Identity(n, n);
  problem.system.stiffness = product(2.0) + MatrixXd::Identity(n, n);
  problem.system.damping = product(box.one_in(4) ? 1.5 : 0.4);
  problem.start = {0.0, VectorXd::Zero(n), VectorXd::Zero(n)};
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    auto contact = model::contact_between(n, i, i + 1, box.uniform(0.6, 1.0));
    contact.gap = box.uniform(-0.3, 0.0);
    problem.contacts.push_back(contact);
  }
  for (auto& v : problem.start.v) v = box.uniform(-1.0, 1.0);
  problem.end = 8.0;
  if (box.one_in(2))
    problem.system.add_load = model::HarmonicLoad(
        {{0, box.uniform(-1.0, 1.0), box.uniform(0.3, 3.0), box.uniform(0.0, 6.0)},
         {1, box.uniform(-1.0, 1.0), box.one_in(3) ? 0.0 : box.uniform(0.3, 3.0), 0.5}});
  return problem;
}

TEST(PiecewiseMotion, DashpotsThatCoupleModesMoveAsTheTaylorSeriesSays) {
  Box box(24);
  int members = 0, forced = 0;
  Followed seen;
  for (int trial = 0; members < trials(50) && trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 24, trial " << trial);
    const auto problem = random_dashpots(box);
    const auto text = test::refusal_of([&] { PiecewiseMotion{problem}; });
    if (text != "accepted") continue;
    const PiecewiseMotion motion(problem);
    if (!motion.closed_contacts().empty()) continue;
    ++members;
    forced += problem.system.add_load ? 1 : 0;
    expect_simulated(motion, testing_oracle::TaylorSimulator(problem), 0.797, seen);
  }
  EXPECT_GE(members, trials(50));
  EXPECT_GT(seen.impacts, 2 * members);
  EXPECT_GT(forced, members / 4);
  EXPECT_LT(seen.widest, 1e-8);
}

TEST(PiecewiseMotion, CoupledCoordinatesShowTheSameMotion) {
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  auto problem = SynchronizedPair({.X = 3.0, .r = 0.5, .eta = 0.9}).problem();
  const SynchronizedPair exact({.X = 3.0, .r = 0.5, .eta = 0.9});
  for (int trial = 0; trial < 10; ++trial) {
    MatrixXd s(2, 2);
    for (auto& x : s.reshaped()) x = uniform(random);
    s.diagonal().array() += 1.5;
    const PiecewiseMotion motion(seen_through(s, problem));
    ASSERT_EQ(motion.impact_count(20.0), exact.impact_count(20.0));
    for (int i = 0; i <= 40; ++i) {
      const double t = 0.5 * i;
      const auto bound = motion.error_bound(t);
      // Rounding S'MS itself moves the system: phases of 60 rad by a few 2^-52.
      const VectorXd u = s * motion.at(t, Side::right).u, known = exact.at(t, Side::right).u;
      EXPECT_LT((u - known).cwiseAbs().maxCoeff(), (s.cwiseAbs() * bound.u).maxCoeff() + 1e-12);
      EXPECT_LT(bound.u.maxCoeff(), 1e-11);
    }
  }
}

TEST(PiecewiseMotion, IsTheClosedFormOfCradleAndOrbit) {
  const Cradle cradle{CradleParameters{}};
  // The resting mass touches nothing and the moving one arrives where it rests.
  const PiecewiseMotion rolled(cradle.problem());
  const ForcedPair orbit{ForcedPairParameters{}};
  const PiecewiseMotion forced(orbit.problem());
  const auto compare = [](const PiecewiseMotion& motion, const Flights& form) {
    ASSERT_EQ(motion.impact_count(motion.end()), form.impact_count(form.end()));
    for (double t = 0.1; t < form.end(); t += 0.377) {
      const auto x = motion.at(t, Side::right), y = form.at(t, Side::right);
      EXPECT_LT((x.u - y.u).cwiseAbs().maxCoeff(), 1e-12) << t;
      EXPECT_LT((x.v - y.v).cwiseAbs().maxCoeff(), 1e-12) << t;
    }
    for (long long k = 1; k <= form.impact_count(form.end()); ++k)
      EXPECT_NEAR(motion.impact(k).t, form.impact(k).t, 1e-12);
  };
  compare(rolled, cradle);
  compare(forced, orbit);
}

// Two equal pairs side by side collide at the same instants.
TEST(PiecewiseMotion, SimultaneousContactsActAtOnce) {
  const auto one = SynchronizedPair({.X = 3.0, .r = 2.0}).problem();
  model::ImpactProblem<> both;
  const auto twice = [](const MatrixXd& x) {
    MatrixXd y = MatrixXd::Zero(4, 4);
    y.topLeftCorner(2, 2) = x;
    y.bottomRightCorner(2, 2) = x;
    return y;
  };
  both.system.mass = twice(one.system.mass);
  both.system.damping = twice(one.system.damping);
  both.system.stiffness = twice(one.system.stiffness);
  both.contacts = {{Eigen::Vector4d(1, -1, 0, 0), 0.0, 1.0},
                   {Eigen::Vector4d(0, 0, 1, -1), 0.0, 1.0}};
  both.start.u = Eigen::Vector4d(one.start.u[0], one.start.u[1], one.start.u[0], one.start.u[1]);
  both.start.v = Eigen::Vector4d(one.start.v[0], one.start.v[1], one.start.v[0], one.start.v[1]);
  both.end = 20.0;
  const SynchronizedPair form({.X = 3.0, .r = 2.0});
  const PiecewiseMotion motion(both), single(one);
  ASSERT_EQ(motion.impact_count(20.0), 2 * form.impact_count(20.0));
  for (long long k = 1; k <= 2 * form.impact_count(20.0); ++k) {
    const auto hit = motion.impact(k);
    EXPECT_EQ(hit.contact, (k - 1) % 2);
    EXPECT_NEAR(hit.t, form.impact((k + 1) / 2).t, 1e-12);
    EXPECT_NEAR(hit.impulse, form.impact((k + 1) / 2).impulse, 1e-11);
  }
  const auto a = motion.error_bound(19.0), b = single.error_bound(19.0);
  EXPECT_LT(a.u[0], 4.0 * b.u[0]);  // as large as alone, but for the number of modes
}

// Three masses in a row on soft springs, the outer ones equal, that meet the middle one together.
model::ImpactProblem<> row_of_three(double restitution) {
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = MatrixXd::Identity(3, 3);
  problem.system.damping = 0.1 * MatrixXd::Identity(3, 3);
  problem.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, restitution},
                      {Eigen::Vector3d(0, 1, -1), 0.0, restitution}};
  problem.start = {0.0, Eigen::Vector3d(1, 0, -1), Eigen::Vector3d::Zero()};
  problem.end = 10.0;
  return problem;
}

TEST(PiecewiseMotion, CoupledSimultaneousContactsObeyTheLawOfBoth) {
  const PiecewiseMotion motion(row_of_three(0.7));
  // Modes that start without speed have the amplitude of their displacement.
  EXPECT_NEAR(motion.envelope(0.0).u[0], 1.0, 1e-14);
  EXPECT_NEAR(motion.envelope(0.0).u[1], 0.0, 1e-14);
  EXPECT_NEAR(motion.envelope(0.0).v[2], 1.0, 1e-14);
  ASSERT_EQ(motion.impact_count(10.0), 6);
  for (long long k = 1; k <= 6; ++k) {
    const auto hit = motion.impact(k);
    for (const int c : {0, 1})
      EXPECT_NEAR(hit.after.v[c] - hit.after.v[c + 1],
                  -0.7 * (hit.before.v[c] - hit.before.v[c + 1]), 1e-14);
    EXPECT_NEAR(hit.after.v.sum(), hit.before.v.sum(), 1e-14);
    EXPECT_NEAR(hit.after.v[1], 0.0, 1e-14);
    EXPECT_LT(hit.energy_after, hit.energy_before);
  }
}

TEST(PiecewiseMotion, EnergyFallsByWhatDashpotsAndImpactsTake) {
  Box box(23);
  for (int trial = 0; trial < 10; ++trial) {
    auto problem = random_pair(box);
    problem.system.add_load = {};
    problem.system.damping.setZero();
    if (test::refusal_of([&] { PiecewiseMotion{problem}; }) != "accepted") continue;
    const PiecewiseMotion motion(problem);
    double last = -1.0;
    for (long long k = 1; k <= motion.impact_count(problem.end); ++k) {
      const auto hit = motion.impact(k);
      if (last >= 0.0) {
        EXPECT_NEAR(hit.energy_before, last, 1e-12 * last);
      }
      last = hit.energy_after;
      const double rate = hit.before.v[0] - hit.before.v[1], eta = problem.contacts[0].restitution;
      const double m1 = problem.system.mass(0, 0), m2 = problem.system.mass(1, 1);
      EXPECT_NEAR(hit.energy_before - hit.energy_after,
                  0.5 * m1 * m2 / (m1 + m2) * (1.0 - eta * eta) * rate * rate, 1e-12 * last);
    }
  }
}

TEST(PiecewiseMotion, PlasticImpactAtEquilibriumEndsTheMotion) {
  const PiecewiseMotion motion(RigidStop({0.05, 0.0, 20.0}).problem());
  EXPECT_EQ(motion.impact_count(20.0), 1);
  EXPECT_NEAR(motion.at(15.0, Side::right).u[0], 0.0, 1e-15);
}

model::ImpactProblem<> oscillator(double gap, double restitution, double end) {
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = MatrixXd::Identity(1, 1);
  problem.system.damping = MatrixXd::Zero(1, 1);
  problem.start = {0.0, VectorXd::Ones(1), VectorXd::Zero(1)};
  problem.contacts = {{VectorXd::Ones(1), gap, restitution}};
  problem.end = end;
  return problem;
}

// What an attempt gives: the refusal, or "accepted" if all that it says is that of the simulation.
std::string attempt(const model::ImpactProblem<>& problem, double spacing, Followed& seen) {
  const auto text = test::refusal_of([&] { PiecewiseMotion{problem}; });
  if (text == "accepted")
    expect_simulated(PiecewiseMotion(problem), testing_oracle::TaylorSimulator(problem), spacing,
                     seen);
  return text;
}

TEST(PiecewiseMotion, ShallowContactsAreFoundOrRefused) {
  Followed seen;
  int found = 0, refused = 0;
  for (const double restitution : {1.0, 0.5})
    for (double depth = 1e-9; depth > 1e-17; depth *= 0.3)
      for (const double sign : {1.0, -1.0}) {
        SCOPED_TRACE(testing::Message() << "depth " << sign * depth);
        const auto text = attempt(oscillator(-1.0 + sign * depth, restitution, 5.0), 0.8, seen);
        (text == "accepted" ? found : refused) += 1;
        if (text == "accepted") continue;
        EXPECT_NE(text.find("contact 1 comes within"), std::string::npos) << text;
        EXPECT_LT(depth, 3e-12);
      }
  EXPECT_GT(found, 24);
  EXPECT_GT(refused, 24);
  // A contact of depth 2.7e-16 m at the turning point of the first flight after an impact.
  auto shallow = oscillator(-0.09231148593203226, 0.997017364870426, 6.684766700949665);
  shallow.system.stiffness(0, 0) = 0.9647656647367943;
  shallow.contacts.push_back({-VectorXd::Ones(1), -1.6608973524761357, 0.997017364870426});
  shallow.start.u[0] = 0.5463155786118247;
  shallow.start.v[0] = -1.5457478953216908;
  EXPECT_REFUSED(PiecewiseMotion{shallow}, "not-admissible", "contact 2 comes within",
                 "near t = 2.05246");
}

// Three equal oscillators; contact 2 closes eps before contact 1.
model::ImpactProblem<> near_coincidence(double eps, double restitution) {
  auto problem = row_of_three(restitution);
  problem.system.damping.setZero();
  problem.contacts[1].gap = eps;
  problem.start.u = Eigen::Vector3d(1.0, 0.0, -0.7);
  problem.end = 6.0;
  return problem;
}

TEST(PiecewiseMotion, ImpactsWhoseOrderDecidesAreSeparatedOrRefused) {
  Followed seen;
  int refused = 0;
  for (const double restitution : {1.0, 0.9, 0.5})
    for (double eps = 1e-10; eps > 1e-17; eps *= 0.1)
      for (const double sign : {1.0, -1.0}) {
        SCOPED_TRACE(testing::Message() << "eps " << sign * eps << ", eta " << restitution);
        const auto text = attempt(near_coincidence(sign * eps, restitution), 0.7, seen);
        if (text == "accepted") continue;
        ++refused;
        EXPECT_NE(text.find("contacts 1 and 2 close"), std::string::npos) << text;
        EXPECT_LT(eps, 2e-13);
      }
  EXPECT_GE(refused, 12);
  // Gaps that are the same function of time, each times a number, close at the same instants.
  const PiecewiseMotion together(near_coincidence(0.0, 0.9));
  EXPECT_EQ(together.impact(1).t, together.impact(2).t);
  // So do those that a reflection of the structure exchanges.
  auto row = row_of_three(0.7);
  row.system.stiffness << 2.0, -0.5, 0.0, -0.5, 3.0, -0.5, 0.0, -0.5, 2.0;
  row.contacts[0].gap = row.contacts[1].gap = -0.1;
  const PiecewiseMotion mirrored(row);
  ASSERT_GE(mirrored.impact_count(10.0), 2);
  EXPECT_EQ(mirrored.impact(1).t, mirrored.impact(2).t);
  for (const auto change : {0, 1, 2, 3}) {
    auto other = row;
    if (change == 0) other.start.u[0] += 1e-15;
    if (change == 1) other.system.mass(0, 0) += 0x1p-52;
    if (change == 2) other.contacts[1].restitution += 0x1p-52;
    if (change == 3) other.system.add_load = model::HarmonicLoad({{0, 1e-17, 1.0, 0.0}});
    EXPECT_REFUSED(PiecewiseMotion{other}, "not-admissible", "contacts 1 and 2 close",
                   "the first impact changes the second");
  }
  row.system.add_load = model::HarmonicLoad({{0, 0.1, 1.0, 0.0}, {2, -0.1, 1.0, 0.0}});
  EXPECT_EQ(PiecewiseMotion(row).impact(1).contact, 0);
}

TEST(PiecewiseMotion, ContactsThatDoNotActOnEachOtherKeepTheirOwnTimes) {
  // Two pairs side by side, the second later by less than the error of a slow impact.
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = MatrixXd::Identity(4, 4);
  problem.system.damping = MatrixXd::Zero(4, 4);
  problem.contacts = {{Eigen::Vector4d(1, -1, 0, 0), 0.0, 0.8},
                      {Eigen::Vector4d(0, 0, 1, -1), -1e-15, 0.8}};
  problem.start = {0.0, Eigen::Vector4d(1e-3, 0, 1, 0), Eigen::Vector4d::Zero()};
  problem.end = 6.0;
  Followed seen;
  EXPECT_EQ(attempt(problem, 0.7, seen), "accepted");
  EXPECT_EQ(seen.impacts, 4);
}

TEST(PiecewiseMotion, ABallUnderItsWeightBouncesAsItsParabolas) {
  auto ball = oscillator(0.0, 0.5, 1.1);
  ball.system.stiffness.setZero();
  ball.system.add_load = model::HarmonicLoad({{0, -9.81, 0.0, 0.0}});
  Followed seen;
  EXPECT_EQ(attempt(ball, 0.11, seen), "accepted");
  EXPECT_EQ(seen.impacts, 2);
  const double speed = std::sqrt(2.0 * 9.81);
  EXPECT_NEAR(PiecewiseMotion(ball).impact(1).t, speed / 9.81, 1e-15);
  // It comes to rest at (1 + 2 eta/(1 - eta)) sqrt(2 h/g).
  ball.end = 2.0;
  EXPECT_NEAR(PiecewiseMotion(ball).closed_contacts().at(0).from, 3.0 * speed / 9.81, 1e-12);
  // In air, and on two masses that a spring holds together.
  ball.end = 1.1;
  for (const double damping : {1e-9, 0.02, 0.3}) {
    ball.system.damping(0, 0) = damping;
    EXPECT_EQ(attempt(ball, 0.11, seen), "accepted") << damping;
  }
  auto coupled = row_of_three(0.9);
  coupled.system.stiffness << 3.0, -3.0, 0.0, -3.0, 5.0, -2.0, 0.0, -2.0, 2.0;
  coupled.system.damping.setZero();
  coupled.contacts = {{Eigen::Vector3d(0, 0, 1), -2.0, 0.9}};
  coupled.start.u.setZero();
  coupled.system.add_load =
      model::HarmonicLoad({{0, -1.0, 0.0, 0.0}, {1, -1.0, 0.0, 0.0}, {2, -1.0, 0.0, 0.5}});
  coupled.end = 3.5;
  EXPECT_EQ(attempt(coupled, 0.3, seen), "accepted");
}

TEST(PiecewiseMotion, AContactThatOpensUnderTheLoadOfTheStart) {
  auto pressed = oscillator(0.5, 0.5, 30.0);
  pressed.start.u[0] = 0.5;
  pressed.system.add_load = model::HarmonicLoad({{0, 1.0, 0.0, 0.0}});
  pressed.end = 5.0;
  Followed seen;
  EXPECT_EQ(attempt(pressed, 0.9, seen), "accepted");
}

TEST(PiecewiseMotion, MotionsThatItDoesNotHaveAreRefused) {
  auto problem = SynchronizedPair({.X = 3.0, .r = 0.5}).problem();
  const auto with = [&](auto change) {
    auto other = problem;
    change(other);
    return other;
  };
  using P = model::ImpactProblem<>;
  const auto refused = [](const P& p) { return PiecewiseMotion{p}; };
  EXPECT_REFUSED(refused(with([](P& p) { p.system.stiffness(0, 0) = -1.0; })),
                 "not-positive-definite", "the stiffness matrix has the eigenvalue -1");
  EXPECT_REFUSED(refused(with([](P& p) { p.system.damping(0, 0) = -0.1; })),
                 "not-positive-definite", "the damping matrix has the eigenvalue -0.1",
                 "energy in");
  // Its first-order equations have the characteristic polynomial (s^2 + 1.8 s + 2)^2 and one
  // eigenvector a pair.
  EXPECT_REFUSED(refused(with([](P& p) {
                   p.system.mass.setIdentity();
                   p.system.stiffness << 1.0, 0.0, 0.0, 4.0;
                   p.system.damping << 1.2, 0.8, 0.8, 2.4;
                 })),
                 "out-of-range", "that the damping couples", "sums of modes");
  EXPECT_REFUSED(refused(with([](P& p) { p.system.add_load = [](double, std::span<double>) {}; })),
                 "linear-only", "harmonic loads");
  EXPECT_REFUSED(refused(with([](P& p) { p.start.t = 1.0; })), "out-of-range", "start = 1");
  EXPECT_REFUSED(refused(with([](P& p) {
                   p.contacts.push_back(p.contacts[0]);
                   p.contacts[1].direction *= 2.0;
                 })),
                 "redundant-contacts", "contacts 1 and 2 have the same direction");
  // A contact whose direction is the sum of two others, all three closed.
  auto row = row_of_three(1.0);
  row.contacts.push_back({Eigen::Vector3d(1, 0, -1), 0.0, 1.0});
  EXPECT_REFUSED(refused(row), "redundant-contacts", "contact 3", "depends linearly");
  // The other side of a graze: mass 1 comes down to the gap exactly.
  auto graze = oscillator(-1.0, 1.0, 5.0);
  EXPECT_REFUSED(refused(graze), "not-admissible", "contact 1");
  graze.contacts[0].gap = -1.0 - 1e-10;
  EXPECT_EQ(refused(graze).impact_count(5.0), 0);
  graze.contacts[0].gap = -1.0 + 1e-10;
  EXPECT_EQ(refused(graze).impact_count(5.0), 1);
  EXPECT_REFUSED(refused(problem).at(-1.0, Side::left), "time-outside", "t = -1");
  EXPECT_REFUSED(refused(problem).impact(99), "beyond-last-impact", "impact 99");
}

}  // namespace
}  // namespace clackers::exact
