#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/testing/taylor_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/problem_file.hpp"

// Contacts that stay closed: closed forms and a simulation of 90 digits, within the bound.
namespace clackers::exact {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Side;
using testing_oracle::Box;
using testing_oracle::Real;
using testing_oracle::TaylorSimulator;
using testing_oracle::trials;

struct Tally {
  int members = 0, values = 0, rests = 0, releases = 0;
  double worst = 0.0;
  void compare(const Real& known, double given, double allowed, double t) {
    ++values;
    if (abs(Real(known - Real(given))) < Real(1e-30)) return;
    const double share = double(abs(Real(known - Real(given)))) / allowed;
    EXPECT_LE(share, 1.0) << "t = " << t << ", off by " << share * allowed;
    worst = std::max(worst, share);
  }
  void record() const {
    testing::Test::RecordProperty("members", members);
    testing::Test::RecordProperty("values", values);
    testing::Test::RecordProperty("worst", std::to_string(worst));
    testing::Test::RecordProperty("rests", rests);
    testing::Test::RecordProperty("releases", releases);
  }
};

struct Exact {
  Real u, v, a;
};

void compare(const PiecewiseMotion& motion, double t, Eigen::Index mass, const Exact& known,
             Tally& tally) {
  const auto state = motion.at(t, Side::right), bound = motion.error_bound(t);
  tally.compare(known.u, state.u[mass], bound.u[mass], t);
  tally.compare(known.v, state.v[mass], bound.v[mass], t);
  tally.compare(known.a, state.a[mass], bound.a[mass], t);
}

/// m a + k u = -f above u = 0, from `u` at rest: flights return with the speed they left with.
class PressedMass {
 public:
  PressedMass(double m, double k, double f, double u, double eta)
      : k_(Real(k) / m), g_(Real(f) / m), u_(u) {
    omega_ = sqrt(k_);
    // w^2 u0^2 + 2 g u0 = V^2, and the fall takes atan2 of it.
    Real speed = sqrt(k_ * u_ * u_ + 2 * g_ * u_);
    Real t = k_ == 0 ? Real(speed / g_) : Real(atan(Real(omega_ * speed / g_)) / omega_);
    for (speed *= eta; speed > Real(1e-45); speed *= eta) {
      impacts_.push_back({t, speed});
      t += k_ == 0 ? Real(2 * speed / g_) : Real(2 * atan(Real(omega_ * speed / g_)) / omega_);
    }
    rest_ = t;
  }
  const Real& rest() const { return rest_; }
  Exact at(const Real& t) const {
    if (t >= rest_) return {0, 0, 0};
    const auto after = std::ranges::upper_bound(impacts_, t, {}, &Impact::t);
    // From the top of the first fall, or from an impact.
    const bool falls = after == impacts_.begin();
    const Real s = falls ? t : Real(t - (after - 1)->t), start = falls ? u_ : Real(0),
               speed = falls ? Real(0) : (after - 1)->speed;
    if (k_ == 0) return {start + s * (speed - g_ * s / 2), speed - g_ * s, -g_};
    const Real c = cos(omega_ * s), n = sin(omega_ * s) / omega_, middle = g_ / k_;
    const Real u = (start + middle) * c + speed * n - middle;
    return {u, speed * c - k_ * (start + middle) * n, -k_ * u - g_};
  }

