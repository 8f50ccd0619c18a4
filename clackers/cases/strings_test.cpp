#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/cases/testing/characteristics.hpp"
#include "clackers/cases/testing/constants.hpp"
#include "clackers/exact/bodies/bar_mesh.hpp"
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
  Case make(const char* name, const char* parameter, double share, double end) const {
    return cases::make(name, {{"L", L},
                              {"T", T},
                              {"rho", rho},
                              {"H", H},
                              {parameter, share},
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
    const auto mesh =
        p.make("string-over-point", "share", 1.0 - double(gap) / cells, (steps + 1) * dt);
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
      EXPECT_NEAR(string.impulse(t, Side::right).nearest(), known.impulse * z * V * dt,
                  scale * k * z * V * dt);
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
    const auto string = p.make("string-over-point", "share", share, end).bars;
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
  EXPECT_EQ(constant(other, "impulse"), string.impulse(4.0, Side::right).nearest());
  EXPECT_EQ(string.impulse(4.0, Side::right).nearest(), 10.0);
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

// The free string by images of its start, and |w| with 90 digits; rates by differences, which are exact away from kinks.
struct Images {
  Real L, H, a, c;
  Real start(Real x) const {
    Real sign = 1;
    for (bool inside = false; !inside;) {
      inside = true;
      if (x < 0) x = -x, sign = -sign, inside = false;
      if (x > L) x = 2 * L - x, sign = -sign, inside = false;
    }
    return sign * H * (x < a ? Real(x / a) : Real((L - x) / (L - a)));
  }
  Real free(const Real& x, const Real& t) const {
    return (start(x + c * t) + start(x - c * t)) / 2;
  }
  Real u(const Real& x, const Real& t) const { return abs(free(x, t)); }
  Real v(const Real& x, const Real& t) const {
    const Real dt = Real(1e-40) * L / c;
    return (u(x, t + dt) - u(x, t - dt)) / (2 * dt);
  }
  Real slope(const Real& x, const Real& t) const {
    const Real dx = Real(1e-40) * L;
    return (u(x + dx, t) - u(x - dx, t)) / (2 * dx);
  }
  // Between the corners, images of the pluck, the free string is straight.
  std::vector<Real> corners_and_zeros(const Real& t) const {
    std::vector<Real> list{0, L};
    for (int k = -12; k <= 12; ++k)
      for (const Real& from : {a, Real(-a)})
        for (const Real& x : {Real(2 * k * L + from + c * t), Real(2 * k * L + from - c * t)})
          if (x > 0 && x < L) list.push_back(x);
    std::sort(list.begin(), list.end());
    for (std::size_t i = 0, n = list.size(); i + 1 < n; ++i) {
      const Real low = free(list[i], t), high = free(list[i + 1], t);
      if (low * high < 0) list.push_back(list[i] + (list[i + 1] - list[i]) * low / (low - high));
    }
    return list;
  }
  // Of the slopes at both ends, up to t.
  std::vector<Real> changes(const Real& t) const {
    std::vector<Real> list{0, t};
    for (int k = 0; k <= 12; ++k)
      for (const Real& from : {a, Real(-a)})
        if (const Real at = (k * L + from) / c; at > 0 && at < t) list.push_back(at);
    return list;
  }
};

// Of a function that is constant between these places.
template <class Function>
Real integral(std::vector<Real> places, const Function& f) {
  std::sort(places.begin(), places.end());
  Real sum = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    sum += (places[i + 1] - places[i]) * f(Real((places[i] + places[i + 1]) / 2));
  return sum;
}

TEST(StringCases, AStringOnAnObstacleIsItsReflectedImages) {
  Box box(96);
  for (int trial = 0; trial < trials(20); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 96, trial " << trial);
    const RandomString p(box);
    const double place = box.one_in(6)   ? 0.5
                         : box.one_in(4) ? box.decades(-12.0, -0.5)
                         : box.one_in(4) ? 1.0 - box.decades(-12.0, -0.5)
                                         : box.uniform(0.05, 0.95),
                 tau = 2.0 * p.tau(), end = tau * box.decades(0.0, 1.0);
    const auto known = p.make("string-on-obstacle", "place", place, end);
    const auto& string = *known.bars;
    const Images images{p.L, p.H, Real(place) * Real(p.L), sqrt(Real(p.T) / Real(p.rho))};
    const double sharp = std::min(place, 1.0 - place), V = p.H / tau / sharp;
    for (int i = 0; i < 20; ++i) {
      const double t = box.uniform(0.0, end), x = box.uniform(0.0, p.L);
      const auto now = string.at(0, x, t, Side::right);
      const Real u = images.u(x, t), force = Real(p.T) * images.slope(x, t);
      EXPECT_LE(abs(Real(double(now.u.value)) - u), Real(1.2e-16 * p.H));
      EXPECT_LE(double(now.u.error), 1e-18 * p.H);
      EXPECT_NEAR(now.v.nearest(), double(images.v(x, t)), 1e-15 * V);
      EXPECT_NEAR(now.stress.nearest(), double(force), 1e-15 * p.T * p.H / p.L / sharp);
      for (const double end_point : {0.0, p.L}) {
        EXPECT_EQ(string.at(0, end_point, t, Side::right).u.nearest(), 0.0);
        EXPECT_EQ(string.at(0, end_point, t, Side::left).v.nearest(), 0.0);
      }
    }
    // Between two doubles.
    if (const double touch = constant(known, "t_closes1"); place != 0.5) {
      EXPECT_EQ(string.force(touch, Side::left).nearest(), 0.0);
      EXPECT_GT(string.force(touch, Side::right).nearest(), 0.0);
    }
    // The momentum that neither the string nor its ends have is the obstacle's.
    const double t = box.uniform(0.0, end);
    const auto v = [&](const Real& x) { return images.v(x, t); };
    const auto ends = [&](const Real& at) {
      const Real dx = Real(1e-30) * p.L;
      return Real(images.slope(p.L - dx, at) - images.slope(dx, at));
    };
    const auto places = images.corners_and_zeros(t);
    const Real impulse =
        Real(p.rho) * integral(places, v) - Real(p.T) * integral(images.changes(t), ends);
    const double unit = 4.0 * p.T * p.H * tau / p.L;
    EXPECT_NEAR(string.impulse(t, Side::right).nearest(), double(impulse), 1e-14 * unit / sharp);
    const auto energy = string.energy(t);
    const auto square = [&](const Real& x) { return Real(v(x) * v(x)); };
    const auto tilt = [&](const Real& x) { return Real(pow(images.slope(x, t), 2)); };
    const double kinetic = double(Real(p.rho) / 2 * integral(places, square)),
                 elastic = double(Real(p.T) / 2 * integral(places, tilt)), all = kinetic + elastic;
    EXPECT_NEAR(energy.kinetic.nearest(), kinetic, 1e-14 * all);
    EXPECT_NEAR(energy.elastic.nearest(), elastic, 1e-14 * all);
    // The force is the rate of the impulse, away from where it jumps.
    const double dt = 1e-6 * tau, force = string.force(t, Side::right).nearest(),
                 gained = (string.impulse(t + dt, Side::left) - string.impulse(t, Side::right))
                              .nearest();
    if (force == string.force(t + dt, Side::left).nearest()) {
      EXPECT_NEAR(gained, force * dt, 1e-14 * unit);
    }
  }
}

// Without |w|: the scheme of Paoli and Schatzman, whose nodes come back from the obstacle one by one.
double error_of_scheme(double place, int n) {
  const auto test_case = make("string-on-obstacle", {{"place", place}, {"elements", 2.0}});
  constexpr double courant = 0.7;
  std::vector<double> u, last, next(std::size_t(n) + 1, 0.0);
  for (int j = 0; j <= n; ++j)
    u.push_back(std::min(j / (n * place), (n - j) / (n * (1.0 - place))));
  const auto free_mean = [&](std::size_t j) {
    return u[j] + 0.5 * courant * courant * (u[j - 1] - 2.0 * u[j] + u[j + 1]);
  };
  last = u;
  for (std::size_t j = 1; j < std::size_t(n); ++j)
    last[j] = free_mean(j);  // a step before: at rest
  double worst = 0.0;
  for (int k = 1; k * courant / n <= test_case.problem.end; ++k) {
    for (std::size_t j = 1; j < std::size_t(n); ++j)
      next[j] = 2.0 * std::max(0.0, free_mean(j)) - last[j];
    last.swap(u), u.swap(next);
    for (int j = 0; j <= n; j += n / 20) {
      const auto now = test_case.bars->at(0, double(j) / n, k * courant / n, Side::right);
      worst = std::max(worst, std::abs(u[std::size_t(j)] - now.u.nearest()));
    }
  }
  return worst;
}

TEST(StringCases, TheSchemeOfPaoliAndSchatzmanTendsToTheStringOnAnObstacle) {
  for (const double place : {0.25, 0.4, 0.5, 0.8}) {
    const double coarse = error_of_scheme(place, 80), fine = error_of_scheme(place, 640);
    EXPECT_LT(fine, 0.03) << place;
    EXPECT_LT(fine, 0.2 * coarse) << place;
  }
}

TEST(StringCases, AStringOnAnObstacleHasTheNumbersOfItsTouches) {
  const auto make_with = [](double place, double end) {
    return make("string-on-obstacle", {{"L", 4.0},
                                       {"T", 8.0},
                                       {"rho", 2.0},
                                       {"H", 0.5},
                                       {"place", place},
                                       {"elements", 8.0},
                                       {"t_end", end}});
  };
  // All points at once.
  const auto middle = make_with(0.5, 1.0);
  EXPECT_EQ(constant(middle, "c"), 2.0);
  EXPECT_EQ(constant(middle, "tau"), 2.0);
  EXPECT_EQ(constant(middle, "m"), 8.0);
  EXPECT_EQ(constant(middle, "period"), 2.0);
  EXPECT_EQ(constant(middle, "t_closes1"), 1.0);
  EXPECT_EQ(constant(middle, "t_opens1"), 1.0);
  EXPECT_EQ(constant(middle, "impulse1"), 8.0);
  EXPECT_EQ(constant(middle, "impulse"), 8.0);
  EXPECT_EQ(constant(middle, "h"), 0.5);
  for (const double x : {0.5, 2.0, 3.5}) {
    EXPECT_EQ(middle.bars->at(0, x, 1.0, Side::right).u.nearest(), 0.0);
    EXPECT_EQ(middle.bars->at(0, x, 1.0, Side::left).v.nearest(), -0.5);
    EXPECT_EQ(middle.bars->at(0, x, 1.0, Side::right).v.nearest(), 0.5);
  }
  EXPECT_EQ(middle.bars->impulse(1.0, Side::left).nearest(), 0.0);
  EXPECT_EQ(middle.bars->force(1.0, Side::left).nearest(), 0.0);
  EXPECT_EQ(middle.bars->force(1.0, Side::right).nearest(), 0.0);
  EXPECT_EQ(middle.bars->energy(1.0).elastic.nearest(), 0.0);
  EXPECT_EQ(middle.bars->energy(1.0).kinetic.nearest(), 1.0);
  // One after another, at either end first.
  for (const double place : {0.25, 0.75}) {
    const auto other = make_with(place, 4.0);
    const auto& string = *other.bars;
    EXPECT_EQ(constant(other, "period"), 4.0);
    EXPECT_EQ(constant(other, "t_closes1"), 0.5);
    EXPECT_EQ(constant(other, "t_opens1"), 1.5);
    EXPECT_EQ(constant(other, "impulse"), 16.0);
    for (const double at : {0.5, 2.5}) {
      EXPECT_EQ(string.force(at, Side::left).nearest(), 0.0);
      EXPECT_EQ(string.force(at, Side::right).nearest(), 8.0);
      EXPECT_EQ(string.force(at + 1.0, Side::left).nearest(), 8.0);
      EXPECT_EQ(string.force(at + 1.0, Side::right).nearest(), 0.0);
    }
    const double x = place == 0.25 ? 1.0 : 3.0;  // of the pluck, touched at 0.75 and 3.25
    for (const double touch : {0.75, 3.25}) {
      EXPECT_EQ(string.at(0, x, touch, Side::right).u.nearest(), 0.0);
      EXPECT_NEAR(string.at(0, x, touch, Side::left).v.nearest(), -2.0 / 3.0, 1e-16);
      EXPECT_NEAR(string.at(0, x, touch, Side::right).v.nearest(), 2.0 / 3.0, 1e-16);
    }
    EXPECT_NEAR(string.energy(1.0).kinetic.nearest(), 8.0 / 9.0, 1e-15);
    EXPECT_NEAR(string.energy(1.0).elastic.nearest(), 4.0 / 9.0, 1e-15);
    // At t = 0 the string is held before.
    EXPECT_EQ(string.at(0, x, 0.0, Side::left).v.nearest(), 0.0);
    EXPECT_NEAR(string.at(0, x, 0.0, Side::right).v.nearest(), -2.0 / 3.0, 1e-16);
  }
}

TEST(StringCases, MeshesTendToTheStringOnAnObstacle) {
  double before = HUGE_VAL;
  for (const double n : {8.0, 32.0}) {
    const auto mesh =
        make("string-on-obstacle", {{"rho", 3.0}, {"T", 2.0}, {"H", 0.5}, {"elements", n}});
    EXPECT_LT(constant(mesh, "e_space"), 0.35 * before);
    before = constant(mesh, "e_space");
    const auto& system = mesh.problem.system;
    EXPECT_NEAR(system.mass.sum(), 3.0 * (1.0 - 1.0 / n), 1e-14);
    const auto& u = mesh.problem.start.u;
    EXPECT_EQ(u[Eigen::Index(0.375 * n) - 1], 0.5);
    EXPECT_NEAR(0.5 * u.dot(system.stiffness * u), 0.25 / (0.375 * 0.625), 1e-14);
    EXPECT_NEAR(system.stiffness.row(0).sum(), 2.0 * n, 1e-12);
    EXPECT_NEAR(system.stiffness.sum(), 4.0 * n, 1e-12);
    ASSERT_EQ(double(mesh.problem.contacts.size()), n - 1.0);
    for (std::size_t i = 0; i < mesh.problem.contacts.size(); ++i) {
      const auto& contact = mesh.problem.contacts[i];
      EXPECT_EQ(contact.direction, Eigen::VectorXd::Unit(u.size(), Eigen::Index(i)));
      EXPECT_EQ(contact.gap, 0.0);
      EXPECT_EQ(contact.restitution, 1.0);
      EXPECT_NEAR(mesh.mesh->nodes[i + 1].x, double(i + 1) / n, 1e-15);
    }
  }
  EXPECT_LT(before, 0.06);
  // Mirrored impacts at the same instants, each of a contact of its own.
  const auto middle = make("string-on-obstacle", {{"place", 0.5}, {"elements", 15.0}});
  for (long long k = 1; k < 14; k += 2) {
    const auto impact = middle.motion->impact(k), next = middle.motion->impact(k + 1);
    EXPECT_EQ(impact.contact + next.contact, 13);
    EXPECT_NEAR(impact.t, next.t, 1e-10);
  }
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
  for (const double place : {0.0, 1.0})
    EXPECT_REFUSED(make("string-on-obstacle", {{"place", place}}), "out-of-range", "ends");
  EXPECT_REFUSED(make("string-on-obstacle", {{"elements", 1.0}}), "out-of-range", "2 <= elements");
  EXPECT_REFUSED(make("string-on-obstacle", {{"elements", 2.5}}), "not-whole", "elements");
}

}  // namespace
}  // namespace clackers::cases
