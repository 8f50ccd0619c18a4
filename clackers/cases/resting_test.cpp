#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/cases/testing/constants.hpp"
#include "clackers/exact/certified/digits.hpp"
#include "clackers/exact/testing/test_oracle.hpp"
#include "clackers/numerics/wide.hpp"

// The cases that come to rest, against sums of their flights that use neither modes nor closed sums.
namespace clackers::cases {
namespace {

using exact::testing_oracle::Box;
using exact::testing_oracle::trials;
using Number = long double;

/// m = 1, u'' = -k u - G above u = 0, flight by flight; the impacts accumulate at `rest`.
struct Flights {
  Number k, G, eta, u0, v0, rest = 0, impulse = 0, V = 0;
  std::vector<std::pair<Number, Number>>
      starts{};  // instant and speed of each flight after the first

  Flights(Number k_, Number G_, Number eta_, Number u, Number v)
      : k(k_), G(G_), eta(eta_), u0(u), v0(v) {
    const Number w = std::sqrt(k);
    V = std::sqrt(v * v + (k * u + 2 * G) * u);
    rest = k == 0 ? (v + V) / G : (std::atan2(V, G / w) - std::atan2(-v, w * u + G / w)) / w;
    for (Number speed = V; speed > V * 1e-22L;) {
      impulse += (1 + eta) * speed;
      speed *= eta;
      if (speed == 0) break;
      starts.push_back({rest, speed});
      rest += k == 0 ? 2 * speed / G : 2 * std::atan(w * speed / G) / w;
    }
  }
  std::pair<Number, Number> at(Number t) const {
    if (t >= rest) return {0, 0};
    const auto next = std::ranges::upper_bound(starts, t, {}, [](auto& s) { return s.first; });
    const bool first = next == starts.begin();
    const Number s = first ? t : t - (next - 1)->first, u = first ? u0 : 0,
                 v = first ? v0 : (next - 1)->second;
    if (k == 0) return {u + s * (v - G * s / 2), v - G * s};
    const Number w = std::sqrt(k), c = std::cos(w * s), n = std::sin(w * s);
    return {u * c + v / w * n - 2 * G / k * std::pow(std::sin(w * s / 2), 2),
            v * c - (w * u + G / w) * n};
  }
};

void expect_flights(Box& box, const Case& test_case, const Flights& known, double m) {
  const auto& motion = *test_case.motion;
  const double rest = double(known.rest), speed = double(known.V);
  ASSERT_EQ(motion.closed_contacts().size(), 1u);
  const auto closed = motion.closed_contacts()[0];
  EXPECT_NEAR(constant(test_case, "t_rest"), rest, 1e-14 * rest);
  EXPECT_NEAR(constant(test_case, "V"), speed, 1e-15 * speed);
  EXPECT_LE(closed.begins.lo, rest * (1 + 1e-15));
  EXPECT_GE(closed.begins.hi, rest * (1 - 1e-15));
  EXPECT_NEAR(closed.from, rest, 1e-6 * rest);
  for (int i = 0; i < 12; ++i) {
    const double t = i < 8 ? box.uniform(0.0, test_case.problem.end)
                           : rest * (1.0 + (i % 2 == 0 ? 1.0 : -1.0) * box.decades(-9.0, -1.0));
    const auto state = motion.at(t, model::Side::right), bound = motion.error_bound(t);
    const auto [u, v] = known.at(t);
    // 64 bits of the simulation, whose errors the flights carry on.
    const double own = 1e-17 * (1.0 + t / rest);
    EXPECT_NEAR(state.u[0], double(u), bound.u[0] + own * speed * rest) << t;
    EXPECT_NEAR(state.v[0], double(v), bound.v[0] + own * 10.0 * speed) << t;
  }
  const double force = motion.contact_forces(test_case.problem.end, model::Side::left)[0];
  EXPECT_NEAR(force, m * double(known.G), 1e-12 * force);
}

TEST(RestingCases, BallsRestWhenTheirFlightsAreOver) {
  Box box(71);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 71, trial " << trial);
    const double h0 = box.decades(-2.0, 2.0), g = box.decades(-1.0, 2.0),
                 v0 = box.one_in(3) ? 0.0 : box.uniform(-5.0, 5.0),
                 eta = trial % 8 == 0 ? 0.0 : box.uniform(0.01, 0.95);
    const Flights known(0, g, eta, h0, v0);
    const auto ball =
        make("ball",
             {{"h0", h0}, {"v0", v0}, {"g", g}, {"eta", eta}, {"t_end", 1.3 * double(known.rest)}});
    expect_flights(box, ball, known, 1.0);
    EXPECT_NEAR(constant(ball, "impulse"), double(known.impulse), 1e-14 * double(known.impulse));
    EXPECT_NEAR(constant(ball, "lost"), double(known.V * known.V / 2),
                1e-15 * double(known.V * known.V));
  }
}

// By the time that is left until rest, in the unit that the first flight begins with.
TEST(RestingCases, BallsOfEachRestitutionAreRightToRounding) {
  using numerics::WideReal;
  const WideReal g = 9.81, V = sqrt(2 * g);
  for (const double eta : {0.5, 0.9, 0.999, 0.9999, 1.0 - 1e-9}) {
    const WideReal once = 1 - WideReal(eta), rest = V / g * (1 + WideReal(eta)) / once;
    const double end = 2.0 * double(rest);
    const auto ball = make("ball", {{"eta", eta}, {"t_end", end}});
    for (const double share : {0.3, 0.6143, 0.9, 0.999, 1.0 - 1e-5, 1.5}) {
      const double t = share * double(rest);
      SCOPED_TRACE(testing::Message() << "eta = " << eta << ", t = " << t);
      const WideReal left = (rest - t) * once * g / (2 * V);
      long long j = share > 1.0 ? 0 : static_cast<long long>(log(left) / log(WideReal(eta)));
      while (share < 1.0 && left <= pow(WideReal(eta), j + 1)) ++j;
      const WideReal power = share > 1.0 ? WideReal(0) : pow(WideReal(eta), j),
                     rho = share > 1.0 ? WideReal(1) : left / power;
      const double u = double(power * power * 4 / (once * once) * (1 - rho) * (rho - eta)),
                   v = double(power * V * (1 - 2 * (1 - rho) / once));
      const auto state = ball.motion->at(t, model::Side::right),
                 bound = ball.motion->error_bound(t);
      EXPECT_NEAR(state.u[0], u, bound.u[0]);
      EXPECT_NEAR(state.v[0], v, bound.v[0]);
      EXPECT_LE(bound.u[0], 0x1.01p-53 * u + 0x1p-57);
      EXPECT_LE(bound.v[0], 0x1.01p-53 * std::abs(v) + 0x1p-57);
      EXPECT_EQ(ball.motion->impact_count(t), share > 1.0 ? ball.motion->impact_count(end) : j);
    }
  }
}

TEST(RestingCases, PressedOscillatorsRestWhenTheirFlightsAreOver) {
  Box box(72);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 72, trial " << trial);
    const double m = box.decades(-1.0, 1.0), k = m * box.decades(-2.0, 2.0),
                 F = m * box.decades(-1.0, 1.0), u0 = box.decades(-2.0, 1.0),
                 v0 = box.one_in(2) ? 0.0 : box.uniform(-2.0, 2.0),
                 eta = trial % 8 == 0 ? 0.0 : box.uniform(0.01, 0.95);
    const Flights known(Number(k) / m, Number(F) / m, eta, u0, v0);
    const auto test_case = make("pressed-oscillator", {{"m", m},
                                                       {"k", k},
                                                       {"F", F},
                                                       {"u0", u0},
                                                       {"v0", v0},
                                                       {"eta", eta},
                                                       {"t_end", 1.3 * double(known.rest)}});
    expect_flights(box, test_case, known, m);
  }
}