 private:
  struct Impact {
    Real t, speed;
  };
  Real k_, g_, u_, omega_, rest_;
  std::vector<Impact> impacts_;
};

model::ImpactProblem<> pressed_mass(double m, double k, double f, double u, double eta) {
  model::ImpactProblem<> problem;
  const auto number = [](double x) { return MatrixXd::Constant(1, 1, x); };
  problem.system.mass = number(m);
  problem.system.stiffness = number(k);
  problem.system.damping = number(0.0);
  problem.system.add_load = model::HarmonicLoad({{0, -f, 0.0, 0.0}});
  problem.contacts = {{VectorXd::Ones(1), 0.0, eta}};
  problem.start = {0.0, VectorXd::Constant(1, u), VectorXd::Zero(1)};
  return problem;
}

TEST(RestingContacts, ABallAndAPressedOscillatorComeToRestAsTheirFormulasSay) {
  Box box(41);
  Tally tally;
  for (int trial = 0; trial < trials(40); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 41, trial " << trial);
    const double m = box.decades(-1.0, 1.0), f = m * box.decades(-0.5, 1.0),
                 k = trial % 2 == 0 ? 0.0 : m * box.decades(-1.0, 1.0), u = box.decades(-1.0, 0.5),
                 eta = trial % 8 == 7 ? 0.0 : box.uniform(0.02, 0.9);
    SCOPED_TRACE(testing::Message() << std::hexfloat << "m " << m << " k " << k << " f " << f
                                    << " u " << u << " eta " << eta);
    const PressedMass known(m, k, f, u, eta);
    auto problem = pressed_mass(m, k, f, u, eta);
    const double rest = double(known.rest());
    problem.end = 1.5 * rest;
    const PiecewiseMotion motion(problem);
    ++tally.members;
    ASSERT_EQ(motion.closed_contacts().size(), 1u);
    const auto closed = motion.closed_contacts()[0];
    EXPECT_EQ(closed.accumulates, eta > 0.0);
    EXPECT_FALSE(closed.opens);
    EXPECT_TRUE(Real(closed.begins.lo) <= known.rest() && known.rest() <= Real(closed.begins.hi));
    EXPECT_LT(closed.begins.hi - closed.begins.lo, 2e-3 * rest);
    EXPECT_NEAR(closed.from, rest, 1e-6 * rest);
    for (int i = 0; i < 8; ++i) {
      const double t = box.uniform(0.0, problem.end);
      compare(motion, t, 0, known.at(t), tally);
    }
    for (double before = 1e-1; before > 5e-13; before *= 0.1)
      for (const double t : {rest - before * rest, rest + before * rest})
        compare(motion, t, 0, known.at(t), tally);
    EXPECT_NEAR(motion.contact_forces(problem.end, Side::right)[0], f, 1e-12 * f);
    EXPECT_EQ(motion.contact_forces(0.0, Side::right)[0], 0.0);
    EXPECT_LT(motion.error_bound(problem.end).v[0], 1e-13);
  }
  tally.record();
}

// Two masses that nothing joins; of every other trial the second moves as the first, or nearly so.
TEST(RestingContacts, ContactsOfMassesThatNothingJoinsAccumulateTogether) {
  Box box(43);
  Tally tally;
  for (int trial = 0; trial < trials(250); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 43, trial " << trial);
    std::vector<PressedMass> known;
    model::ImpactProblem<> problem;
    problem.system.mass = problem.system.stiffness = problem.system.damping = MatrixXd::Zero(2, 2);
    problem.start = {0.0, VectorXd::Zero(2), VectorXd::Zero(2)};
    std::vector<model::HarmonicForce> forces;
    double m = 0.0, g = 0.0, k = 0.0, u = 0.0, eta = 0.0, rest = 0.0;
    for (int mass = 0; mass < 2; ++mass) {
      m = box.decades(-1.0, 1.0);
      if (mass == 0 || trial % 2 == 0) {
        g = box.decades(-0.5, 1.0);
        k = trial % 3 == 0 ? 0.0 : box.decades(-1.0, 1.0);
        u = box.decades(-1.0, 0.5);
        eta = box.uniform(0.02, trial % 8 == 3 ? 0.04 : 0.9);
      } else if (trial % 4 == 1) {
        u *= 1.0 + box.decades(-12.0, -2.0);
      } else {
        m = problem.system.mass(0, 0);
      }
      const PressedMass single(m, m * k, m * g, u, eta);
      rest = std::max(rest, double(single.rest()));
      known.push_back(single);
      problem.system.mass(mass, mass) = m;
      problem.system.stiffness(mass, mass) = m * k;
      forces.push_back({mass, -m * g, 0.0, 0.0});
      problem.contacts.push_back({VectorXd::Unit(2, mass), 0.0, eta});
      problem.start.u[mass] = u;
    }
    problem.system.add_load = model::HarmonicLoad(forces);
    problem.end = 1.5 * rest;
    const PiecewiseMotion motion(problem);
    ++tally.members;
    EXPECT_LT(motion.error_bound(0.0).v.maxCoeff(), 1e-12);
    ASSERT_EQ(motion.closed_contacts().size(), 2u);
    for (const auto& closed : motion.closed_contacts()) {
      const Real& its_rest = known[std::size_t(closed.contact)].rest();
      EXPECT_TRUE(closed.accumulates);
      EXPECT_TRUE(Real(closed.begins.lo) <= its_rest && its_rest <= Real(closed.begins.hi));
      EXPECT_LT(closed.begins.hi - closed.begins.lo, 2e-3 * rest);
    }
    std::vector<double> times;
    for (int i = 0; i < 8; ++i) times.push_back(box.uniform(0.0, problem.end));
    for (const auto& single : known)
      for (double before = 1e-1; before > 5e-13; before *= 0.1)
        for (const double sign : {-1.0, 1.0})
          times.push_back(double(single.rest()) + sign * before * rest);
    for (const double t : times)
      if (t >= 0.0 && t <= problem.end)
        for (Eigen::Index mass = 0; mass < 2; ++mass)
          compare(motion, t, mass, known[std::size_t(mass)].at(t), tally);
  }
  tally.record();
}

// Flights of a damped ball, summed with 60 digits by another program. With the term of second order
// subtracted the motion rests 2.8e-13 s and 9e-14 s later.
TEST(RestingContacts, ADampedBallRestsAtTheSumOfItsFlights) {
  struct Ball {
    double c, f, eta, u, rest;
  };
  for (const auto& [c, f, eta, u, rest] : {Ball{100.0, 10.0, 0.5, 0.1, 1.025432217727331339},
                                           Ball{10.0, 10.0, 0.8, 0.1, 0.539387811278469080}}) {
    auto problem = pressed_mass(1.0, 0.0, f, u, eta);
    problem.system.damping = MatrixXd::Constant(1, 1, c);
    problem.end = 2.0;
    const PiecewiseMotion motion(problem);
    ASSERT_EQ(motion.closed_contacts().size(), 1u);
    EXPECT_NEAR(motion.closed_contacts()[0].from, rest, 1e-14) << c;
  }
}

/// Section "plastic pair": damped frequencies X w and w, a common decay; they stick, part and land softly.
TEST(RestingContacts, APlasticPairSticksPartsAndLandsWithoutSpeed) {
  Box box(42);
  Tally tally;
  for (int trial = 0; trial < trials(25); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 42, trial " << trial);
    const double X = 3.0 + 2.0 * std::floor(box.uniform(0.0, 4.0));
    // All of the problem's numbers are doubles without rounding.
    const auto dyadic = [&](double low, double high, double unit) {
      return unit * std::floor(box.uniform(low, high) / unit);
    };
    const double sigma = box.one_in(3) ? 0.0 : dyadic(0.0, 0.1, 0x1p-10),
                 w = dyadic(0.5, 2.0, 0x1p-10), m1 = dyadic(0.5, 2.0, 0x1p-8),
                 m2 = dyadic(0.5, 2.0, 0x1p-8), V1 = dyadic(-1.0, -0.25, 0x1p-8),
                 V2 = V1 + dyadic(0.5, 2.0, 0x1p-8);
    if (!(m1 * V1 + m2 * V2 > 0.05)) continue;
    model::ImpactProblem<> problem;
    const auto diagonal = [](double a, double b) {
      return MatrixXd(Eigen::Vector2d(a, b).asDiagonal());
    };
    problem.system.mass = diagonal(m1, m2);
    problem.system.damping = 2.0 * sigma * problem.system.mass;
    problem.system.stiffness =
        diagonal(m1 * (X * X * w * w + sigma * sigma), m2 * (w * w + sigma * sigma));
    // They come to u = 0 together, with these speeds, from a start before.
    problem.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 0.0}};
    problem.start = {0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d(V1, V2)};
    const Real V = (Real(m1) * V1 + Real(m2) * V2) / (Real(m1) + m2), s = sigma, W = w;
    // The pair starts after the plastic impact at t = 0.
    problem.start.v = Eigen::Vector2d::Constant(double(V));
    const Real speed = problem.start.v[0];
    const Real k =
        (Real(m1) * (Real(X) * X * W * W + s * s) + Real(m2) * (W * W + s * s)) / (Real(m1) + m2);
    const Real wc = sqrt(Real(k - s * s)), pi = testing_oracle::pi();
    const Real stick = pi / wc, period = stick + pi / W;
    problem.end = 3.4 * double(period);
    ASSERT_EQ(test::refusal_of([&] { PiecewiseMotion{problem}; }), "accepted")
        << "X " << X << " w " << w << " sigma " << sigma << " m " << m1 << " " << m2 << " v "
        << problem.start.v[0] << " period " << period;
    const PiecewiseMotion motion(problem);
    ++tally.members;
    EXPECT_EQ(motion.impact_count(problem.end), 0);
    const auto closed = motion.closed_contacts();
    ASSERT_EQ(closed.size(), 4u);
    tally.rests += 4;
    const auto exact = [&](const Real& t, Eigen::Index mass) -> Exact {
      const Real whole = floor(Real(t / period)), decay = exp(Real(-s * whole * period));
      Real x = t - whole * period, amplitude = speed * decay, f = wc;
      if (x >= stick) {
        x -= stick;
        amplitude *= -exp(Real(-s * stick));
        f = mass == 0 ? Real(X * W) : W;
      }
      const Real e = amplitude * exp(Real(-s * x)), c = cos(f * x), n = sin(f * x) / f;
      return {e * n, e * (c - s * n), e * ((s * s - f * f) * n - 2 * s * c)};
    };
    for (std::size_t j = 0; j < 4; ++j) {
      const Real from = period * Real(int(j));
      EXPECT_TRUE(Real(closed[j].begins.lo) <= from + Real(1e-13) &&
                  from - Real(1e-13) <= Real(closed[j].begins.hi))
          << closed[j].begins.lo - double(from);
      if (closed[j].opens) {
        ++tally.releases;
        EXPECT_NEAR(closed[j].until, double(from + stick), 1e-12);
      }
    }
    for (int i = 0; i < 40; ++i) {
      double t = box.uniform(0.0, problem.end);
      if (i % 4 == 0) {
        const double at = double(period * Real(1 + i % 3));
        t = at + (box.one_in(2) ? 1.0 : -1.0) * box.decades(-12.0, -3.0);
      }
      for (const Eigen::Index mass : {0, 1}) compare(motion, t, mass, exact(t, mass), tally);
    }
    const auto bound = motion.error_bound(problem.end);
    EXPECT_LT(bound.u.maxCoeff(), 1e-11);
  }
  tally.record();
}

