#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/cases/testing/constants.hpp"
#include "clackers/exact/certified/digits.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/wide.hpp"

// The cases with dry friction, against Taylor series of the equation of motion with changes of stick and slip
// found by bisection: neither sines nor numbers of half swings.
namespace clackers::cases {
namespace {

using exact::testing_oracle::Box;
using exact::testing_oracle::trials;
using model::Side;

template <class Number>
struct Simulation {
  Number least = std::numeric_limits<Number>::epsilon();
  Number m, k, limit, kinetic, belt, t = 0, u, v;
  Number cosine = 0, sine = 0, W = 0;  // the load is `cosine`, -`sine`/W times W is its rate
  int sign = 0;

  explicit Simulation(const model::ImpactProblem<>& p)
      : m(p.system.mass(0, 0)),
        k(p.system.stiffness(0, 0)),
        limit(p.frictions[0].limit),
        kinetic(p.frictions[0].kinetic),
        belt(p.frictions[0].velocity),
        u(p.start.u[0]),
        v(p.start.v[0]) {
    if (const auto* load = p.system.add_load.target<model::HarmonicLoad>()) {
      const auto& f = load->forces().at(0);
      cosine = f.amplitude * cos(Number(f.phase));
      sine = f.amplitude * sin(Number(f.phase));
      W = f.frequency;
    }
    decide();
  }
  Number push() const { return cosine - k * u; }
  void decide() {
    const Number held = push();
    sign = abs(held) <= limit * (1 + least / 6) ? 0 : held > 0 ? 1 : -1;
  }
  // The state h later, while neither stick nor slip changes.
  Simulation after(const Number& h) const {
    Simulation next = *this;
    next.t += h;
    constexpr int terms = 40;  // of 0.05/k! at most
    Number un = u, vn = v, cn = cosine, sn = sine, power = 1;
    Number sum_u = 0, sum_v = 0, sum_c = 0, sum_s = 0;
    for (int n = 0; n < terms; ++n) {
      sum_u += un * power;
      sum_v += vn * power;
      sum_c += cn * power;
      sum_s += sn * power;
      const Number constant = n == 0 ? Number(-sign * kinetic) : Number(0);
      const Number a = sign == 0 ? Number(0) : Number((cn - k * un + constant) / m);
      const Number u1 = vn / (n + 1), v1 = a / (n + 1), c1 = -W * sn / (n + 1),
                   s1 = W * cn / (n + 1);
      un = u1, vn = v1, cn = c1, sn = s1;
      power *= h;
    }
    next.u = sum_u, next.v = sum_v, next.cosine = sum_c, next.sine = sum_s;
    return next;
  }
  bool goes_on() const {
    return sign == 0 ? abs(push()) <= limit * (1 + least / 6) : sign * (v - belt) >= 0;
  }
  void run_to(const Number& end) {
    const Number own = sqrt(k / m), w = W > own ? W : own, longest = Number(0.05) / w;
    while (t < end) {
      const Number left = end - t, h = left < longest ? left : longest;
      auto next = after(h);
      if (next.goes_on() || h < least * (t + 1 / w)) {
        *this = next;
        continue;
      }
      Number inside = 0, outside = h;
      for (int i = 0; i < std::numeric_limits<Number>::digits + 6; ++i) {
        const Number middle = (inside + outside) / 2;
        (after(middle).goes_on() ? inside : outside) = middle;
      }
      *this = after(outside);
      const bool stuck = sign == 0;
      if (!stuck) v = belt;
      decide();
      if (stuck && sign == 0) sign = push() > 0 ? 1 : -1;
    }
  }
};

void expect_simulated(Box& box, const Case& test_case) {
  Simulation<long double> simulation(test_case.problem);
  const auto& motion = *test_case.motion;
  const auto size = motion.envelope(0.0);
  const double end = motion.end();
  for (int i = 1; i <= 6; ++i) {
    const double t = end * (i - box.uniform(0.0, 1.0)) / 6.0;
    simulation.run_to(t);
    const auto now = motion.at(t, Side::right), bound = motion.error_bound(t);
    // The problem's own numbers are rounded: near resonance a phase with the amplitude's factor, on a slow belt
    // a place that shifts the time of slip. So is the simulation, step by step.
    const double load = double(std::hypot(simulation.cosine, simulation.sine)),
                 belt = test_case.problem.frictions[0].velocity,
                 own = (2e-16 + 2e-16 * t / test_case.damped_periods[0]) *
                       (load > 0.0 ? 20.0 : 1.0) * (belt > 0.0 ? 1.0 + size.v[0] / belt : 1.0);
    EXPECT_NEAR(now.u[0], double(simulation.u), bound.u[0] + own * size.u[0]) << "t = " << t;
    EXPECT_NEAR(now.v[0], double(simulation.v), bound.v[0] + own * 4.0 * size.v[0]) << "t = " << t;
    EXPECT_LE(std::abs(now.u[0]), size.u[0] * (1.0 + 1e-15));
    EXPECT_LE(std::abs(now.v[0]), size.v[0] * (1.0 + 1e-15));
    // m a = load - k u + friction.
    const auto& f = test_case.problem.frictions[0];
    const double friction = motion.contact_forces(t, Side::right)[0];
    if (simulation.sign != 0) {
      EXPECT_NEAR(friction, -simulation.sign * f.kinetic,
                  1e-14 * (f.limit + double(simulation.k) * size.u[0] + load));
    } else {
      EXPECT_LE(std::abs(friction), f.limit * (1.0 + 1e-14));
    }
  }
}

TEST(FrictionCases, SlidersComeToRestAsTheirTaylorSeries) {
  Box box(101);
  for (int trial = 0; trial < trials(40); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 101, trial " << trial);
    const double m = box.decades(-1.0, 1.0), k = box.decades(-1.0, 1.0),
                 x0 = box.decades(-2.0, 2.0), F = k * x0 * box.uniform(0.02, 0.99);
    const double T = std::numbers::pi * std::sqrt(m / k), n = std::ceil(0.5 * (k * x0 / F - 1.0));
    const auto slider =
        make("slider", {{"m", m}, {"k", k}, {"F", F}, {"x0", x0}, {"t_end", (n + 1.0) * T}});
    EXPECT_NEAR(constant(slider, "t_rest"), n * T, 1e-14 * n * T);
    expect_simulated(box, slider);
    EXPECT_EQ(slider.motion->at(slider.motion->end(), Side::left).v[0], 0.0);
  }
}

TEST(FrictionCases, BeltsDragAsTheirTaylorSeries) {
  Box box(102);
  for (int trial = 0; trial < trials(40); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 102, trial " << trial);
    const double m = box.decades(-1.0, 1.0), k = box.decades(-1.0, 1.0),
                 Fs = box.decades(-1.0, 1.0), Fd = Fs * box.uniform(0.0, 0.95),
                 w = std::sqrt(k / m), V = box.decades(-1.5, 1.0) * w * (Fs - Fd) / k;
    const auto belt =
        make("belt", {{"m", m}, {"k", k}, {"Fs", Fs}, {"Fd", Fd}, {"V", V}, {"t_end", 1.0}});
    const double T = constant(belt, "T");
    expect_simulated(
        box,
        make("belt", {{"m", m}, {"k", k}, {"Fs", Fs}, {"Fd", Fd}, {"V", V}, {"t_end", 2.7 * T}}));
  }
}

TEST(FrictionCases, ForcedSlidersSwingAsTheirTaylorSeries) {
  Box box(103);
  int made = 0;
  for (int trial = 0; made < trials(40); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 103, trial " << trial);
    const double m = box.decades(-1.0, 1.0), k = box.decades(-1.0, 1.0), P = box.decades(-1.0, 1.0),
                 W = std::sqrt(k / m) * box.uniform(0.3, 2.5), F = P * box.uniform(0.01, 0.7);
    try {
      const auto forced = make("forced-slider", {{"m", m},
                                                 {"k", k},
                                                 {"F", F},
                                                 {"P", P},
                                                 {"W", W},
                                                 {"t_end", 5.0 * std::numbers::pi / W}});
      ++made;
      expect_simulated(box, forced);
    } catch (const InputError& error) {
      EXPECT_EQ(error.code().name(), "not-admissible");
      ASSERT_LT(trial, 20 * (made + 20));
    }
  }
  expect_simulated(box, make("forced-slider", {{"F", 0.8174}}));  // it nearly stops where it turns
}

#ifdef CLACKERS_HAS_ARB
// With 90 digits, from the first of those given: the problem's doubles are rounded starts and phases.
TEST(FrictionCases, DigitsAreThoseOfTheirTaylorSeries) {
  using exact::testing_oracle::Real;
  for (const auto& [name, settings] :
       {std::pair<const char*, Settings>{"slider", {{"m", 0.7}, {"F", 0.09}}},
        {"belt", {{"Fd", 0.3}, {"V", 0.4}}},
        {"forced-slider", {{"k", 1.3}, {"F", 0.2}, {"W", 1.9}}}}) {
    const auto test_case = make(name, settings);
    certified::Digits digits(*test_case.motion, 70);
    const auto start = digits.at(0.0, Side::right);
    Simulation<Real> simulation(test_case.problem);
    simulation.u = Real(start.u[0]);
    simulation.v = Real(start.v[0]);
    if (simulation.W != 0) {
      // Friction, against the motion to come, is what load and spring leave of m a.
      const Real a(start.a[0]),
          square = simulation.cosine * simulation.cosine + simulation.sine * simulation.sine;
      simulation.cosine = simulation.m * a + simulation.k * simulation.u +
                          (a > 0 ? simulation.kinetic : -simulation.kinetic);
      const Real sine = sqrt(square - simulation.cosine * simulation.cosine);
      simulation.sine = simulation.sine > 0 ? sine : Real(-sine);
      simulation.decide();
    }
    for (int i = 1; i <= 12; ++i) {
      const double t = test_case.motion->end() * i / 13.0;
      simulation.run_to(t);
      const auto now = digits.at(t, Side::right);
      EXPECT_LE(abs(Real(Real(now.u[0]) - simulation.u)), Real("1e-60")) << name << " at " << t;
      EXPECT_LE(abs(Real(Real(now.v[0]) - simulation.v)), Real("1e-60")) << name << " at " << t;
    }
  }
}

#endif

// The disk impact by impact with 90 digits, from its velocities alone.
struct Throw {
  using Real = exact::testing_oracle::Real;
  Real g, eta, mu, beta, t = 0, x = 0, y = 0, phi = 0, vx = 0, vy = 0, w = 0;
  long long impacts = 0, slides = 0;
  Real V = 0, rest = 0;  // of the first impact, and when the last flight is over