TEST(RestingCases, AMassWithoutASpringHasNoStaticDisplacement) {
  const auto free = make("pressed-oscillator", {{"k", 0.0}});
  EXPECT_TRUE(std::ranges::none_of(free.constants, [](auto& c) { return c.name == "u_static"; }));
}

TEST(RestingCases, AHarmonicForceReleasesWhereItBalancesTheConstantOne) {
  const auto test_case = make("pressed-oscillator", {{"c", 0.1}, {"f1", 0.8}, {"phi", 0.4}});
  const double phase = std::acos(-0.5 / 0.8), release = constant(test_case, "t_release");
  EXPECT_NEAR(std::remainder(release + 0.4 - phase, 2.0 * std::numbers::pi), 0.0, 1e-12);
  EXPECT_GT(test_case.motion->closed_contacts().size(), 1u);
  const auto at = test_case.motion->at(release, model::Side::right);
  EXPECT_NEAR(at.v[0], 0.0, 1e-14);
  EXPECT_NEAR(at.a[0], 0.0, 1e-11);
}

TEST(RestingCases, APlasticPairIsTogetherAndApartByTurns) {
  Box box(73);
  const auto dyadic = [&](double low, double high) {
    return 0x1p-6 * std::floor(box.uniform(low, high) * 0x1p6);
  };
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 73, trial " << trial);
    const double m1 = dyadic(0.5, 3.0), m2 = dyadic(0.5, 3.0), W = dyadic(0.5, 2.0),
                 X = 3.0 + 2.0 * std::floor(box.uniform(0.0, 4.0)),
                 sigma = box.one_in(3) ? 0.0 : dyadic(0.02, 0.1), V = dyadic(0.25, 2.0);
    const auto pair = make(
        "plastic-pair",
        {{"m1", m1}, {"m2", m2}, {"X", X}, {"W", W}, {"sigma", sigma}, {"V", V}, {"t_end", 10.0}});
    const Number own = Number(X) * X * W * W, s = sigma,
                 wc = std::sqrt((m1 * own + m2 * Number(W) * W) / (Number(m1) + m2)),
                 together = std::numbers::pi_v<Number> / wc,
                 period = together + std::numbers::pi_v<Number> / W;
    EXPECT_NEAR(constant(pair, "T_c"), double(together), 1e-15);
    EXPECT_NEAR(constant(pair, "factor"), double(std::exp(-s * period)), 1e-15);
    for (int i = 0; i < 20; ++i) {
      const double t = box.uniform(0.0, 10.0);
      const Number whole = std::floor(t / period);
      const bool apart = t - whole * period >= together;
      const Number x = t - whole * period - (apart ? together : 0),
                   size = (apart ? -V : V) * std::exp(-s * t);
      const auto state = pair.motion->at(t, model::Side::right),
                 bound = pair.motion->error_bound(t);
      for (const Eigen::Index mass : {0, 1}) {
        const Number f = !apart ? wc : mass == 0 ? Number(X) * W : Number(W);
        const Number u = size * std::sin(f * x) / f, v = size * std::cos(f * x) - s * u;
        EXPECT_NEAR(state.u[mass], double(u), bound.u[mass] + 1e-17 * X) << t;
        EXPECT_NEAR(state.v[mass], double(v), bound.v[mass] + 1e-17 * X * X * W) << t;
      }
    }
  }
}