TEST(RestingContacts, PressedAndTouchingStartsHaveTheAnswerOfTheImpactLaw) {
  auto problem = pressed_mass(2.0, 1.0, 3.0, 0.0, 0.5);
  problem.end = 7.0;
  const PiecewiseMotion pressed(problem);
  ASSERT_EQ(pressed.closed_contacts().size(), 1u);
  EXPECT_EQ(pressed.closed_contacts()[0].from, 0.0);
  EXPECT_EQ(pressed.impact_count(7.0), 0);
  EXPECT_EQ(pressed.contact_forces(5.0, Side::left)[0], 3.0);
  EXPECT_EQ(pressed.at(5.0, Side::left).u[0], 0.0);
  // Newton's cradle, the second mass and the third at rest in touch: the law acts on both contacts at
  // once, and the third does not part from the second.
  model::ImpactProblem<> cradle;
  cradle.system.mass = cradle.system.stiffness = MatrixXd::Identity(3, 3);
  cradle.system.damping = MatrixXd::Zero(3, 3);
  cradle.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, 1.0}, {Eigen::Vector3d(0, 1, -1), 0.0, 1.0}};
  cradle.start = {0.0, Eigen::Vector3d(1, 0, 0), Eigen::Vector3d::Zero()};
  cradle.end = 4.0;
  const PiecewiseMotion motion(cradle);
  ASSERT_EQ(motion.impact_count(4.0), 1);
  const auto after = motion.impact(1).after.v;
  EXPECT_NEAR((after - Eigen::Vector3d(1, -2, -2) / 3.0).cwiseAbs().maxCoeff(), 0.0, 1e-14);
  EXPECT_EQ(motion.closed_contacts().size(), 1u);
  // The loads alone would close the second contact; the force of the first one opens it.
  model::ImpactProblem<> lever;
  lever.system.mass = MatrixXd::Identity(2, 2);
  lever.system.damping = lever.system.stiffness = MatrixXd::Zero(2, 2);
  lever.system.add_load = model::HarmonicLoad({{0, -1.0, 0.0, 0.0}, {1, 0.5, 0.0, 0.0}});
  lever.contacts = {{Eigen::Vector2d(1, 0), 0.0, 0.0}, {Eigen::Vector2d(1, 1), 0.0, 0.5}};
  lever.start = {0.0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  lever.end = 2.0;
  const PiecewiseMotion opened(lever);
  EXPECT_EQ(opened.closed_contacts().size(), 1u);
  EXPECT_EQ(opened.at(2.0, Side::left).u[0], 0.0);
  EXPECT_NEAR(opened.at(2.0, Side::left).u[1], 1.0, 1e-15);
}

