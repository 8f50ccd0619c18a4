#include "clackers/exact/flights/piecewise_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {
namespace {

model::ImpactProblem<> pair(const PairParameters& parameters) {
  return SynchronizedPair(parameters).problem();
}

// The same structure by Taylor series of 30 terms in long double, in steps that are short against
// every period, a change of regime found by bisection. Knows no modes.
class Series {
 public:
  using Real = long double;
  using Vector = std::vector<Real>;

  Series(const model::ImpactProblem<>& problem, double stiffness)
      : n_(static_cast<std::size_t>(problem.dof())), problem_(problem), k_(stiffness) {
    for (std::size_t i = 0; i < n_; ++i) z_.push_back(problem.start.u[Eigen::Index(i)]);
    for (std::size_t i = 0; i < n_; ++i) z_.push_back(problem.start.v[Eigen::Index(i)]);
  }
  const Vector& to(Real t, Real h = 2e-3L) {
    while (t_ < t) {
      Real s = std::min(h, t - t_);
      Vector next = after(s);
      if ((opening(next) < 0.0L) != closed_) {
        Real low = 0.0L, high = s;
        for (int i = 0; i < 70; ++i) {
          const Real middle = (low + high) / 2.0L;
          ((opening(after(middle)) < 0.0L) != closed_ ? high : low) = middle;
        }
        next = after(s = high);
        closed_ = !closed_;
        switches.push_back(t_ + s);
      }
      z_ = next;
      t_ += s;
    }
    return z_;
  }
  std::vector<Real> switches;

 private:
  Real opening(const Vector& z) const {
    Real g = -problem_.contacts[0].gap;
    for (std::size_t i = 0; i < n_; ++i)
      g += Real(problem_.contacts[0].direction[Eigen::Index(i)]) * z[i];
    return g;
  }
  // The derivative of (u, v), whose masses are not coupled by M; without the constant of the gap for
  // the second and higher ones.
  Vector derivative(const Vector& z, bool first) const {
    Vector d(2 * n_);
    const auto& s = problem_.system;
    const auto& contact = problem_.contacts[0];
    Real g = first ? Real(-contact.gap) : 0.0L;
    for (std::size_t i = 0; i < n_; ++i) g += Real(contact.direction[Eigen::Index(i)]) * z[i];
    for (std::size_t i = 0; i < n_; ++i) {
      const auto row = Eigen::Index(i);
      Real force = closed_ ? -Real(k_) * g * Real(contact.direction[row]) : 0.0L;
      for (std::size_t j = 0; j < n_; ++j)
        force -= Real(s.damping(row, Eigen::Index(j))) * z[n_ + j] +
                 Real(s.stiffness(row, Eigen::Index(j))) * z[j];
      d[i] = z[n_ + i];
      d[n_ + i] = force / Real(s.mass(row, row));
    }
    return d;
  }
  Vector after(Real s) const {
    Vector sum = z_, term = z_;
    for (int order = 1; order <= 30; ++order) {
      term = derivative(term, order == 1);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += term[i] *= s / Real(order);
    }
    return sum;
  }