// Damping that is fast against the frequencies, of which no square may be the difference of others.
TEST(RestingCases, AStronglyDampedPlasticPairHasAllDigitsOfItsFactor) {
  const auto pair = make("plastic-pair", {{"W", 0x1p-6}, {"sigma", 1.0}, {"t_end", 0.01}});
  const Number together = std::numbers::pi_v<Number> / (0x1p-6L * std::sqrt(Number(5.0)));
  EXPECT_NEAR(constant(pair, "T_c"), double(together), 1.2e-16 * double(together));
  const auto factor = double(std::exp(-together - 64 * std::numbers::pi_v<Number>));
  EXPECT_NEAR(constant(pair, "factor"), factor, 1.2e-16 * factor);
}

TEST(RestingCases, AreRefusedWithTheReason) {
  EXPECT_REFUSED(make("ball", {{"eta", 1.0}}), "out-of-range", "never comes to rest");
  EXPECT_REFUSED(make("ball", {{"h0", 0.0}}), "out-of-range", "starts on the floor");
  EXPECT_REFUSED(make("plastic-pair", {{"X", 4.0}}), "not-odd", "equal velocities");
  EXPECT_REFUSED(make("plastic-pair", {{"sigma", 0.1}}), "not-exact-data",
                 "short binary fractions");
}