model::ImpactProblem<> random_resting(Box& box) {
  const auto n = Eigen::Index(std::floor(box.uniform(1.0, 11.0)));
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) system.mass(i, i) = box.uniform(0.5, 2.0);
  const bool floats = box.one_in(4);  // no spring to the ground, and few dashpots
  const auto chain = [&](double least, double most) {
    MatrixXd x = MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      double own = box.uniform(least, most), between = box.uniform(least, most);
      if (floats) own = 0.0;
      if (floats && box.one_in(3)) between = 0.0;
      x(i, i) += own;
      if (i + 1 == n) continue;
      x(i, i) += between;
      x(i + 1, i + 1) += between;
      x(i, i + 1) -= between;
      x(i + 1, i) -= between;
    }
    return x;
  };
  system.stiffness = chain(0.3, 2.0);
  system.damping = box.one_in(3)   ? chain(0.0, 0.1)
                   : box.one_in(2) ? MatrixXd(0.05 * system.mass)
                                   : MatrixXd::Zero(n, n);
  problem.start = {0.0, VectorXd::Zero(n), VectorXd::Zero(n)};
  for (auto& v : problem.start.v) v = box.uniform(-1.0, 1.0);
  const auto count = Eigen::Index(std::floor(box.uniform(1.0, 3.999)));
  for (Eigen::Index i = 0; i < std::min(n, count); ++i) {
    const double eta = box.one_in(2) ? 0.0 : box.uniform(0.05, 0.7);
    auto contact = i + 1 < n ? model::contact_between(n, i, i + 1, eta)
                             : model::Contact<>{VectorXd::Unit(n, i), 0.0, eta};
    contact.gap = box.uniform(-0.3, -0.02);
    if (i + 1 < n && box.one_in(2)) contact.direction[i + 1] *= box.uniform(0.5, 2.0);  // a lever
    problem.contacts.push_back(contact);
  }
  std::vector<model::HarmonicForce> forces{{0, -box.uniform(0.0, 1.5), 0.0, 0.0}};
  if (box.one_in(2))
    forces.push_back({int(box.uniform(0.0, double(n))), box.uniform(-1.5, 1.5),
                      box.uniform(0.3, 3.0), box.uniform(0.0, 6.0)});
  system.add_load = model::HarmonicLoad(forces);
  problem.end = 8.0;
  return problem;
}

