#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <regex>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/numerics/linear_algebra.hpp"

// Random systems at the limits of what double precision decides, beside a simulation of 90 digits.
namespace clackers::exact {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Side;
using testing_oracle::Box;
using testing_oracle::Real;
using testing_oracle::TaylorSimulator;
using testing_oracle::trials;

model::ImpactProblem<> random_system(Box& box) {
  const auto n = Eigen::Index(std::floor(box.uniform(1.0, 7.0)));
  const auto product = [&](double size) {
    MatrixXd x(n, n);
    for (auto& entry : x.reshaped()) entry = box.uniform(-size, size);
    return MatrixXd(x * x.transpose());
  };
  model::ImpactProblem<> problem;
  problem.system.mass = MatrixXd::Identity(n, n);
  if (box.one_in(2)) problem.system.mass += product(0.4);
  problem.system.stiffness = product(1.5) + MatrixXd::Identity(n, n);
  problem.system.damping = box.one_in(3) ? product(0.3) : MatrixXd(0.05 * problem.system.mass);
  problem.start = {0.0, VectorXd::Zero(n), VectorXd::Zero(n)};
  for (auto& v : problem.start.v) v = box.uniform(-1.0, 1.0);
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(n, 3); ++i) {
    auto contact = i + 1 < n ? model::contact_between(n, i, i + 1, box.uniform(0.5, 1.0))
                             : model::Contact<>{VectorXd::Unit(n, i), 0.0, box.uniform(0.5, 1.0)};
    contact.gap = box.uniform(-0.5, -0.1);
    problem.contacts.push_back(contact);
  }
  if (box.one_in(3))
    problem.system.add_load = model::HarmonicLoad(
        {{0, box.uniform(-0.5, 0.5), box.one_in(3) ? 0.0 : box.uniform(0.3, 3.0), 1.0}});
  problem.end = 6.0;
  return problem;
}

// A stop that one mass touches at its lowest point, or that it reaches at an impact of others, but for 1e-8 to
// 1e-17 m. False where there is no such point.
bool add_limit(model::ImpactProblem<>& problem, Box& box, bool at_impact) {
  const PiecewiseMotion motion(problem);
  const VectorXd b =
      VectorXd::Unit(problem.dof(), Eigen::Index(box.uniform(0.0, double(problem.dof())))) *
      (box.one_in(2) ? 1.0 : -1.0);
  const auto value = [&](double t) { return b.dot(motion.at(t, Side::left).u); };
  for (const auto& contact : problem.contacts)
    if (contact.direction.normalized() == b) return false;
  double t = 0.0;
  if (at_impact) {
    const auto count = motion.impact_count(problem.end);
    if (count == 0) return false;
    t = motion.impact(1 + (long long)(box.uniform(0.0, double(count)))).t;
    if (!(b.dot(motion.at(t, Side::left).v) < -1e-3)) return false;
    for (int i = 0; i < 400; ++i)
      if (t * i / 400.0 < t - 0.02 && value(t * i / 400.0) < value(t) + 1e-3) return false;
  } else {
    for (int i = 1; i < 400; ++i)
      if (value(problem.end * i / 400.0) < value(t)) t = problem.end * i / 400.0;
    double lo = t - problem.end / 400.0, hi = t + problem.end / 400.0;
    if (t == 0.0 || hi > problem.end) return false;
    for (int i = 0; i < 80; ++i) {
      const double a = lo + (hi - lo) / 3.0, c = hi - (hi - lo) / 3.0;
      (value(a) < value(c) ? hi : lo) = value(a) < value(c) ? c : a;
    }
    t = 0.5 * (lo + hi);
  }
  const double distance = (box.one_in(2) ? 1.0 : -1.0) * box.decades(-17.0, -8.0);
  problem.contacts.push_back({b, value(t) + distance, box.uniform(0.5, 1.0)});
  return b.dot(problem.start.u) > problem.contacts.back().gap;
}

struct Counts {
  int accepted = 0, values = 0;
  double worst = 0.0;
  std::map<std::string, int> refused;
};

void follow(const PiecewiseMotion& motion, TaylorSimulator simulator, Counts& tally) {
  long long k = 0;
  for (double t = 0.6; t <= motion.end(); t += 0.6) {
    while (const auto found = simulator.next(t)) {
      if (!motion.closed_contacts().empty()) continue;
      ASSERT_GE(motion.impact_count(motion.end()), ++k);
      const auto hit = motion.impact(k);
      // Contacts that do not act on each other may share a double.
      if (hit.contact != found->contact) {
        const bool is_shared =
            (k > 1 && motion.impact(k - 1).t == hit.t) ||
            (k < motion.impact_count(motion.end()) && motion.impact(k + 1).t == hit.t);
        EXPECT_TRUE(is_shared) << hit.t;
      }
      EXPECT_TRUE(Real(hit.when.lo) <= found->t && found->t <= Real(hit.when.hi)) << hit.t;
    }
    if (motion.closed_contacts().empty()) {
      EXPECT_EQ(motion.impact_count(t), k);
    }
    const auto x = simulator.at(t);
    const auto state = motion.at(t, Side::right), bound = motion.error_bound(t);
    const auto compare = [&](const testing_oracle::RealVector& known, const VectorXd& given,
                             const VectorXd& allowed) {
      for (Eigen::Index j = 0; j < given.size(); ++j) {
        const double share = double(abs(Real(known[j] - Real(given[j])))) / allowed[j];
        EXPECT_LE(share, 1.0) << "t = " << t;
        tally.worst = std::max(tally.worst, share);
        ++tally.values;
      }
    };
    compare(x.u, state.u, bound.u);
    compare(x.v, state.v, bound.v);
    compare(x.a, state.a, bound.a);
  }
}