TEST(RestingCases, BilliardsAreTriangleWaves) {
  Box box(73);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 73, trial " << trial);
    const double side[2] = {box.decades(-1.0, 1.0), box.decades(-1.0, 1.0)};
    double start[2], speed[2];
    for (int i = 0; i < 2; ++i) {
      start[i] = side[i] * box.uniform(0.01, 0.99);
      speed[i] = (box.one_in(2) ? 1.0 : -1.0) * box.decades(-1.0, 0.5);
    }
    const auto billiard = make("billiard", {{"a", side[0]},
                                            {"b", side[1]},
                                            {"x0", start[0]},
                                            {"y0", start[1]},
                                            {"vx", speed[0]},
                                            {"vy", speed[1]},
                                            {"t_end", box.uniform(1.0, 30.0)}});
    for (int k = 0; k < 8; ++k) {
      const double t = box.uniform(0.0, billiard.problem.end);
      const auto now = billiard.motion->at(t, model::Side::right),
                 bound = billiard.motion->error_bound(t);
      long long bounces = 0;
      for (int i = 0; i < 2; ++i) {
        const Number x = Number(start[i]) + Number(speed[i]) * t, walls = x / side[i],
                     cell = std::floor(walls), rest = x - cell * side[i];
        const bool is_back = std::fmod(cell, 2) != 0;
        EXPECT_NEAR(now.u[i], double(is_back ? side[i] - rest : rest),
                    bound.u[i] + 1e-16 * side[i]);
        EXPECT_NEAR(now.v[i], is_back ? -speed[i] : speed[i], bound.v[i]);
        bounces += static_cast<long long>(std::abs(cell));
      }
      EXPECT_EQ(billiard.motion->impact_count(t), bounces);
    }
  }
  EXPECT_REFUSED(make("billiard", {{"x0", 1.5}}), "out-of-range", "inside the box");
}

// Ray by ray with 90 digits.
struct Ray {
  using Real = exact::testing_oracle::Real;
  Real R, x, y, vx, vy, t = 0;
  Real flight() const {
    const Real a = vx * vx + vy * vy, b = x * vx + y * vy, c = x * x + y * y - R * R;
    return (sqrt(b * b - a * c) - b) / a;
  }
  void fly(const Real& s) { x += vx * s, y += vy * s, t += s; }
  void bounce() {
    const Real twice = 2 * (x * vx + y * vy) / (R * R);
    vx -= twice * x, vy -= twice * y;
  }
};