// While the last impacts of mass 1 are left out, springs and dampers take them to mass 2.
TEST(RestingContacts, NeighboursOfAContactThatComesToRestMoveAsTheTaylorSeriesSays) {
  Box box(44);
  Tally tally;
  for (int trial = 0; trial < trials(12); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 44, trial " << trial);
    const double k = box.decades(-1.0, 2.0), c = trial % 2 == 0 ? 0.0 : box.decades(-2.0, 1.0);
    const double eta = box.uniform(0.1, 0.6), f = box.uniform(1.0, 3.0) + 0.2 * k;
    auto problem = pressed_mass(1.0, k, f, 0.05, eta);
    auto& system = problem.system;
    const Eigen::Matrix4d chain{{1, -1, 0, 0}, {-1, 2, -1, 0}, {0, -1, 2, -1}, {0, 0, -1, 2}};
    system.mass = Eigen::Vector4d(1.0, box.decades(-1.7, 0.3), 1.0, 0.5).asDiagonal();
    system.stiffness = k * chain;
    system.damping = c * chain;
    problem.contacts = {{VectorXd::Unit(4, 0), 0.0, eta}};
    problem.start = {0.0, 0.05 * VectorXd::Unit(4, 0), VectorXd::Zero(4)};
    problem.end = 3.0;
    if (test::refusal_of([&] { PiecewiseMotion{problem}; }) != "accepted") continue;
    const PiecewiseMotion motion(problem);
    const auto closed = motion.closed_contacts();
    if (closed.empty() || !closed[0].accumulates || closed[0].begins.hi > 2.9) continue;
    ++tally.members;
    TaylorSimulator simulator(problem);
    for (int i = 1; i <= 30; ++i) {
      const double x = i / 21.0, t = x * closed[0].begins.hi + (1.0 - x) * closed[0].resolved;
      while (simulator.next(t)) {
      }
      const auto known = simulator.at(t);
      for (Eigen::Index mass = 0; mass < 4; ++mass)
        compare(motion, t, mass, {known.u[mass], known.v[mass], known.a[mass]}, tally);
    }
  }
  EXPECT_GE(tally.members, 5);
  tally.record();
}

