#include "clackers/exact/assembly/shaped_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/testing/assembly_members.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

namespace clackers::exact {
namespace {

using namespace testing_oracle;
using model::Side;

BuildingsParameters random_buildings(Box& box) {
  BuildingsParameters p;
  p.left = std::floor(box.uniform(1.0, 5.0));
  p.right = std::floor(box.uniform(1.0, 5.0));
  p.X = box.one_in(2) ? 1.0 : box.one_in(2) ? 3.0 : 5.0;
  p.r = p.X == 1.0
            ? box.decades(-2.0, 2.0)
            : box.uniform(0.05, 0.999) * buildings_limit(int(p.left), int(p.right), p.X).proven;
  p.m1 = box.decades(-3.0, 3.0);
  p.Omega = box.decades(-3.0, 3.0);
  p.sigma = box.one_in(3) ? 0.0 : p.Omega * box.uniform(0.0, 0.3);
  p.V = box.decades(-3.0, 3.0);
  p.eta = box.one_in(2) ? 1.0 : box.uniform(0.1, 1.0);
  p.t_end = 11.0 / p.Omega;
  return p;
}

RowParameters random_row(Box& box) {
  RowParameters p;
  p.masses = std::floor(box.uniform(2.0, 7.0));
  p.fast = std::floor(box.uniform(0.0, p.masses + 1.0));
  p.X = 2.0 * std::floor(box.uniform(1.0, 5.0)) + 1.0;
  p.speed = box.uniform(0.05, 0.999) * row_limit(p);
  p.m1 = box.decades(-3.0, 3.0);
  p.Omega = box.decades(-3.0, 3.0);
  p.sigma = box.one_in(3) ? 0.0 : p.Omega * box.uniform(0.0, 0.3);
  p.eta = box.one_in(2) ? 1.0 : box.uniform(0.1, 1.0);
  p.t_end = 11.0 / p.Omega;
  return p;
}

AlternatingParameters random_alternating(Box& box) {
  AlternatingParameters p;
  p.rh = 2.0 * std::floor(box.uniform(1.0, 4.0));
  p.r = box.uniform(0.05, 0.999) * alternating_limit(p.rh);
  p.Omega = box.decades(-3.0, 3.0);
  p.sigma = box.one_in(3) ? 0.0 : p.Omega * box.uniform(0.0, 0.3);
  p.t_end = 11.0 / p.Omega;
  return p;
}

AssemblyParameters random_assembly(Box& box) {
  AssemblyParameters p;
  p.pairs = std::floor(box.uniform(1.0, 4.0));
  p.coupling = box.one_in(3) ? Coupling::dense : box.one_in(2) ? Coupling::block : Coupling::chain;
  p.seed = std::floor(box.uniform(0.0, 1e15));
  p.X = 4.0 * std::floor(box.uniform(0.0, 3.0)) + 1.0;
  p.xi1 = box.one_in(3) ? 0.0 : box.uniform(0.0, 0.3);
  p.eta = box.one_in(2) ? 1.0 : box.uniform(0.1, 1.0);
  p.t_end = 11.0;
  return p;
}

// Members of the class beside the event-driven simulation, up to the fourth impact or so.
template <class Draw, class Make>
void follow(unsigned seed, int members, const Draw& draw, const Make& make) {
  for (int i = 0; i < trials(members); ++i) {
    Box box(seed + unsigned(i));
    const auto p = draw(box);
    SCOPED_TRACE(testing::Message() << "seed " << seed + unsigned(i));
    const auto motion = make(p);
    EXPECT_GE(expect_simulated(raw_of(p), *motion, p.t_end, box), 1);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Buildings, AgreeWithTheSimulation) {
  follow(100, 15, random_buildings, [](const auto& p) { return make_buildings(p); });
}

TEST(Row, AgreesWithTheSimulation) {
  follow(200, 15, random_row, [](const auto& p) { return make_row(p); });
}

TEST(Alternating, AgreesWithTheSimulation) {
  follow(300, 15, random_alternating, [](const auto& p) { return make_alternating(p); });
}

TEST(Assembly, AgreesWithTheSimulation) {
  follow(400, 15, random_assembly, [](const auto& p) { return make_assembly(p); });
}

TEST(Buildings, EightAgainstSixStoreysAgreeWithTheSimulation) {
  const BuildingsParameters p{.left = 8.0, .right = 6.0, .r = 0.7, .eta = 0.9, .t_end = 7.0};
  Box box(1);
  EXPECT_EQ(expect_simulated(raw_of(p), *make_buildings(p), p.t_end, box), 2);
}

TEST(Buildings, ThreeAgainstTwoStoreysThriceAsFastAgreeWithTheSimulation) {
  const BuildingsParameters p{.X = 3.0, .r = 2.0, .t_end = 16.0};
  Box box(2);
  EXPECT_EQ(expect_simulated(raw_of(p), *make_buildings(p), p.t_end, box), 5);
}

// The first impact of a simulation that starts within a flight.
double first_impact(const auto& p) { return double(MassSimulator(raw_of(p)).next(100)->t); }

TEST(Buildings, TouchBetweenImpactsBeyondTheLimitOnly) {
  for (const auto& [left, right, X] :
       {std::tuple{3.0, 2.0, 3.0}, {2.0, 1.0, 5.0}, {1.0, 3.0, 7.0}, {4.0, 4.0, 3.0}}) {
    BuildingsParameters p{.left = left, .right = right, .X = X};
    const double limit = buildings_limit(int(left), int(right), X).r_star;
    p.r = limit * (1.0 - 1e-6);
    EXPECT_NEAR(first_impact(p), M_PI, 1e-12);
    p.r = limit * (1.0 + 1e-6);
    // At a minimum of the fourth order, X = 3, (1e-6)^(1/4) = 0.03 and more before it.
    const double angle = buildings_limit(int(left), int(right), X).angle;
    EXPECT_LT(first_impact(p), angle);
    EXPECT_NEAR(first_impact(p), angle, 0.1);
    EXPECT_REFUSED(make_buildings(p), "not-admissible", "r = ", "Take r below the limit, or X = 1");
  }
}

TEST(Buildings, OfOneStoreyHaveTheLimitOfThePair) {
  // r*(3) = 3 and r*(5) = 4, admissibility.md.
  EXPECT_NEAR(buildings_limit(1, 1, 3.0).r_star, 3.0, 1e-14);
  EXPECT_NEAR(buildings_limit(1, 1, 5.0).r_star, 4.0, 1e-14);
  EXPECT_NEAR(buildings_limit(1, 1, 401.0).r_star, 4.6032425, 1e-7);
  EXPECT_TRUE(std::isinf(buildings_limit(3, 2, 1.0).r_star));
  // The middle of the flight, where the fast roof is nearest.
  EXPECT_NEAR(buildings_limit(1, 1, 3.0).angle, M_PI / 2.0, 1e-7);
}

TEST(Row, TouchesBetweenImpactsBeyondTheLimitOnly) {
  for (const double fast : {1.0, 2.0, 3.0})
    for (const double X : {3.0, 5.0}) {
      RowParameters p{.masses = 3.0, .fast = fast, .X = X};
      const double limit = row_limit(p);
      p.speed = limit * (1.0 - 1e-5);
      EXPECT_NEAR(first_impact(p), M_PI / 2.0, 1e-12);
      // X = 3 grazes at the start itself, where the masses would overlap.
      p.speed = limit * (1.0 + 1e-5);
      if (X > 3.0 || fast == 2.0) {
        EXPECT_LT(first_impact(p), M_PI / 2.0 - 1e-4);
      }
      EXPECT_REFUSED(make_row(p), "not-admissible", "speed = ", "Take a lower speed.");
    }
}

TEST(Alternating, TouchesBetweenImpactsBeyondTheLimitOnly) {
  // Amplitudes of the middle mass over those of the outer ones.
  EXPECT_NEAR(alternating_limit(2.0) / 4.0, 0.918559, 5e-7);
  EXPECT_NEAR(alternating_limit(4.0) / 8.0, 0.545478, 5e-7);
  for (const double rh : {2.0, 4.0, 6.0}) {
    AlternatingParameters p{.rh = rh};
    p.r = alternating_limit(rh) * (1.0 - 1e-6);
    EXPECT_NEAR(first_impact(p), M_PI / 4.0, 1e-12);
    p.r = alternating_limit(rh) * (1.0 + 1e-6);
    EXPECT_LT(first_impact(p), M_PI / 4.0 - 0.01);
    EXPECT_REFUSED(make_alternating(p), "not-admissible", "r = ", "Take a lower r.");
  }
}

TEST(Assembly, SeenThroughItsMatrixIsManyPairs) {
  AssemblyParameters p{.pairs = 3.0, .X = 41.0, .xi1 = 1e-7, .eta = 0.999999, .t_end = 1e6};
  for (const auto coupling : {Coupling::chain, Coupling::block, Coupling::dense}) {
    p.coupling = coupling;
    const AssemblyData data(p);
    const auto motion = make_assembly(p);
    for (std::size_t j = 0; j < 3; ++j) {
      const auto [m2, r, A] = data.pair(j);
      const SynchronizedPair pair({.m1 = r * m2,
                                   .k1 = r * m2,
                                   .xi1 = p.xi1,
                                   .A = A,
                                   .X = p.X,
                                   .r = r,
                                   .eta = p.eta,
                                   .t_end = p.t_end});
      Box box(unsigned(j) + 7);
      for (int trial = 0; trial < 5; ++trial) {
        const double t = box.uniform(0.0, p.t_end);
        const auto x = pair.at(t, Side::right), u = motion->at(t, Side::right);
        const auto size = pair.envelope(t), bound = motion->error_bound(t);
        for (const std::size_t mass : {2 * j, 2 * j + 1}) {
          double sum_u = 0.0, sum_v = 0.0, allowed_u = 0.0, allowed_v = 0.0;
          for (std::size_t i = data.first_column(mass); i <= mass; ++i) {
            const double entry = data.entry(mass, i);
            const auto at = static_cast<Eigen::Index>(i);
            sum_u += entry * u.u[at];
            sum_v += entry * u.v[at];
            // A few roundings of each product and sum.
            allowed_u += std::abs(entry) * (bound.u[at] + 1e-15 * std::abs(u.u[at]));
            allowed_v += std::abs(entry) * (bound.v[at] + 1e-15 * std::abs(u.v[at]));
          }
          const auto own = static_cast<Eigen::Index>(mass - 2 * j);
          EXPECT_NEAR(sum_u, x.u[own], allowed_u + 1e-15 * size.u[own]);
          EXPECT_NEAR(sum_v, x.v[own], allowed_v + 1e-15 * size.v[own]);
        }
      }
    }
  }
}

// Motions of all kinds with their problems, larger than a simulation can follow.
struct Member {
  std::unique_ptr<const ShapedMotion> motion;
  model::ImpactProblem<> problem;
};

std::vector<Member> large_members() {
  std::vector<Member> all;
  const auto add = [&](auto motion, const auto& make_problem) {
    auto problem = make_problem(*motion);
    all.push_back({std::move(motion), std::move(problem)});
  };
  for (const BuildingsParameters& p :
       {BuildingsParameters{.left = 100.0, .right = 60.0, .eta = 0.8},
        BuildingsParameters{.left = 30.0, .right = 40.0, .X = 3.0, .r = 1.5, .eta = 0.9}})
    add(make_buildings(p), [&](const auto& motion) { return buildings_problem(p, motion); });
  const RowParameters row{.masses = 40.0, .fast = 17.0, .X = 7.0, .eta = 0.7};
  add(make_row(row), [&](const auto& motion) { return row_problem(row, motion); });
  const AlternatingParameters three{.rh = 10.0, .r = 3.0};
  add(make_alternating(three),
      [&](const auto& motion) { return alternating_problem(three, motion); });
  for (const auto coupling : {Coupling::chain, Coupling::block, Coupling::dense}) {
    const AssemblyParameters p{.pairs = 20.0, .coupling = coupling, .eta = 0.8};
    add(make_assembly(p), [&](const auto& motion) { return assembly_problem(p, motion); });
  }
  return all;
}

// A product of a matrix with rounded entries, formed by rounded operations.
constexpr double rounding_of(Eigen::Index n) { return double(n + 8) * 0x1p-52; }

TEST(ShapedMotion, SolvesTheEquationOfMotionInFlight) {
  Box box(21);
  for (const auto& [motion, problem] : large_members()) {
    const auto& [M, C, K, load, nonlinear] = problem.system;
    for (int trial = 0; trial < 10; ++trial) {
      const double t = box.uniform(0.0, motion->end());
      const auto x = motion->at(t, Side::right), bound = motion->error_bound(t);
      const Eigen::VectorXd rest = M * x.a + C * x.v + K * x.u;
      const Eigen::MatrixXd m = M.cwiseAbs(), c = C.cwiseAbs(), k = K.cwiseAbs();
      const double rounding = rounding_of(problem.dof());
      const Eigen::VectorXd allowed = m * (bound.a + rounding * x.a.cwiseAbs()) +
                                      c * (bound.v + rounding * x.v.cwiseAbs()) +
                                      k * (bound.u + rounding * x.u.cwiseAbs());
      for (Eigen::Index i = 0; i < rest.size(); ++i) EXPECT_LE(std::abs(rest[i]), allowed[i]) << i;
    }
  }
}

TEST(ShapedMotion, HasTheRatesOfItsDisplacements) {
  for (const auto& [motion, problem] : large_members()) {
    const double t = 1.3, h = 1e-5;
    const auto before = motion->at(t - h, Side::right), after = motion->at(t + h, Side::right);
    const auto now = motion->at(t, Side::right), size = motion->envelope(t);
    // h^2/6 times the third derivative, at most the largest frequency, 199 rad/s, cubed.
    for (Eigen::Index i = 0; i < problem.dof(); ++i) {
      EXPECT_NEAR((after.u[i] - before.u[i]) / (2.0 * h), now.v[i], 1e-4 * size.v[i]);
      EXPECT_NEAR((after.v[i] - before.v[i]) / (2.0 * h), now.a[i], 1e-4 * size.a[i]);
    }
  }
}

TEST(ShapedMotion, ObeysNewtonsLawMomentumAndEnergyAtImpacts) {
  for (const auto& [motion, problem] : large_members()) {
    const auto& [M, C, K, load, nonlinear] = problem.system;
    const auto count = motion->impact_count(motion->end());
    ASSERT_GE(count, 2);
    const auto at_once = static_cast<long long>(motion->pattern().contacts.front().size());
    const double rounding = rounding_of(problem.dof());
    for (const long long first : {1LL, at_once + 1, count - at_once + 1}) {
      Eigen::VectorXd change = Eigen::VectorXd::Zero(problem.dof()), size = change;
      const auto one = motion->impact(first);
      for (long long i = first; i < first + at_once; ++i) {
        const auto hit = motion->impact(i);
        EXPECT_EQ(hit.t, one.t);
        EXPECT_EQ(hit.index, i);
        if (i > first) {
          EXPECT_GT(hit.contact, motion->impact(i - 1).contact);
        }
        const auto& contact = problem.contacts[static_cast<std::size_t>(hit.contact)];
        const auto bound = motion->error_bound(hit.t);
        const Eigen::VectorXd b = contact.direction, sizes = b.cwiseAbs();
        EXPECT_NEAR(b.dot(hit.before.u), 0.0, sizes.dot(bound.u));
        EXPECT_LT(b.dot(hit.before.v), 0.0);
        EXPECT_NEAR(b.dot(hit.after.v), -contact.restitution * b.dot(hit.before.v),
                    sizes.dot(2.0 * bound.v + rounding * hit.before.v.cwiseAbs()));
        EXPECT_GT(hit.impulse, 0.0);
        change += hit.impulse * b;
        size += hit.impulse * sizes;
      }
      const Eigen::VectorXd moved = M * (one.after.v - one.before.v);
      const Eigen::VectorXd allowed =
          2.0 * M.cwiseAbs() * (motion->error_bound(one.t).v + rounding * one.before.v.cwiseAbs()) +
          rounding * size;
      for (Eigen::Index i = 0; i < moved.size(); ++i)
        EXPECT_NEAR(moved[i], change[i], allowed[i]) << "mass " << i + 1;
      const auto energy = [&M = M, &K = K](const model::Kinematics& x) {
        return 0.5 * (x.v.dot(M * x.v) + x.u.dot(K * x.u));
      };
      EXPECT_NEAR(energy(one.before), one.energy_before, 1e-13 * one.energy_before);
      EXPECT_NEAR(energy(one.after), one.energy_after, 1e-13 * one.energy_before);
    }
  }
}

TEST(ShapedMotion, StaysWithinItsEnvelopeAndReachesMostOfIt) {
  Box box(22);
  for (const auto& [motion, problem] : large_members()) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.dof()), v = u, a = u;
    for (int trial = 0; trial < 3000; ++trial) {
      const double t = box.uniform(0.0, 3.0);
      const auto x = motion->at(t, Side::left), size = motion->envelope(t);
      const auto bound = motion->error_bound(t);
      ASSERT_TRUE((x.u.cwiseAbs().array() <= (size.u + bound.u).array()).all());
      ASSERT_TRUE((x.v.cwiseAbs().array() <= (size.v + bound.v).array()).all());
      ASSERT_TRUE((x.a.cwiseAbs().array() <= (size.a + bound.a).array()).all());
      u = u.cwiseMax(x.u.cwiseAbs().cwiseQuotient(size.u));
      v = v.cwiseMax(x.v.cwiseAbs().cwiseQuotient(size.v));
      a = a.cwiseMax(x.a.cwiseAbs().cwiseQuotient(size.a));
    }
    EXPECT_GT(u.minCoeff(), 0.7);
    EXPECT_GT(v.minCoeff(), 0.7);
    EXPECT_GT(a.minCoeff(), 0.7);
    // The largest of many times.
    const auto peak = motion->peak(), sampled = motion->Motion::peak();
    EXPECT_TRUE(peak.u == sampled.u && peak.v == sampled.v && peak.a == sampled.a);
  }
}

TEST(ShapedMotion, StartsOfBuildingsAreNoImpact) {
  const auto motion = make_buildings({});
  EXPECT_EQ(motion->impact_count(0.0), 0);
  for (const auto side : {Side::left, Side::right}) {
    EXPECT_EQ(motion->at(0.0, side).u, Eigen::VectorXd::Zero(5));
    EXPECT_EQ(motion->at(0.0, side).v, (Eigen::VectorXd(5) << 1, 0, 0, -1, 0).finished());
  }
  EXPECT_EQ(motion->impact(1).t, M_PI);
}

TEST(ShapedMotion, RestsAfterAPlasticImpact) {
  const auto motion = make_row({.eta = 0.0});
  EXPECT_EQ(motion->impact_count(20.0), 4);
  const auto hit = motion->impact(4);
  EXPECT_EQ(hit.contact, 3);
  EXPECT_EQ(hit.after.v, Eigen::VectorXd::Zero(5));
  EXPECT_EQ(hit.energy_after, 0.0);
  EXPECT_GT(hit.energy_before, 0.0);
  EXPECT_EQ(motion->at(3.0, Side::right).u, Eigen::VectorXd::Zero(5));
  EXPECT_EQ(motion->envelope(3.0).u, Eigen::VectorXd::Zero(5));
}

class ShapedSampling : public testing::TestWithParam<numerics::simd::Target> {};

TEST_P(ShapedSampling, OfManyTimesGivesTheBitsOfSingleTimesOnTheFastestTarget) {
  Box box(23);
  auto members = large_members();
  const auto add = [&](auto motion) { members.push_back({std::move(motion), {}}); };
  add(make_row({.sigma = 0.3, .t_end = 1e4}));
  add(make_row({.eta = 0.0}));
  add(make_buildings({.left = 3.0, .right = 5.0, .eta = 0.5, .t_end = 2000.0}));
  for (const auto& [motion, problem] : members) {
    const auto n = static_cast<std::size_t>(motion->dof());
    std::vector<double> times(101);
    const auto impacts = double(motion->impact_count(motion->end()));
    for (double& t : times) {
      t = box.uniform(0.0, motion->end());
      if (!box.one_in(4)) continue;
      t = motion->impact(1 + static_cast<long long>(box.uniform(0.0, impacts))).t;
      if (box.one_in(3)) t = std::nextafter(t, 0.0);
    }
    for (const auto side : {Side::left, Side::right}) {
      std::vector<double> u(times.size() * n), v(u), a(u), again(u), other(u);
      {
        const numerics::simd::ForcedTarget forced(GetParam());
        motion->sample(times, side, {u, v, a});
        motion->sample(times, side, {again, other, {}});
      }
      for (std::size_t i = 0; i < times.size(); ++i) {
        const auto x = motion->at(times[i], side);
        const auto row = [&](const std::vector<double>& all) {
          return Eigen::Map<const Eigen::VectorXd>(&all[i * n], static_cast<Eigen::Index>(n));
        };
        EXPECT_EQ(row(u), x.u) << times[i];
        EXPECT_EQ(row(v), x.v) << times[i];
        EXPECT_EQ(row(a), x.a) << times[i];
      }
      EXPECT_EQ(again, u);
      EXPECT_EQ(other, v);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ShapedSampling, testing::ValuesIn(numerics::simd::available_targets()),
                         [](const auto& target) { return std::string(target.param.name()); });

TEST(ShapedMotion, IsZeroWhereItDecaysBelowAllNumbers) {
  const auto motion = make_row({.sigma = 0.3, .t_end = 1e4});
  EXPECT_EQ(motion->at(1e4, Side::right).u, Eigen::VectorXd::Zero(5));
  // Among the subnormal numbers the bound is as good as their spacing.
  const double t = 2470.0;
  const auto x = motion->at(t, Side::right), bound = motion->error_bound(t);
  EXPECT_GT(x.u.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT(bound.u.maxCoeff(), 1e-320);
}

TEST(ShapedMotion, RefusesTimesBuffersAndImpactsOutside) {
  const auto motion = make_alternating({});
  EXPECT_REFUSED(motion->at(20.1, Side::left), "time-outside", "t = 20.1");
  EXPECT_REFUSED(motion->at(-1.0, Side::left), "time-outside", "t = -1");
  EXPECT_REFUSED(motion->impact(0), "beyond-last-impact", "impact 0");
  EXPECT_REFUSED(motion->impact(14), "beyond-last-impact", "impact 14", "1 to 13");
  std::vector<double> few(2), enough(3);
  const double t = 1.0;
  EXPECT_REFUSED(motion->sample({&t, 1}, Side::left, {few, enough, {}}), "wrong-size", "hold 2");
}

TEST(Assemblies, RefuseSizesBeforeTheyAllocate) {
  EXPECT_REFUSED(make_buildings({.left = 1e9}), "out-of-range", "left = 1000000000",
                 "1 <= left <= 500", "2.24e+10 GB");
  EXPECT_REFUSED(make_buildings({.right = 501.0}), "out-of-range", "right = 501");
  EXPECT_REFUSED(make_buildings({.right = 2.5}), "not-whole", "right = 2.5");
  EXPECT_REFUSED(make_row({.masses = 1e9}), "out-of-range", "masses = 1000000000", "GB");
  EXPECT_REFUSED(make_row({.masses = 1.0}), "out-of-range", "2 <= masses");
  EXPECT_REFUSED(make_row({.fast = 6.0}), "out-of-range", "fast = 6", "0 <= fast <= 5");
  EXPECT_REFUSED(make_row({.speed = 0.0}), "out-of-range", "speed = 0");
  EXPECT_REFUSED(require_assembly_fits("assembly", 1e7), "out-of-range", "pairs = 10000000",
                 "1.04e+07 GB");
  EXPECT_REFUSED(make_assembly({.pairs = 2e9}), "out-of-range", "pairs = 2000000000");
  EXPECT_REFUSED(make_assembly({.seed = -1.0}), "out-of-range", "seed = -1");
  EXPECT_REFUSED(make_row({.t_end = 1e300}), "out-of-range", "t_end");
}

TEST(Assemblies, RefuseOtherFrequencyRatios) {
  EXPECT_REFUSED(make_buildings({.X = 1.0 / 3.0}), "not-odd", "Exchange the buildings");
  EXPECT_REFUSED(make_buildings({.X = 2.0}), "not-odd", "X = 2");
  EXPECT_REFUSED(make_row({.X = 1.0 / 3.0}), "not-odd", "At most one mass is faster");
  EXPECT_REFUSED(make_assembly({.X = 1.0 / 3.0}), "not-odd", "mass 2");
  EXPECT_REFUSED(make_alternating({.rh = 3.0}), "out-of-range", "rh = 3", "even");
  EXPECT_REFUSED(make_buildings({.sigma = -1.0}), "out-of-range", "sigma = -1");
  EXPECT_REFUSED(make_buildings({.eta = 1.5}), "out-of-range", "eta = 1.5");
}

TEST(Assembly, HasExactMassMatrices) {
  for (const auto coupling : {Coupling::chain, Coupling::block, Coupling::dense}) {
    const AssemblyParameters p{.pairs = 6.0, .coupling = coupling, .seed = 5.0};
    const auto motion = make_assembly(p);
    const auto problem = assembly_problem(p, *motion);
    const auto raw = raw_of(p);
    for (Eigen::Index i = 0; i < 12; ++i)
      for (Eigen::Index j = 0; j < 12; ++j) {
        EXPECT_EQ(Real(problem.system.mass(i, j)), raw.mass(i, j));
        EXPECT_LE(distance(raw.stiffness(i, j), problem.system.stiffness(i, j)),
                  1e-15 * problem.system.stiffness(i, i));
        if (i < 6) {
          EXPECT_EQ(Real(problem.contacts[std::size_t(i)].direction[j]), raw.contacts(i, j));
        }
        if (coupling == Coupling::chain && std::abs(i - j) > 1) {
          EXPECT_EQ(problem.system.mass(i, j), 0.0);
        }
      }
  }
}

}  // namespace
}  // namespace clackers::exact