TEST(RestingCases, CircleBilliardsAreTheirRays) {
  Box box(74);
  for (int trial = 0; trial < trials(30); ++trial) {
    SCOPED_TRACE(testing::Message() << "seed 74, trial " << trial);
    const double R = box.decades(-1.0, 1.0), v = box.decades(-1.0, 1.0),
                 share = box.one_in(6)   ? 0.0
                         : box.one_in(3) ? 1.0 - box.decades(-9.0, -1.0)
                                         : box.uniform(0.0, 0.99),
                 place = box.uniform(-3.2, 3.2),
                 heading = box.one_in(3) ? place + 0.5 * std::numbers::pi : box.uniform(-3.2, 3.2);
    const double x0 = R * share * std::cos(place), y0 = R * share * std::sin(place),
                 vx = v * std::cos(heading), vy = v * std::sin(heading);
    const auto make_until = [&](double end) {
      return make("circle-billiard",
                  {{"R", R}, {"x0", x0}, {"y0", y0}, {"vx", vx}, {"vy", vy}, {"t_end", end}});
    };
    const double chord = constant(make_until(1e-9), "chord"),
                 end = chord / v * box.decades(-0.5, 2.3);
    const auto circle = make_until(end);
    const auto& motion = *circle.motion;
    Ray ray{R, x0, y0, vx, vy};
    std::optional<certified::Digits> digits;
#ifdef CLACKERS_HAS_ARB
    digits.emplace(motion, 40);
#endif
    const auto expect_digits = [&](const certified::Digits::KinematicTexts& texts) {
      EXPECT_LE(abs(Ray::Real(texts.u[0]) - ray.x) + abs(Ray::Real(texts.u[1]) - ray.y),
                Ray::Real(1e-39) * R);
      EXPECT_LE(abs(Ray::Real(texts.v[0]) - ray.vx) + abs(Ray::Real(texts.v[1]) - ray.vy),
                Ray::Real(1e-39) * v);
    };
    const auto expect = [&](const model::Kinematics& now, const model::Kinematics& bound) {
      EXPECT_LE(abs(now.u[0] - ray.x), bound.u[0]);
      EXPECT_LE(abs(now.u[1] - ray.y), bound.u[1]);
      EXPECT_LE(abs(now.v[0] - ray.vx), bound.v[0]);
      EXPECT_LE(abs(now.v[1] - ray.vy), bound.v[1]);
    };
    for (long long k = 1; k <= motion.impact_count(end) + 1; ++k) {
      const auto s = ray.flight();
      const double middle = double(ray.t + s * box.uniform(0.01, 0.99));
      if (middle > end) break;
      auto next = ray;
      ray.fly(middle - ray.t);
      const auto bound = motion.error_bound(middle);
      expect(motion.at(middle, model::Side::right), bound);
      ray.fly(Ray::Real(middle) - ray.t);
      if (digits) expect_digits(digits->at(middle, model::Side::right));
      EXPECT_LE(bound.u.maxCoeff(), 3e-16 * R);
      EXPECT_EQ(motion.impact_count(middle), k - 1);
      ray = next;
      if (k > motion.impact_count(end)) break;
      ray.fly(s);
      const auto impact = motion.impact(k);
      const auto size = motion.envelope(0.0);
      const model::Kinematics rounding{1e-15 * size.u, 1e-15 * size.v, size.a};
      EXPECT_LE(abs(impact.t - ray.t), 0.5 * (impact.when.hi - impact.when.lo));
      expect(impact.before, rounding);
      if (digits) {
        const auto hit = digits->impact(k);
        EXPECT_LE(abs(Ray::Real(hit.t) - ray.t), Ray::Real(1e-39) * ray.t);
        expect_digits(hit.before);
        auto bounced = ray;
        bounced.bounce();
        std::swap(ray, bounced);
        expect_digits(hit.after);
        std::swap(ray, bounced);
      }
      ray.bounce();
      expect(impact.after, rounding);
      EXPECT_NEAR(impact.impulse, v * chord / R, 1e-15 * v);
    }
    // Angular momentum, of the problem's numbers.
    EXPECT_NEAR(constant(circle, "L"), double(ray.x * ray.vy - ray.y * ray.vx), 1e-15 * R * v);
    EXPECT_NEAR(std::cos(0.5 * constant(circle, "turn")), constant(circle, "d") / R, 1e-15);
  }
  EXPECT_REFUSED(make("circle-billiard", {{"x0", 0.75}, {"y0", 0.75}}), "out-of-range",
                 "inside the circle");
  EXPECT_REFUSED(make("circle-billiard", {{"vx", 0.0}, {"vy", 0.0}}), "out-of-range", "stay");
  EXPECT_REFUSED(make("circle-billiard", {{"t_end", 1e10}}), "out-of-range", "So many");
}

}  // namespace
}  // namespace clackers::cases