// A strong dashpot takes what the last impacts leave out to a light mass, and brakes it.
TEST(RestingContacts, ALightNeighbourOfAContactThatComesToRestIsBraked) {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector2d(1.0, 1.0 / 64.0).asDiagonal();
  problem.system.stiffness = MatrixXd::Zero(2, 2);
  problem.system.damping = MatrixXd{{8.0, -8.0}, {-8.0, 8.0}};
  problem.system.add_load = model::HarmonicLoad({{0, -1.0, 0.0, 0.0}});
  problem.contacts = {{VectorXd::Unit(2, 0), 0.0, 0.5}};
  problem.start = {0.0, Eigen::Vector2d(0.25, 0.0), Eigen::Vector2d(0.0, 0.5)};
  problem.end = 3.0;
  const PiecewiseMotion motion(problem);
  // By series with 230 bits from impact to impact, down to rebounds of 1e-34 m/s.
  const double known = -3.9050836406296732e-05;
  EXPECT_LE(std::abs(motion.at(2.025, Side::right).v[1] - known), motion.error_bound(2.025).v[1]);
  EXPECT_LT(motion.error_bound(2.025).v[1], 1e-8);
}

TEST(RestingContacts, OfRandomStructuresMoveAsTheTaylorSeriesSays) {
  Box box(43);
  Tally tally;
  std::map<std::string, int> refused;
  for (int trial = 0; trial < trials(24); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 43, trial " << trial);
    const auto problem = random_resting(box);
    const auto text = test::refusal_of([&] { PiecewiseMotion{problem}; });
    if (text != "accepted") {
      ++refused[text.find("accumulate") != std::string::npos ? "accumulate"
                : text.find("apart") != std::string::npos    ? "coincidence"
                : text.find("force of") != std::string::npos ? "force"
                : text.find("within") != std::string::npos   ? "graze"
                                                             : text];
      continue;
    }
    ++tally.members;
    const PiecewiseMotion motion(problem);
    TaylorSimulator simulator(problem);
    for (double t = 0.173; t < problem.end; t += 0.173) {
      try {
        while (simulator.next(t)) {
        }
      } catch (const std::logic_error& error) {
        ++refused[error.what()];  // by the simulation
        break;
      }
      const auto known = simulator.at(t);
      for (Eigen::Index mass = 0; mass < problem.dof(); ++mass)
        compare(motion, t, mass, {known.u[mass], known.v[mass], known.a[mass]}, tally);
      const auto forces = motion.contact_forces(t, Side::right);
      const auto held = simulator.forces_at(t);
      const auto& system = problem.system;
      const auto bound = motion.error_bound(t);
      const double allowed =
          1e-12 + (system.mass.cwiseAbs() * bound.a + system.damping.cwiseAbs() * bound.v +
                   system.stiffness.cwiseAbs() * bound.u)
                      .sum();
      for (std::size_t i = 0; i < simulator.held().size(); ++i)
        EXPECT_NEAR(forces[Eigen::Index(simulator.held()[i])], double(held[Eigen::Index(i)]),
                    allowed)
            << t;
    }
    for (const auto& closed : motion.closed_contacts()) {
      ++tally.rests;
      tally.releases += closed.opens ? 1 : 0;
    }
  }
  for (const auto& [reason, count] : refused) testing::Test::RecordProperty(reason, count);
  EXPECT_GT(tally.rests, tally.members / 4);
  tally.record();
}