  std::size_t n_;
  model::ImpactProblem<> problem_;
  double k_;
  Real t_ = 0.0L;
  bool closed_ = false;
  Vector z_;
};

TEST(PiecewiseSprings, OfEqualFrequenciesTouchesWhenTheClosedFormSays) {
  // u1 - u2 alone feels the contact: half a free period, then half of one with the spring.
  for (const auto& [xi1, r, k] : {std::array{0.05, 1.0, 1e4}, std::array{0.0, 3.0, 1e4},
                                  std::array{0.3, 0.5, 50.0}, std::array{0.01, 2.0, 1e8}}) {
    const auto problem = pair({.xi1 = xi1, .X = 1.0, .r = r, .t_end = 40.0});
    const PiecewiseMotion motion(with_springs(problem, k));
    const double m2 = 1.0 / r, reduced = m2 / (1.0 + m2), Omega = std::sqrt(1.0 - xi1 * xi1);
    const double flight = std::numbers::pi / Omega,
                 contact = std::numbers::pi / std::sqrt(1.0 + k / reduced - xi1 * xi1);
    const auto& begun = motion.spring_contacts();
    const auto count = std::ssize(begun);
    EXPECT_EQ(count, 1 + static_cast<int>((40.0 - 0.5 * flight) / (flight + contact)));
    for (long long i = 1; i <= count; ++i) {
      const double begins = 0.5 * flight + double(i - 1) * (flight + contact);
      // 40 s of phases rounded by a few 2^-52 of their turns each.
      EXPECT_NEAR(begun[std::size_t(i - 1)], begins, 1e-12) << "xi1 " << xi1 << ", contact " << i;
    }
  }
}

struct Compared {
  model::ImpactProblem<> problem;
  double stiffness;
};

model::ImpactProblem<> coupled() {
  auto problem = pair({.X = 5.0, .r = 2.0, .t_end = 12.0});
  problem.system.stiffness(0, 0) += 3.0;
  problem.system.stiffness(1, 1) += 3.0;
  problem.system.stiffness(0, 1) = problem.system.stiffness(1, 0) = -3.0;
  return problem;
}

model::ImpactProblem<> with_gap(double gap) {
  auto problem = pair({.xi1 = 0.02, .X = 3.0, .r = 1.5, .t_end = 15.0});
  problem.contacts[0].gap = gap;
  return problem;
}

// Dashpots that couple the modes, one of them overdamped in contact.
model::ImpactProblem<> with_dashpots() {
  auto problem = pair({.X = 3.0, .r = 1.5, .t_end = 12.0});
  problem.system.damping << 0.3, -0.1, -0.1, 0.9;
  return problem;
}

model::ImpactProblem<> stop() {
  model::ImpactProblem<> problem;
  problem.system.mass = problem.system.stiffness = Eigen::MatrixXd::Identity(1, 1);
  problem.system.damping = Eigen::MatrixXd::Constant(1, 1, 0.1);
  problem.contacts.push_back({Eigen::VectorXd::Ones(1), -0.2, 1.0});
  problem.start = {0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
  problem.end = 15.0;
  return problem;
}

// A constant force drives a free mass onto the spring: a parabola, an arc of the spring, and the same back. From
// the spring on, the parabola ends where it is not positive give or take a rounding.
TEST(PiecewiseSprings, UnderAFreeMassThrowItBackToWhereItCameFrom) {
  testing_oracle::Box box(45);
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 45, trial " << trial);
    model::ImpactProblem<> problem;
    const double m = box.uniform(0.5, 4.0), a = box.uniform(0.3, 4.0), k = box.decades(1.0, 4.0),
                 height = box.uniform(0.05, 1.0), gap = box.uniform(-0.5, 0.5);
    problem.system.mass = Eigen::MatrixXd::Constant(1, 1, m);
    problem.system.stiffness = problem.system.damping = Eigen::MatrixXd::Zero(1, 1);
    problem.system.add_load = model::HarmonicLoad({{0, m * a, 0.0, 0.0}});
    problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
        std::vector<model::Contact<>>{{-Eigen::VectorXd::Ones(1), gap, 1.0}}, std::vector{k});
    problem.start = {0.0, Eigen::VectorXd::Constant(1, -gap - height), Eigen::VectorXd::Zero(1)};
    const double fall = std::sqrt(2.0 * height / a), omega = std::sqrt(k / m);
    const double contact = 2.0 / omega * (std::numbers::pi - std::atan(a * fall * omega / a));
    const double period = 2.0 * fall + contact;
    problem.end = 6.0 * period;
    const PiecewiseMotion motion(problem);
    ASSERT_EQ(motion.spring_contacts().size(), 6u);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(motion.spring_contacts()[std::size_t(i)], fall + i * period, 1e-12 * problem.end);
      const double t = (i + 1) * period * (1.0 - 1e-15);
      EXPECT_NEAR(motion.at(t, model::Side::left).u[0], -gap - height, 1e-10);
      const double falls = i * period + 0.5 * fall;
      EXPECT_NEAR(motion.at(falls, model::Side::left).v[0], 0.5 * fall * a, 1e-10);
    }
  }
}

TEST(PiecewiseSprings, AgreesWithTaylorSeriesWithinItsBound) {
  const std::vector<Compared> all = {{pair({.X = 9.0, .t_end = 20.0}), 1e4},
                                     {pair({.xi1 = 0.0, .X = 9.0, .r = 0.5, .t_end = 20.0}), 300.0},
                                     {coupled(), 2e3},
                                     {with_dashpots(), 50.0},
                                     {with_gap(-0.3), 1e3},
                                     {with_gap(0.05), 1e3},
                                     {stop(), 1e4}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "problem " << i);
    const auto& [problem, stiffness] = all[i];
    const PiecewiseMotion motion(with_springs(problem, stiffness));
    Series series(problem, stiffness);
    const auto n = problem.dof();
    for (double t = 0.37; t < problem.end; t += 0.37) {
      const auto z = series.to(t);
      const auto found = motion.at(t, model::Side::right), bound = motion.error_bound(t);
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto u = z[std::size_t(k)], v = z[std::size_t(n + k)];
        EXPECT_LE(std::abs(double(found.u[k] - u)), bound.u[k]) << "t " << t << ", mass " << k;
        EXPECT_LE(std::abs(double(found.v[k] - v)), bound.v[k]) << "t " << t << ", mass " << k;
        // A bound that says something.
        EXPECT_LT(bound.u[k], 1e-9);
      }
    }
    series.to(problem.end);
    const auto contacts = std::ssize(motion.spring_contacts());
    EXPECT_EQ(motion.impact_count(problem.end), 0);
    ASSERT_EQ(contacts, std::ssize(series.switches) / 2 + std::ssize(series.switches) % 2);
    ASSERT_GE(contacts, 3);
    for (long long k = 1; k <= contacts; ++k) {
      const auto begins = series.switches[std::size_t(2 * k - 2)];
      EXPECT_NEAR(motion.spring_contacts()[std::size_t(k - 1)], double(begins), 1e-11);
    }
  }
}

