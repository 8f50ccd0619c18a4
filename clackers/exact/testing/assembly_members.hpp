#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "clackers/exact/assembly/assemblies.hpp"
#include "clackers/exact/assembly/assembly.hpp"
#include "clackers/exact/testing/mass_simulator.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

// For tests: the systems of assemblies with 90 digits, written down from their definitions, and the
// comparison of their simulation with a motion.
namespace clackers::exact::testing_oracle {

inline RawSystem empty_system(Eigen::Index n, Eigen::Index contacts, double sigma, double eta) {
  return {RealMatrix::Zero(n, n), RealMatrix::Zero(n, n), sigma, RealMatrix::Zero(contacts, n), eta,
          RealVector::Zero(n),    RealVector::Zero(n)};
}

inline RawSystem raw_of(const BuildingsParameters& p) {
  const auto left = static_cast<int>(p.left), right = static_cast<int>(p.right);
  auto s = empty_system(left + right, 1, p.sigma, p.eta);
  Eigen::Index at = 0;
  for (const int n : {left, right}) {
    Real mass = at == 0 ? Real(p.m1) : p.m1 / Real(p.r), spring_above = 0;
    const Real omega = at == 0 ? Real(p.Omega) : Real(p.Omega) * p.X, square = omega * omega;
    for (int i = 1; i <= n; ++i, ++at) {
      const Real spring = mass * (2 * i - 1) * (2 * n - 2 * i + 1) * square;
      s.mass(at, at) = mass;
      s.stiffness(at, at) = spring_above + spring + s.sigma * s.sigma * mass;
      if (i > 1) s.stiffness(at, at - 1) = s.stiffness(at - 1, at) = -spring_above;
      if (i < n) mass = spring / (2 * i * (2 * n - 2 * i) * square);
      spring_above = spring;
    }
  }
  s.contacts(0, 0) = 1;
  s.contacts(0, left) = -1;
  s.v[0] = p.V;
  s.v[left] = -Real(p.r) * p.V;
  return s;
}

/// From the velocities just after an impact, which row_masses() states.
inline RawSystem raw_of(const RowParameters& p) {
  const auto row = row_masses(p);
  const auto n = static_cast<Eigen::Index>(row.size());
  auto s = empty_system(n, n - 1, p.sigma, p.eta);
  Real up = 0, down = 0;
  for (const auto& mass : row) (mass.velocity > 0.0 ? up : down) += Real(mass.velocity);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [mass, multiple, velocity] = row[static_cast<std::size_t>(i)];
    const Real own = Real(p.Omega) * multiple;
    s.mass(i, i) = velocity > 0.0 ? Real(p.m1) : -p.m1 * up / down;
    s.stiffness(i, i) = s.mass(i, i) * (own * own + s.sigma * s.sigma);
    s.u[i] = velocity / own * (std::fmod(multiple, 4.0) == 1.0 ? 1 : -1);
    s.v[i] = -s.sigma * s.u[i];
    if (i + 1 == n) break;
    s.contacts(i, i) = 1;
    s.contacts(i, i + 1) = -1;
  }
  return s;
}

inline RawSystem raw_of(const AlternatingParameters& p) {
  auto s = empty_system(3, 2, p.sigma, 1.0);
  const Real middle = 2 * Real(p.rh) * p.Omega, size = sqrt(Real(2)) / 2;
  for (const int i : {0, 1, 2}) {
    const Real own = i == 1 ? middle : Real(p.Omega);
    s.mass(i, i) = i == 1 ? 1 / Real(p.r) : Real(1);
    s.stiffness(i, i) = s.mass(i, i) * (own * own + s.sigma * s.sigma);
  }
  // A quarter of the outer period after the upper mass was struck, u1 = sin(pi/4) and rising.
  s.u << size, 0, -size;
  s.v << size * p.Omega, -Real(p.r) * p.Omega * (std::fmod(p.rh, 4.0) == 0.0 ? 1 : -1),
      size * p.Omega;
  s.v -= s.sigma * s.u;
  s.contacts << 1, -1, 0, 0, 1, -1;
  return s;
}