// At the time that a refusal names, the contacts that it names are closed or nearly so.
void check_reason(const std::string& text, const model::ImpactProblem<>& problem, Counts& tally) {
  static const std::regex contacts(R"(contacts? (\d+)(?: and (\d+))?)"), time(R"(t = ([-+.e\d]+))");
  std::smatch who, when;
  ASSERT_TRUE(std::regex_search(text, who, contacts) && std::regex_search(text, when, time))
      << text;
  const bool accumulates = text.find("accumulate") != std::string::npos;
  ++tally.refused[accumulates                                ? "accumulate"
                  : text.find("apart") != std::string::npos  ? "coincidence"
                  : text.find("within") != std::string::npos ? "graze"
                                                             : "rest"];
  const double t = std::stod(when[1]);
  if (!(t < 20.0)) return;
  TaylorSimulator simulator(problem);
  const Real until = t - (accumulates ? 1e-5 : 0.0);
  int impacts = 0;
  while (simulator.next(until) && impacts < 300) ++impacts;
  if (impacts == 300) return;
  for (std::size_t i = 1; i <= 2; ++i) {
    if (!who[i].matched) continue;
    const auto& contact = problem.contacts[std::size_t(std::stoi(who[i]) - 1)];
    const double gap = contact.direction.dot(simulator.at(until).u.unaryExpr([](const Real& x) {
      return double(x);
    })) - contact.gap;
    EXPECT_LT(std::abs(gap), 1e-6) << text;
  }
}

TEST(PiecewiseMotion, NearItsLimitsIsTheSimulationOrRefusedWithItsReason) {
  Box box(31);
  Counts tally;
  int members = 0;
  for (int trial = 0; members < trials(6) && trial < 100 * trials(6); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 31, trial " << trial);
    auto problem = random_system(box);
    if (test::refusal_of([&] { PiecewiseMotion{problem}; }) != "accepted") continue;
    if (trial % 5 != 0 && !add_limit(problem, box, trial % 2 == 0)) continue;
    ++members;
    const auto text = test::refusal_of([&] { PiecewiseMotion{problem}; });
    if (text != "accepted") {
      check_reason(text, problem, tally);
      continue;
    }
    ++tally.accepted;
    follow(PiecewiseMotion(problem), TaylorSimulator(problem), tally);
  }
  EXPECT_EQ(members, trials(6));
  for (const auto& [reason, count] : tally.refused) RecordProperty(reason, count);
  RecordProperty("accepted", tally.accepted);
  RecordProperty("values", tally.values);
  RecordProperty("worst", std::to_string(tally.worst));
}

// A load with the frequency of a mode, or that of another structure near to it.
TEST(PiecewiseMotion, AtResonanceIsTheSimulationWithinItsBound) {
  Box box(33);
  Counts tally;
  int members = 0;
  for (int trial = 0; members < trials(12) && trial < 100 * trials(12); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 33, trial " << trial);
    auto problem = random_system(box);
    auto& s = problem.system;
    const auto n = problem.dof();
    s.damping.setZero();
    if (box.one_in(3)) s.damping = box.decades(-12.0, -6.0) * s.stiffness;
    const auto squares = numerics::normal_modes(s.stiffness, s.mass).value().squares;
    const auto mode = Eigen::Index(box.uniform(0.0, double(n)));
    const double apart = box.one_in(3) ? 0.0 : box.decades(-17.0, -5.0);
    s.add_load = model::HarmonicLoad(
        {{0, box.uniform(-0.5, 0.5), std::sqrt(squares[mode]) * (1.0 + apart), 1.0}});
    if (test::refusal_of([&] { PiecewiseMotion{problem}; }) != "accepted") continue;
    ++members;
    const PiecewiseMotion motion(problem);
    follow(motion, TaylorSimulator(problem), tally);
    const double t = motion.end();
    EXPECT_LT(motion.error_bound(t).u.maxCoeff(), 1e-9 * motion.envelope(t).u.maxCoeff());
    EXPECT_LE(motion.at(t, Side::left).u.cwiseAbs().maxCoeff(),
              motion.envelope(t).u.maxCoeff() * (1.0 + 1e-12));
  }
  EXPECT_EQ(members, trials(12));
}

