#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/cases/testing/characteristics.hpp"
#include "clackers/cases/testing/constants.hpp"
#include "clackers/exact/bodies/bar_motion.hpp"
#include "clackers/exact/testing/test_oracle.hpp"

namespace clackers::cases {
namespace {

using exact::testing_oracle::Box;
using exact::testing_oracle::Real;
using exact::testing_oracle::trials;
using model::Side;

struct RandomString {
  double L, T, rho, H;
  explicit RandomString(Box& box)
      : L(box.decades(-1.0, 1.0)),
        T(box.decades(-1.0, 1.0)),
        rho(box.decades(-1.0, 1.0)),
        H(box.decades(-1.0, 1.0)) {}
  double tau() const { return 0.5 * L * std::sqrt(rho / T); }
  Case make(double share, double end) const {
    return cases::make("string-over-point", {{"L", L},
                                             {"T", T},
                                             {"rho", rho},
                                             {"H", H},
                                             {"share", share},
                                             {"elements", 2.0},
                                             {"t_end", end}});
  }
};

TEST(StringCases, AStringOverAPointFollowsItsCharacteristics) {
  Box box(94);
  for (int trial = 0; trial < trials(10); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 94, trial " << trial);
    const int cells = int(box.uniform(2.0, 12.0)), gap = int(box.uniform(1.0, cells + 1.0)),
              steps = int(box.uniform(1.0, 300.0));
    const RandomString p(box);
    const double dt = p.tau() / cells, V = p.H / p.tau(), z = 2.0 * std::sqrt(p.T * p.rho);
    const auto mesh = p.make(1.0 - double(gap) / cells, (steps + 1) * dt);
    const auto& string = *mesh.bars;
    auto known = Characteristics::plucked(cells, gap);
    for (int k = 1; k <= steps; ++k) {
      known.step();
      const double t = k * dt, scale = 1e-15 * (k + 10);
      double kinetic = 0.0, elastic = 0.0;
      for (std::size_t i = 0; i < std::size_t(cells); ++i) {
        const double part = (double(i) + 0.5) / cells;
        const auto now = string.at(0, part * 0.5 * p.L, t, Side::right);
        const double v = 0.5 * (known.right[i] + known.left[i]),
                     s = 0.5 * (known.left[i] - known.right[i]);
        EXPECT_NEAR(now.u.nearest(), p.H * (1.0 - part) + 0.25 * known.u[i] * V * dt, scale * p.H);
        EXPECT_NEAR(now.v.nearest(), v * V, 1e-14 * V);
        EXPECT_NEAR(now.stress.nearest(), s * 2.0 * p.H / p.L * p.T, 1e-14 * p.H / p.L * p.T);
        kinetic += 0.5 * v * v, elastic += 0.5 * s * s;
      }
      const auto energy = string.energy(t);
      const double unit = z * dt * V * V;
      EXPECT_NEAR(energy.kinetic.nearest(), kinetic * unit, scale * cells * unit);
      EXPECT_NEAR(energy.elastic.nearest(), elastic * unit, scale * cells * unit);
      EXPECT_NEAR(string.impulse(t).nearest(), known.impulse * z * V * dt, scale * k * z * V * dt);
      // In the middle of the step just made.
      EXPECT_NEAR(string.force(t - 0.5 * dt, Side::right).nearest(), known.force * z * V,
                  1e-14 * z * V);
    }
  }
}

// Cabannes' formula for L = c = H = 1, with 90 digits.
Real cabannes(const Real& x, const Real& t, const Real& h) {
  const auto K = [](const Real& y) {
    const Real part = abs(y) - floor(abs(y)) - Real(0.5);
    return Real(part * part);
  };
  const Real width = 3 - h, l = 4 * abs(x) < 1 + h ? h : Real(3);
  return (1 + h) / width * (1 - 2 * abs(x)) +
         width / 2 *
             (K(2 * (x + t) / width) + K(2 * (x - t) / width) - K((2 * (x + t) + 1 - l) / width) -
              K((2 * (x - t) + 1 - l) / width));
}

TEST(StringCases, AStringOverAPointIsCabannesFormula) {
  Box box(95);
  for (int trial = 0; trial < trials(20); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 95, trial " << trial);
    const RandomString p(box);
    const double share = box.one_in(8) ? 0.0 : box.uniform(0.0, 0.999), tau = p.tau(),
                 end = tau * box.decades(0.0, 2.0);
    const auto string = p.make(share, end).bars;
    const Real speed = sqrt(Real(p.T) / Real(p.rho)), L = p.L;
    for (int i = 0; i < 20; ++i) {
      const double t = box.uniform(0.0, end), x = i == 0 ? 0.0 : box.uniform(0.0, 0.5 * p.L);
      const auto now = string->at(0, x, t, Side::right);
      const Real known = p.H * cabannes(x / L, speed * t / L, share);
      EXPECT_LE(abs(Real(double(now.u.value)) - known), Real(1.2e-16 * p.H));
      EXPECT_LE(double(now.u.error), 1e-18 * p.H);
      EXPECT_GE(double(string->at(0, 0.0, t, Side::right).u.value), share * p.H * (1.0 - 1e-16));
    }
  }
}

TEST(StringCases, AStringOverAPointTouchesItWhenCabannesSaysSo) {
  const auto mesh = make("string-over-point", {{"share", 0.2}});
  EXPECT_EQ(constant(mesh, "t_closes1"), 0.4);
  EXPECT_EQ(constant(mesh, "t_opens1"), 1.0);
  EXPECT_EQ(constant(mesh, "period"), 1.4);
  const auto force = [&](double t) { return mesh.bars->force(t, Side::right).nearest(); };
  for (const double t : {0.41, 0.99, 1.81, 2.39}) EXPECT_EQ(force(t), 4.0) << t;
  for (const double t : {0.0, 0.39, 1.01, 1.79, 2.41}) EXPECT_EQ(force(t), 0.0) << t;
  // 1.4 is less than the period by less than the spacing of doubles.
  EXPECT_EQ(mesh.bars->at(0, 0.0, 1.4, Side::left).v.nearest(), 2.0);
  EXPECT_EQ(mesh.bars->at(0, 0.0, 1.4, Side::right).v.nearest(), -2.0);
  // Another member, and both limits where a front is; at t = 0 the string is held before.
  const auto other =
      make("string-over-point",
           {{"L", 4.0}, {"T", 8.0}, {"rho", 2.0}, {"H", 0.5}, {"share", 0.5}, {"t_end", 4.0}});
  EXPECT_EQ(constant(other, "c"), 2.0);
  EXPECT_EQ(constant(other, "tau"), 1.0);
  EXPECT_EQ(constant(other, "m"), 8.0);
  EXPECT_EQ(constant(other, "gap"), 0.25);
  EXPECT_EQ(constant(other, "force"), 4.0);
  EXPECT_EQ(constant(other, "h"), 0.125);
  const auto& string = *other.bars;
  EXPECT_EQ(constant(other, "impulse"), string.impulse(4.0).nearest());
  EXPECT_EQ(string.impulse(4.0).nearest(), 10.0);
  EXPECT_EQ(string.force(0.5, Side::left).nearest(), 0.0);
  EXPECT_EQ(string.force(0.5, Side::right).nearest(), 4.0);
  EXPECT_EQ(string.force(2.0, Side::left).nearest(), 4.0);
  EXPECT_EQ(string.force(2.0, Side::right).nearest(), 0.0);
  EXPECT_EQ(string.at(0, 1.0, 0.5, Side::left).v.nearest(), 0.0);
  EXPECT_EQ(string.at(0, 1.0, 0.5, Side::right).v.nearest(), -0.5);
  EXPECT_EQ(string.at(0, 0.0, 0.0, Side::left).v.nearest(), 0.0);
  EXPECT_EQ(string.at(0, 0.0, 0.0, Side::left).stress.nearest(), -2.0);
  EXPECT_EQ(string.at(0, 0.0, 0.0, Side::right).v.nearest(), -0.5);
  EXPECT_EQ(string.at(0, 0.0, 0.0, Side::right).stress.nearest(), 0.0);
  for (const double t : {0.0, 0.3, 1.7}) EXPECT_EQ(string.at(0, 2.0, t, Side::right).u.value, 0.0L);
}

TEST(StringCases, MeshesTendToTheString) {
  for (const auto* mass : {"massless", "lumped", "consistent"}) {
    double before = HUGE_VAL;
    for (const double n : {8.0, 32.0}) {
      const auto mesh =
          make("string-over-point",
               {{"rho", 3.0}, {"T", 2.0}, {"H", 0.5}, {"elements", n}, {"mass", mass}});
      EXPECT_LT(constant(mesh, "e_space"), 0.75 * before) << mass;
      before = constant(mesh, "e_space");
      const auto& system = mesh.problem.system;
      const auto dof = system.mass.rows();
      // All mass but that of the elements' ends that are fixed, and the pluck's energy.
      EXPECT_NEAR(system.mass.sum(), 3.0 * (1.0 - (*mass == 'c' ? 2.0 / 3.0 : 0.5) / n), 1e-14);
      const auto& u = mesh.problem.start.u;
      const double first = dof == Eigen::Index(n) ? 0.0 : 1.0;
      EXPECT_EQ(u[0], 0.5 * (1.0 - first / n));
      EXPECT_NEAR(0.5 * u.dot(system.stiffness * u), 2.0 * u[0], 1e-14);
      EXPECT_NEAR(system.stiffness.row(dof - 1).sum(), 8.0 * n, 1e-12);
    }
    EXPECT_LT(before, 0.06);
  }
}

TEST(StringCases, AreRefusedWithTheReason) {
  for (const double share : {-0.1, 1.0})
    EXPECT_REFUSED(make("string-over-point", {{"share", share}}), "out-of-range", "share");
  EXPECT_REFUSED(make("string-over-point", {{"H", 0.0}}), "out-of-range", "H");
  EXPECT_REFUSED(make("string-over-point", {{"eta", 0.5}}), "out-of-range", "no impacts");
}

}  // namespace
}  // namespace clackers::cases