TEST(PiecewiseSprings, ObeysItsEquationOfMotionAndItsEnvelope) {
  for (const auto& problem : {pair({.X = 9.0, .t_end = 20.0}), with_gap(0.05), coupled()}) {
    const double k = 1e4;
    const PiecewiseMotion motion(with_springs(problem, k));
    const auto& system = problem.system;
    for (double t = 0.0; t <= problem.end; t += 0.0137) {
      const auto x = motion.at(t, model::Side::left), envelope = motion.envelope(t);
      const double g = problem.contacts[0].gap_at(x.u);
      const Eigen::VectorXd force = -k * std::min(g, 0.0) * problem.contacts[0].direction;
      const Eigen::VectorXd rest =
          system.mass * x.a + system.damping * x.v + system.stiffness * x.u - force;
      // The force is k times an opening that is the difference of two displacements below 1.
      EXPECT_LT(rest.cwiseAbs().maxCoeff(), 64 * 0x1p-52 * (k + 100.0)) << "t " << t;
      EXPECT_TRUE((x.u.cwiseAbs().array() <= envelope.u.array() * (1 + 1e-13)).all()) << "t " << t;
      EXPECT_TRUE((x.v.cwiseAbs().array() <= envelope.v.array() * (1 + 1e-13)).all()) << "t " << t;
    }
  }
}

TEST(PiecewiseSprings, KeepsItsEnergyWithoutDamping) {
  const auto problem = pair({.xi1 = 0.0, .X = 9.0, .t_end = 20.0});
  const double k = 1e4;
  const PiecewiseMotion motion(with_springs(problem, k));
  const auto energy = [&](double t) {
    const auto x = motion.at(t, model::Side::left);
    const double g = std::min(problem.contacts[0].gap_at(x.u), 0.0);
    return 0.5 * (x.v.dot(problem.system.mass * x.v) + x.u.dot(problem.system.stiffness * x.u) +
                  k * g * g);
  };
  for (double t = 0.0; t <= 20.0; t += 0.01) EXPECT_NEAR(energy(t), energy(0.0), 1e-10) << t;
}

TEST(PiecewiseSprings, ComesNearerToTheRigidOneAsTheSpringStiffens) {
  const SynchronizedPair rigid({.X = 5.0, .r = 2.0, .t_end = 8.0});
  double last = 0.0;
  for (const double k : {1e4, 1e6, 1e8}) {
    const PiecewiseMotion motion(with_springs(rigid.problem(), k));
    const double error =
        std::abs(motion.at(8.0, model::Side::left).u[0] - rigid.at(8.0, model::Side::left).u[0]);
    // Each impact delays the motion by one contact time, of order k^(-1/2).
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 10.0, 1.0);
    }
    last = error;
  }
}

TEST(PiecewiseSprings, DoesNotTouchWhereTheRigidOneWouldNotEither) {
  // r* of X = 9 is 4.41368: just below it the masses nearly touch between impacts.
  const auto problem = pair({.X = 9.0, .r = 4.413, .t_end = 4.0});
  const PiecewiseMotion motion(with_springs(problem, 1e10));
  EXPECT_EQ(motion.spring_contacts().size(), 1u);
}

TEST(PiecewiseSprings, RefusesWhatItCannotSolve) {
  const auto good = pair({.t_end = 4.0});
  EXPECT_REFUSED(with_springs(good, 0.0), "out-of-range", "stiffness = 0");
  auto bad = good;
  bad.contacts[0].restitution = 0.9;
  EXPECT_REFUSED(with_springs(bad, 1e4), "penalty-needs-elastic", "restitution = 0.9");
  bad = with_springs(good, 1e4);
  bad.system.add_load = [](double, std::span<double>) {};
  EXPECT_REFUSED(PiecewiseMotion{bad}, "linear-only", "harmonic loads");
}

}  // namespace
}  // namespace clackers::exact