// All of it a beat: its frequency and that of the load, sqrt(2) as a double, differ by rounding.
TEST(PiecewiseMotion, ALoadAtResonanceMovesAMassFromRest) {
  model::ImpactProblem<> problem;
  auto& s = problem.system;
  const double W = std::sqrt(2.0);
  const Real own = sqrt(Real(2)), apart = Real(2) - Real(W) * Real(W);
  s.mass = MatrixXd::Identity(1, 1);
  s.stiffness = 2.0 * s.mass;
  s.damping = MatrixXd::Zero(1, 1);
  s.add_load = model::HarmonicLoad({{0, 1.0, W, 0.0}});
  problem.start = {0.0, VectorXd::Zero(1), VectorXd::Zero(1)};
  problem.end = 1e4;
  problem.contacts = {{VectorXd::Unit(1, 0), -1e5, 0.5}};
  const PiecewiseMotion motion(problem);
  for (const double t : {0.5, 3.0, 20.0, 1e4}) {
    const auto now = motion.at(t, Side::left), bound = motion.error_bound(t),
               most = motion.envelope(t);
    const Real u = (cos(Real(W) * t) - cos(own * t)) / apart,
               v = (own * sin(own * t) - Real(W) * sin(Real(W) * t)) / apart;
    EXPECT_LE(abs(u - now.u[0]), bound.u[0]) << t;
    EXPECT_LE(abs(v - now.v[0]), bound.v[0]) << t;
    EXPECT_LT(bound.u[0], 1e-13 * (1.0 + t * t));
    EXPECT_NEAR(most.u[0], t / (2.0 * W), 1e-12 * t);
    EXPECT_GE(most.v[0], 0.5 * t);
  }
}

// Free chains under their weight, whose stiffness of doubles is not that of a rigid motion but for roundings: all masses fall
// alike. Damped as well, and with dashpots that couple the modes.
TEST(PiecewiseMotion, FreeChainsFallAsTheSimulationWithinBoundsNearRounding) {
  Box box(3);
  for (int trial = 0; trial < trials(40); ++trial) {
    const auto n = Eigen::Index(2 + trial % 7);
    model::ImpactProblem<> problem;
    auto& s = problem.system;
    s.mass = s.damping = s.stiffness = MatrixXd::Zero(n, n);
    std::vector<model::HarmonicForce> weights;
    for (Eigen::Index i = 0; i < n; ++i) {
      s.mass(i, i) = box.uniform(0.5, 3.0);
      weights.push_back({int(i), -9.81 * s.mass(i, i), 0.0, 0.0});
    }
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      const VectorXd apart = VectorXd::Unit(n, i) - VectorXd::Unit(n, i + 1);
      s.stiffness += box.uniform(0.5, 9.0) * apart * apart.transpose();
      if (trial % 3 == 2) s.damping += box.uniform(0.0, 0.3) * apart * apart.transpose();
    }
    if (trial % 3 == 1) s.damping = 0.1 * s.mass;
    s.add_load = model::HarmonicLoad(weights);
    problem.start = {0.0, VectorXd::Zero(n), VectorXd::Zero(n)};
    problem.end = 2.0;
    const PiecewiseMotion motion(problem);
    TaylorSimulator simulator(problem);
    for (const double t : {0.5, 1.0, 2.0}) {
      simulator.next(t);
      const auto known = simulator.at(t);
      const auto now = motion.at(t, Side::left), bound = motion.error_bound(t);
      for (Eigen::Index j = 0; j < n; ++j) {
        EXPECT_LE(abs(known.u[j] - now.u[j]), bound.u[j]) << trial;
        EXPECT_LE(abs(known.v[j] - now.v[j]), bound.v[j]) << trial;
        EXPECT_LE(abs(known.a[j] - now.a[j]), bound.a[j]) << trial;
      }
      EXPECT_LE(bound.u.maxCoeff(), 1e-11 * now.u.cwiseAbs().maxCoeff()) << trial;
    }
    EXPECT_LT(motion.envelope(2.0).u.maxCoeff(), 30.0) << trial;
  }
}

// A free mass under a force that hardly turns: its displacement is the difference of numbers 1e16 times as large.
TEST(PiecewiseMotion, IsRefusedWhereItsBoundIsNotSmallAgainstIt) {
  model::ImpactProblem<> problem;
  problem.system.mass = MatrixXd::Identity(1, 1);
  problem.system.stiffness = problem.system.damping = MatrixXd::Zero(1, 1);
  problem.system.add_load = model::HarmonicLoad({{0, 1.0, 1e-8, 0.0}});
  problem.start = {0.0, VectorXd::Zero(1), VectorXd::Zero(1)};
  problem.end = 1.0;
  EXPECT_REFUSED(PiecewiseMotion(problem), "not-admissible", "t = 1 s", "1 % of that");
  problem.system.add_load = model::HarmonicLoad({{0, 1.0, 1e-4, 0.0}});
  EXPECT_LT(PiecewiseMotion(problem).error_bound(1.0).u[0], 1e-5);
}

}  // namespace
}  // namespace clackers::exact