  void fly(const Real& s) {
    x += vx * s, phi += w * s, y += s * (vy - g * s / 2), vy -= g * s, t += s;
  }
  Real flight() const { return (vy + sqrt(vy * vy + 2 * g * y)) / g; }
  void collide() {
    const Real U = -vy, slip = vx + w, ends = slip / (1 + 1 / beta), most = mu * (1 + eta) * U;
    if (V == 0) V = U;
    const bool is_rolled = abs(ends) <= most;
    const Real impulse = is_rolled ? ends : slip > 0 ? most : Real(-most);
    vx -= impulse, w -= impulse / beta, vy = eta * U, y = 0, ++impacts;
    if (!is_rolled) ++slides;
  }
  bool is_resting() const { return impacts > 0 && vy < Real(1e-45) * V; }
  // Up to t1, or through all impacts and to the end of the slip.
  void run(const Real& t1) {
    while (!is_resting()) {
      const Real s = flight();
      if (t + s > t1) return fly(t1 - t);
      fly(s), collide();
    }
    if (rest == 0) rest = t, vy = 0;
    const Real slip = vx + w, sign = slip < 0 ? -1 : 1, a = mu * g;
    Real s = t1 - t;
    if (abs(slip) > Real(1e-40) * V && a > 0) {
      const Real until = abs(slip) / (a * (1 + 1 / beta)), brakes = s < until ? s : until;
      x += brakes * (vx - sign * a * brakes / 2), vx -= sign * a * brakes;
      phi += brakes * (w - sign * a / beta * brakes / 2), w -= sign * a / beta * brakes;
      s -= brakes, t += brakes;
    }
    x += vx * s, phi += w * s, t += s;
  }
};

TEST(FrictionCases, DisksBounceAsTheirImpactsOneByOne) {
  Box box(104);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 104, trial " << trial);
    const auto velocity = [&] {
      return box.one_in(5) ? 0.0 : (box.one_in(2) ? 1.0 : -1.0) * box.decades(-1.0, 1.5);
    };
    const double h0 = box.one_in(8) ? 0.0 : box.decades(-1.0, 1.0),
                 v0 = h0 == 0.0 ? box.decades(-1.0, 1.0) : velocity(), g = box.decades(-1.0, 1.0),
                 eta = box.one_in(8)    ? 0.0
                       : box.one_in(40) ? 0.99
                                        : box.uniform(0.05, 0.95),
                 mu = box.one_in(8) ? 0.0 : box.decades(-2.5, 0.5), vx0 = velocity(),
                 w0 = box.one_in(6) ? -vx0 : velocity(), beta = box.decades(-1.0, 0.0);
    Throw known{g, eta, mu, beta};
    known.y = h0, known.vx = vx0, known.vy = v0, known.w = w0;
    Throw ahead = known;
    ahead.run(1e30);
    const double rest = double(ahead.rest), V = double(ahead.V), end = 3.0 * rest;
    const auto disk = make("oblique-disk", {{"h0", h0},
                                            {"v0", v0},
                                            {"vx0", vx0},
                                            {"w0", w0},
                                            {"g", g},
                                            {"eta", eta},
                                            {"mu", mu},
                                            {"beta", beta},
                                            {"t_end", end}});
    const auto& motion = *disk.motion;
    EXPECT_NEAR(constant(disk, "V"), V, 1e-15 * V);
    EXPECT_NEAR(constant(disk, "t_rest"), rest, 1e-15 * rest);
    const auto size = motion.envelope(0.0);
    std::optional<certified::Digits> digits;
#ifdef CLACKERS_HAS_ARB
    digits.emplace(motion, 35);
#endif
    const auto expect_digits = [&](const std::vector<std::string>& texts, const Throw::Real* values,
                                   const Eigen::VectorXd& scale) {
      for (int j = 0; j < 3; ++j)
        EXPECT_LE(abs(Throw::Real(texts[std::size_t(j)]) - values[j]),
                  Throw::Real(1e-34) * scale[j])
            << j;
    };
    for (int i = 1; i <= 12; ++i) {
      // Ever nearer to where the impacts accumulate, then beyond.
      const double t = i <= 8 ? rest * (1.0 - std::pow(0.1, box.uniform(0.0, 1.0) * 12.0))
                              : rest * box.uniform(1.0, 3.0);
      auto now = known;
      now.run(t);
      const auto found = motion.at(t, Side::right), bound = motion.error_bound(t);
      const Throw::Real u[] = {now.x, now.y, now.phi}, v[] = {now.vx, now.vy, now.w};
      for (int j = 0; j < 3; ++j) {
        EXPECT_LE(abs(found.u[j] - u[j]), bound.u[j]) << "t = " << t << ", u" << j + 1;
        EXPECT_LE(abs(found.v[j] - v[j]), bound.v[j]) << "t = " << t << ", v" << j + 1;
        EXPECT_LE(bound.u[j], 3e-16 * size.u[j]);
        EXPECT_LE(bound.v[j], 3e-16 * size.v[j]);
        EXPECT_LE(std::abs(found.u[j]), size.u[j] * (1.0 + 1e-15));
        EXPECT_LE(std::abs(found.v[j]), size.v[j] * (1.0 + 1e-15));
      }
      if (digits) {
        const auto texts = digits->at(t, Side::right);
        expect_digits(texts.u, u, size.u);
        expect_digits(texts.v, v, size.v);
      }
      const auto forces = motion.contact_forces(t, Side::right);
      EXPECT_EQ(forces[0], t < rest ? 0.0 : g);
      EXPECT_EQ(forces[1], found.a[0]);
      EXPECT_NEAR(forces[1], beta * found.a[2], 1e-15 * mu * g);
      EXPECT_LE(std::abs(forces[1]), mu * forces[0] * (1.0 + 1e-15));
      EXPECT_EQ(motion.impact_count(t), std::min(now.impacts, motion.impact_count(end)));
    }
    auto thrown = known;
    for (long long k = 1; k <= std::min(40LL, motion.impact_count(end)); ++k) {
      const auto impact = motion.impact(k);
      thrown.fly(thrown.flight());
      EXPECT_LE(abs(impact.t - thrown.t), 0.5 * (impact.when.hi - impact.when.lo));
      const auto expect = [&](const model::Kinematics& found, double a) {
        EXPECT_NEAR(found.v[0], double(thrown.vx), 1e-15 * size.v[0]);
        EXPECT_NEAR(found.v[1], double(thrown.vy), 1e-15 * size.v[1]);
        EXPECT_NEAR(found.v[2], double(thrown.w), 1e-15 * size.v[2]);
        EXPECT_NEAR(found.u[0], double(thrown.x), 1e-15 * size.u[0]);
        EXPECT_EQ(found.u[1], 0.0);
        EXPECT_NEAR(found.u[2], double(thrown.phi), 1e-15 * size.u[2]);
        EXPECT_EQ(found.a[1], a);
      };
      expect(impact.before, -g);
      const Throw::Real U = -thrown.vy;
      thrown.collide();
      expect(impact.after, eta > 0.0 ? -g : 0.0);
      if (digits) {
        const auto hit = digits->impact(k);
        const Throw::Real velocities[] = {thrown.vx, thrown.vy, thrown.w};
        expect_digits(hit.after.v, velocities, size.v);
        EXPECT_LE(abs(Throw::Real(hit.t) - thrown.t), Throw::Real(1e-34) * thrown.t);
      }
      EXPECT_NEAR(
          impact.energy_after,
          double(thrown.vx * thrown.vx + thrown.vy * thrown.vy + beta * thrown.w * thrown.w) / 2,
          1e-15 * size.v.squaredNorm());
      EXPECT_NEAR(impact.impulse, double((1 + thrown.eta) * U), 1e-15 * V);
    }
    // It slides through impacts, or on the floor.
    ahead.run(1e30);
    const double slides = constant(disk, "slides"), t_roll = constant(disk, "t_roll");
    if (slides < 40.0) {
      EXPECT_EQ(slides, double(ahead.slides));
      EXPECT_EQ(t_roll, slides + 1 > double(motion.impact_count(end))
                            ? constant(disk, "t_rest")
                            : motion.impact(static_cast<long long>(slides) + 1).t);
    }
    if (t_roll < HUGE_VAL) {
      EXPECT_NEAR(constant(disk, "v_roll"), double(ahead.vx), 1e-15 * size.v[0]);
      EXPECT_NEAR(constant(disk, "v_roll"), -double(ahead.w), 1e-15 * size.v[2]);
    }
  }
}

TEST(FrictionCases, HaveTheirTextbookNumbers) {
  const auto forced = make("forced-slider");
  EXPECT_NEAR(constant(forced, "amplitude"), 2.501787881, 1e-9);
  const auto slider = make("slider", {{"F", 0.25}, {"x0", 1.25}});  // |k u| = F holds
  EXPECT_EQ(constant(slider, "half_swings"), 2.0);
  EXPECT_EQ(constant(slider, "u_rest"), 0.25);
  EXPECT_NEAR(constant(slider, "lost"), 0.5 * (1.5625 - 0.0625), 1e-15);
  // The energy of the spring before and after, just above F/k.
  for (const double x0 : {0.7 / 3.0 + 0x1p-54, 0.7 / 3.0 + 0x1p-50, 0.3, 0.9, 5.0}) {
    using Number = numerics::WideReal;
    const auto rough = make("slider", {{"k", 3.0}, {"F", 0.7}, {"x0", x0}});
    const Number rest = abs(Number(3.0) * x0 - 2.0 * constant(rough, "half_swings") * Number(0.7)),
                 lost = (Number(9.0) * x0 * x0 - rest * rest) / 6.0;
    EXPECT_NEAR(constant(rough, "lost"), double(lost), 1e-15 * double(lost)) << x0;
  }
  const auto belt = make("belt");
  EXPECT_EQ(constant(belt, "T_stick"), 4.0);
  EXPECT_NEAR(constant(belt, "T_slip"), 2.0 * (std::numbers::pi - std::atan(2.0)), 1e-15);
  for (const double V : {1e-8, 1e-14})
    EXPECT_NEAR(constant(make("belt", {{"V", V}}), "T_slip"),
                double(2.0L * (std::numbers::pi_v<long double> - std::atan(0.5L / V))), 1e-15);
  EXPECT_EQ(belt.motion->at(2.0, Side::right).v[0], 0.25);
  EXPECT_EQ(belt.motion->at(4.0, Side::left).a[0], 0.0);
  EXPECT_EQ(belt.motion->at(4.0, Side::right).a[0], -0.5);
  // A disk that slides on the floor after t = 3, with the slip 9 - 6 = 3, for 3/(3 mu g) s.
  const auto disk = make("oblique-disk",
                         {{"g", 2.0}, {"eta", 0.5}, {"mu", 1.0 / 3.0}, {"vx0", 9.0}, {"w0", 0.0}});
  EXPECT_EQ(constant(disk, "V"), 2.0);
  EXPECT_EQ(constant(disk, "t_rest"), 3.0);
  EXPECT_EQ(constant(disk, "slides"), HUGE_VAL);
  EXPECT_NEAR(constant(disk, "t_roll"), 4.5, 1e-15);
  EXPECT_EQ(constant(disk, "v_roll"), 6.0);
  EXPECT_NEAR(disk.motion->at(3.0, Side::right).v[0], 7.0, 1e-15);
  EXPECT_NEAR(disk.motion->at(3.0, Side::right).a[0], -2.0 / 3.0, 1e-16);
  EXPECT_NEAR(disk.motion->at(3.0, Side::right).a[2], -4.0 / 3.0, 1e-16);
  EXPECT_EQ(disk.motion->at(4.5, Side::right).v[0], 6.0);
  EXPECT_EQ(disk.motion->at(4.5, Side::right).v[2], -6.0);
  const auto closed = disk.motion->closed_contacts().at(0);
  EXPECT_EQ(closed.from, 3.0);
  EXPECT_EQ(closed.until, 5.0);
  EXPECT_TRUE(closed.accumulates && !closed.opens);
  EXPECT_LE(closed.resolved, 3.0);
  EXPECT_GE(closed.resolved, 3.0 * (1.0 - 1e-15));
  EXPECT_EQ(disk.motion->contact_forces(3.0, Side::left)[0], 0.0);
  EXPECT_EQ(disk.motion->contact_forces(3.0, Side::right)[0], 2.0);
  EXPECT_EQ(disk.problem.contacts.at(0).restitution, 0.5);
  // A slip that ends with the impacts, and one that never is.
  const auto tie =
      make("oblique-disk", {{"g", 2.0}, {"eta", 0.5}, {"mu", 0.25}, {"vx0", 4.5}, {"w0", 0.0}});
  EXPECT_EQ(constant(tie, "slides"), HUGE_VAL);
  EXPECT_EQ(constant(tie, "t_roll"), 3.0);
  EXPECT_EQ(tie.motion->at(3.0, Side::right).v[0], 3.0);
  EXPECT_EQ(constant(make("oblique-disk", {{"mu", 0.0}, {"w0", -4.0}}), "slides"), 0.0);
  EXPECT_FALSE(make("oblique-disk", {{"eta", 0.0}}).motion->closed_contacts().at(0).accumulates);
  EXPECT_TRUE(make("oblique-disk", {{"t_end", 4.0}}).motion->closed_contacts().empty());
  // The most impacts, of which many share a double.
  const auto lively = make("oblique-disk", {{"eta", 0.9995}, {"t_end", 2000.0}});
  EXPECT_GT(lively.motion->impact_count(2000.0), 50000);
  EXPECT_EQ(lively.motion->at(constant(lively, "t_rest"), Side::right).v[1], 0.0);
}

#ifdef CLACKERS_HAS_ARB
// Beside its enclosure.
TEST(FrictionCases, AForcedSliderNearResonanceHasAllDigitsOfItsAmplitude) {
  for (const double W : {1.0 + 1e-5, 1.0 - 3e-8, 1.0 + 1e-11}) {
    const auto forced = make("forced-slider", {{"W", W}});
    const double amplitude =
        std::stod(certified::Digits(*forced.motion, 25).at(0.0, Side::right).u[0]);
    EXPECT_NEAR(constant(forced, "amplitude"), amplitude, 1.2e-16 * amplitude) << W;
  }
}
#endif

TEST(FrictionCases, AreRefusedWithTheReason) {
  EXPECT_REFUSED(make("slider", {{"F", 2.0}}), "not-admissible", "never moves");
  EXPECT_REFUSED(make("slider", {{"F", 1e-11}}), "out-of-range", "half swings");
  EXPECT_REFUSED(make("belt", {{"Fd", 1.0}}), "not-admissible", "no stick and slip");
  EXPECT_REFUSED(make("forced-slider", {{"W", 1.0}}), "not-admissible", "resonance");
  EXPECT_REFUSED(make("forced-slider", {{"F", 0.9}}), "not-admissible", "stop",
                 "F < 0.81740638571088");
  EXPECT_REFUSED(make("forced-slider", {{"F", 0.81741}}), "not-admissible", "turning points");
  EXPECT_NO_THROW(make("forced-slider", {{"F", 0.817406}}));
  // sqrt(k/m)/W is 5, 5.02 and 6.98: at an odd number and near two.
  const auto expect_resonance = [](double W, std::string_view harmonic) {
    EXPECT_REFUSED(make("forced-slider", {{"W", W}}), "not-admissible", harmonic, "resonance");
  };
  expect_resonance(0.2, "n is 5");
  expect_resonance(1.0 / 5.02, "n is 5");
  expect_resonance(1.0 / 6.98, "n is 7");
  EXPECT_REFUSED(make("oblique-disk", {{"eta", 0.9996}}), "out-of-range", "1e5 impacts");
  EXPECT_REFUSED(make("oblique-disk", {{"h0", 0.0}}), "out-of-range", "on the floor");
}

}  // namespace
}  // namespace clackers::cases