// Values by series with 230 bits. The contact has opened 6e-10 s before the instant found, within its error.
TEST(RestingContacts, AccelerationsAreBoundedBesideAReleaseAndBySpringsOfCoupledModes) {
  const PiecewiseMotion released(model::problem_from_text(R"(
M = [[0.5, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.5]]
K = [[2, -1, 0, 0], [-1, 2, -1, 0], [0, -1, 2, 0], [0, 0, 0, 4]]
C = [[0.25, -0.25, 0, 0], [-0.25, 0.5, -0.25, 0], [0, -0.25, 0.25, 0], [0, 0, 0, 0.5]]
end = 10
start = {u = [0.375, 0.125, 0.25, 0.625], v = [0.375, -1.125, 0, 0]}
contacts = [{direction = [1, 0, 0, 0], gap = 0.375, restitution = 0.5},
            {direction = [0, 0, 1, -1], gap = -0.625, restitution = 0.5}]
loads = [{dof = 1, amplitude = 0.625, frequency = 0}]
)",
                                                          "released"));
  const PiecewiseMotion struck(model::problem_from_text(R"(
M = [[1, 0.25, 0, 0], [0.25, 0.5, 0, 0], [0, 0, 2, 0], [0, 0, 0, 0.5]]
K = [[19, -10, 0, 0], [-10, 20, -1, 0], [0, -1, 1, 0], [0, 0, 0, 0]]
C = [[0.125, -0.125, 0, 0], [-0.125, 0.375, -0.25, 0], [0, -0.25, 0.25, 0], [0, 0, 0, 0.125]]
end = 10
start = {u = [0.375, -2.375, 0.125, -0.125]}
contacts = [{direction = [1, -1, 0, 0], gap = 2.75, stiffness = 1000},
            {direction = [0, 0, 0, -1], gap = 0.125, restitution = 0.5694743762363684}]
loads = [{dof = 1, amplitude = 1.625, frequency = 1}]
)",
                                                        "struck"));
  const auto expect = [](const PiecewiseMotion& motion, double t, Eigen::Index mass, double known) {
    const double bound = motion.error_bound(t).a[mass];
    EXPECT_LE(std::abs(motion.at(t, Side::right).a[mass] - known), bound);
    EXPECT_LT(bound, 1e-7);
  };
  expect(released, 9.621760116734126, 0, 2.829439885562188e-10);
  expect(struck, 1e-4, 2, -1.24830736561445645);
}

// Both contacts stop the structure; one of them opens by its acceleration, and would graze at 1.91 s.
TEST(RestingContacts, AnImpactThatLeavesNoSpeedIsFollowed) {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector2d(0.5, 1.5).asDiagonal();
  problem.system.stiffness = MatrixXd{{24.0, -10.0}, {-10.0, 14.0}};
  problem.system.damping = MatrixXd::Zero(2, 2);
  problem.contacts = {{Eigen::Vector2d(-1.0, 2.0), 1.125, 0.0},
                      {Eigen::Vector2d(1.0, 1.0), 0.5, 0.0}};
  problem.start = {0.0, Eigen::Vector2d(1.0, 1.5), VectorXd::Zero(2)};
  problem.end = 1.5;
  const PiecewiseMotion motion(problem);
  const auto stop = motion.impact(2);
  EXPECT_NEAR(stop.t, 0.505966392, 1e-9);
  EXPECT_NEAR(stop.impulse, 2.172194, 1e-6);
  EXPECT_LT(stop.after.v.cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(motion.closed_contacts().size(), 1u);
  EXPECT_GT(motion.at(stop.t + 0.01, Side::right).u.sum(), 0.5);
}

// 12000 impacts later the error of a ball is its height.
TEST(RestingContacts, ImpactsThatAreNotSmallAreNotLeftOut) {
  model::ImpactProblem<> ball;
  ball.system.mass = MatrixXd::Identity(1, 1);
  ball.system.damping = ball.system.stiffness = MatrixXd::Zero(1, 1);
  ball.system.add_load = model::HarmonicLoad({{0, -9.81, 0.0, 0.0}});
  ball.contacts = {{VectorXd::Ones(1), 0.0, 0.9999}};
  ball.start = {0.0, VectorXd::Ones(1), VectorXd::Zero(1)};
  ball.end = 6000.0;
  EXPECT_REFUSED(PiecewiseMotion{ball}, "not-admissible", "contact 1 accumulate", "height of 0.1",
                 "0.001 of the largest speed");
}

}  // namespace
}  // namespace clackers::exact