inline RawSystem raw_of(const AssemblyParameters& p) {
  const AssemblyData data(p);
  const auto n = static_cast<Eigen::Index>(data.dof());
  RealMatrix S = RealMatrix::Zero(n, n), mass = S, stiffness = S, rows = RealMatrix::Zero(n / 2, n);
  RealVector x(n);
  const Real xi1 = p.xi1, square = 1 - xi1 * xi1, X = p.X;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      if (static_cast<std::size_t>(j) >= data.first_column(static_cast<std::size_t>(i)))
        S(i, j) = data.entry(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    const auto [m2, r, A] = data.pair(static_cast<std::size_t>(i / 2));
    const bool slow = i % 2 == 0;
    mass(i, i) = slow ? Real(r) * m2 : Real(m2);
    stiffness(i, i) = mass(i, i) * (slow ? Real(1) : square * X * X + xi1 * xi1);
    rows(i / 2, i) = slow ? 1 : -1;
    // 4N + 1: the fast mass starts on the other side.
    x[i] = slow ? Real(A) : -Real(r) * A / X;
  }
  RawSystem s{
      S.transpose() * mass * S, S.transpose() * stiffness * S, xi1, rows * S, p.eta, {}, {}};
  s.u = S.triangularView<Eigen::Lower>().solve(x);
  s.v = -xi1 * s.u;
  return s;
}

inline double distance(const Real& expected, double value) {
  return double(abs(Real(value) - expected));
}

inline void expect_state(const MassSimulator::State& expected, const model::Kinematics& value,
                         const model::Kinematics& bound) {
  for (Eigen::Index i = 0; i < expected.u.size(); ++i) {
    EXPECT_LE(distance(expected.u[i], value.u[i]), bound.u[i]) << "u of mass " << i + 1;
    EXPECT_LE(distance(expected.v[i], value.v[i]), bound.v[i]) << "v of mass " << i + 1;
    EXPECT_LE(distance(expected.a[i], value.a[i]), bound.a[i]) << "a of mass " << i + 1;
  }
}

/// Follows the simulation up to `end`: states at random times, and each impact with its contacts.
/// Returns the number of impacts.
inline long long expect_simulated(const RawSystem& system, const model::Motion& motion, double end,
                                  Box& box, int samples = 4) {
  MassSimulator simulator(system);
  std::vector<double> times{0.0, end};
  for (int i = 0; i < samples; ++i) times.push_back(box.uniform(0.0, end));
  std::ranges::sort(times);
  long long count = 0;
  const auto energy = [&](const RealVector& u, const RealVector& v) {
    return Real((v.dot(system.mass * v) + u.dot(system.stiffness * u)) / 2);
  };
  for (const double t : times) {
    while (const auto hit = simulator.next(t)) {
      const RealVector u = simulator.at(hit->t).u;
      const auto bound = motion.error_bound(double(hit->t));
      for (std::size_t c = 0; c < hit->contacts.size(); ++c) {
        const auto impact = motion.impact(++count);
        EXPECT_EQ(impact.contact, hit->contacts[c]);
        EXPECT_TRUE(Real(impact.when.lo) <= hit->t && hit->t <= Real(impact.when.hi));
        for (Eigen::Index i = 0; i < u.size(); ++i) {
          EXPECT_LE(distance(u[i], impact.before.u[i]), bound.u[i]) << "u of mass " << i + 1;
          EXPECT_LE(distance(hit->before[i], impact.before.v[i]), bound.v[i]) << i;
          EXPECT_LE(distance(hit->after[i], impact.after.v[i]), bound.v[i]) << i;
        }
        // A dozen roundings.
        const Real impulse = hit->impulses[static_cast<Eigen::Index>(c)];
        const Real before = energy(u, hit->before), after = energy(u, hit->after);
        EXPECT_LE(distance(impulse, impact.impulse), 2e-15 * impact.impulse);
        EXPECT_LE(distance(before, impact.energy_before), 3e-15 * impact.energy_before);
        EXPECT_LE(distance(after, impact.energy_after), 3e-15 * impact.energy_before);
      }
    }
    EXPECT_EQ(motion.impact_count(t), count) << "t = " << t;
    SCOPED_TRACE(testing::Message() << "t = " << t);
    expect_state(simulator.at(t), motion.at(t, model::Side::right), motion.error_bound(t));
    if (testing::Test::HasFailure()) break;
  }
  return count;
}

}  // namespace clackers::exact::testing_oracle
