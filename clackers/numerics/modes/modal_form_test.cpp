#include "clackers/numerics/modes/modal_form.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace clackers::numerics {
namespace {

struct Flight {
  ModalSystem system;
  std::vector<ModalState> start;
};

Flight flight(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
              const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& u,
              const Eigen::VectorXd& v) {
  Flight made{*ModalSystem::make(mass, damping, stiffness), {}};
  const auto n = std::size_t(u.size());
  made.start.resize(n);
  made.system.to_modes({u.data(), n}, {v.data(), n}, made.start);
  return made;
}

// Unit masses of frequencies 1 and X, apart from each other by sin s + (r/X) sin X s.
Flight pair(double X, double r, double sigma = 0.0) {
  const Eigen::Vector2d stiffness(1.0 + sigma * sigma, X * X + sigma * sigma);
  return flight(Eigen::Matrix2d::Identity(), 2.0 * sigma * Eigen::Matrix2d::Identity(),
                Eigen::Matrix2d(stiffness.asDiagonal()), Eigen::Vector2d::Zero(),
                Eigen::Vector2d(1.0, -r));
}

Eigen::Matrix3d coupled_damping() {
  Eigen::Matrix3d c;
  c << 0.5, -0.2, 0.0, -0.2, 0.3, 0.1, 0.0, 0.1, 0.05;
  return c;
}

TEST(ModalForm, ItsDerivativesAreThoseOfTheMotion) {
  Eigen::Matrix3d k;
  k << 30.0, -7.0, 0.0, -7.0, 9.0, -2.0, 0.0, -2.0, 8.0;
  const Eigen::Vector3d u(0.3, -0.2, 0.5), v(1.0, 0.4, -0.7), b(1.0, -1.0, 0.5), d(0.2, 0.1, -0.4);
  const Eigen::Matrix3d c = coupled_damping();
  const auto [system, start] = flight(Eigen::Matrix3d::Identity(), c, k, u, v);
  const ModalForm form(system, {b.data(), 3}, {d.data(), 3}, 0.25);
  const Eigen::Vector3d a = -c * v - k * u, jerk = -c * a - k * v, snap = -c * jerk - k * a;
  EXPECT_NEAR(form.derivative(start, 0), 0.25 + b.dot(u) + d.dot(v), 1e-13);
  EXPECT_NEAR(form.derivative(start, 1), b.dot(v) + d.dot(a), 1e-12);
  EXPECT_NEAR(form.derivative(start, 2), b.dot(a) + d.dot(jerk), 1e-11);
  EXPECT_NEAR(form.derivative(start, 3), b.dot(jerk) + d.dot(snap), 1e-10);
  // Bounds hold for the whole flight and are not idle.
  std::vector<ModalState> now(3);
  for (int k_th = 1; k_th <= 3; ++k_th) {
    double largest = 0.0;
    for (double s = 0.0; s < 30.0; s += 0.01) {
      for (std::size_t j = 0; j < 3; ++j) now[j] = advance(system.modes()[j], start[j], s);
      largest = std::max(largest, std::abs(form.derivative(now, k_th)));
    }
    const double bound = form.derivative_bound(system, start, k_th);
    EXPECT_GE(bound, largest) << k_th;
    EXPECT_LE(bound, 4.0 * largest) << k_th;
  }
}

// The state of a mode, and s, under a constant force, from (y, y', 1) by the exponential of the matrix of their
// equation: its series in long double over s/2^30, squared 30 times.
ModalState by_squaring(const Mode& mode, const ModalState& start, const ModalState& push,
                       double s) {
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  Matrix rate;
  rate << 0.0L, 1.0L, push.y, -mode.omega_square, -2.0L * mode.sigma, push.rate, 0.0L, 0.0L, 0.0L;
  rate *= std::ldexp((long double)s, -30);
  // Less 1, whose rounding would be squared as well.
  Matrix change = rate * (Matrix::Identity() + rate / 2 * (Matrix::Identity() + rate / 3));
  for (int k = 0; k < 30; ++k) change = Matrix(2 * change + change * change);
  const long double y = start.y, v = start.rate;
  return {double(y + change(0, 0) * y + change(0, 1) * v + change(0, 2)),
          double(v + change(1, 0) * y + change(1, 1) * v + change(1, 2))};
}

TEST(ModalFlight, AConstantForcePushesEveryModeWithoutCancellation) {
  const ModalState push{0.3, -0.8};
  for (const double sigma : {0.0, 1e-9, 0.01, 0.4, 1.0, 3.0, 40.0})
    for (const double square : {0.0, 1.6e-16, -1e-14, 1e-6, 0.16, 0.9, 1.0, 4.0})
      for (const double s : {1e-3, 0.3, 1.0, 2.7, 9.0}) {
        const Mode mode(sigma, square);
        const auto now = pushed(mode, push, s), known = by_squaring(mode, {}, push, s);
        const double size = std::abs(known.y) + std::abs(known.rate) * s;
        EXPECT_NEAR(now.y, known.y, 3e-15 * size) << sigma << ' ' << square << ' ' << s;
        EXPECT_NEAR(now.rate, known.rate, 3e-15 * (std::abs(known.rate) + size / s))
            << sigma << ' ' << square << ' ' << s;
      }
}

// A soft mode that a constant force pushes, and what is known of it ahead.
TEST(FormAhead, PushesOfSoftModesAreWholeDerivativesWithBounds) {
  for (const double sigma : {0.0, 0.05, 2.0})
    for (const double omega : {1e-8, 0.02, 0.125}) {
      const Mode mode(sigma, omega * omega);
      const ModalSystem system({mode}, Eigen::MatrixXd::Identity(1, 1),
                               Eigen::MatrixXd::Identity(1, 1));
      const std::vector<ModalState> start{{0.4, -1.0}}, push{{0.2, 0.7}};
      const ModalForm form(system, Eigen::Vector2d(1.0, 0.3), 2.0);
      FormAhead ahead;
      ahead.begin(system, form, start, -1.0, push);
      // Of f = y + 0.3 y' and its derivatives, by y'' = ... from the equation.
      const auto known = [&](double s) {
        const auto [y, rate] = by_squaring(mode, start[0], push[0], s);
        std::array<double, 5> ys{y, rate + push[0].y}, f{};
        std::array<double, 5> rates{rate, 0.0};
        for (std::size_t k = 1; k < 5; ++k) {
          rates[k] = -mode.omega_square * ys[k - 1] - 2.0 * sigma * rates[k - 1] +
                     (k == 1 ? push[0].rate : 0.0);
          ys[k] = rates[k - 1] + (k == 1 ? push[0].y : 0.0);
        }
        for (std::size_t k = 0; k < 5; ++k) f[k] = -(ys[k] + 0.3 * rates[k]) - (k == 0 ? 2.0 : 0.0);
        return f;
      };
      for (double s = 0.0; s < 8.0; s += 0.37) {
        const auto now = ahead.whole(s);
        const auto here = known(s);
        EXPECT_NEAR(now.value, here[0], 1e-13);
        EXPECT_NEAR(now.slope, here[1], 1e-13);
        EXPECT_NEAR(now.second, here[2], 1e-13);
        EXPECT_NEAR(now.third, here[3], 1e-13);
        for (double x = 0.0; x < 8.0 && x <= now.reach; x += 0.1) {
          EXPECT_LE(std::abs(known(s + x)[2]), now.curvature * (1.0 + 1e-14));
          EXPECT_LE(std::abs(known(s + x)[3]), now.third_bound * (1.0 + 1e-14));
        }
        EXPECT_LE(ahead(s).value, here[0] + 1e-13);
      }
    }
}

// A free mode, damped or not, that a constant force pushes, beside an oscillating mode and a harmonic
// response: values are those of the pieces, and bounds hold ahead.
TEST(FormAhead, PushesAndHarmonicsAreWholeDerivativesWithBounds) {
  for (const double sigma : {0.0, 0.3}) {
    const auto [system, start] =
        flight(Eigen::Matrix2d::Identity(), Eigen::Vector2d(2.0 * sigma, 0.1).asDiagonal(),
               Eigen::Vector2d(0.0, 9.0).asDiagonal(), Eigen::Vector2d(0.4, 0.2),
               Eigen::Vector2d(-1.0, 0.5));
    const std::vector<ModalState> push{{0.2, 0.7}, {}};
    const ModalForm form(system, Eigen::Vector4d(1.0, 0.5, 0.3, 0.1), 2.0);
    const std::complex<double> y(0.3, -0.8);
    const double frequency = 1.7;
    FormAhead ahead;
    ahead.begin(system, form, start, -1.0, push);
    ahead.add(y, frequency);
    const auto value = [&, &system = system, &start = start](double s) {
      // y'' = push.rate - 2 sigma (y' - push.y), by the closed form.
      const double e = std::exp(-2.0 * sigma * s), x = 2.0 * sigma;
      const double gain = sigma > 0.0 ? (1.0 - e) / x : s,
                   way = sigma > 0.0 ? (s - gain) / x : s * s / 2;
      const double free = 0.4 + 0.2 * s - 1.0 * gain + 0.7 * way, rate = -1.0 * e + 0.7 * gain;
      const auto other = advance(system.modes()[1], start[1], s);
      return -(2.0 + free + 0.3 * rate + 0.5 * other.y + 0.1 * other.rate +
               (y * std::polar(1.0, frequency * s)).real());
    };
    for (double s = 0.0; s < 6.0; s += 0.37) {
      const auto now = ahead.whole(s);
      const double h = 1e-3;
      EXPECT_NEAR(now.value, value(s), 1e-14 * 10.0);
      EXPECT_NEAR(now.slope, (value(s + h) - value(s - h)) / (2.0 * h), 1e-4);
      EXPECT_NEAR(now.second, ahead.whole(s + h).slope / h - now.slope / h, 0.1);
      EXPECT_NEAR(now.third, (ahead.whole(s + h).second - now.second) / h, 0.2);
      for (double later = s; later < 8.0; later += 0.05) {
        EXPECT_LE(std::abs(ahead.whole(later).second), now.curvature);
        EXPECT_LE(std::abs(ahead.whole(later).third), now.third_bound);
      }
      const auto known = ahead(s);
      EXPECT_LE(known.value, now.value + 1e-14);
    }
  }
}

// y'' + 2 sigma y' + omega^2 y = e^(i W t), and what FormAhead says of the real part of y.
TEST(FormAhead, BeatsSolveTheEquationOfTheirModeAndAreWholeDerivativesWithBounds) {
  for (const double sigma : {0.0, 1e-9, 0.02})
    for (const double apart : {0.0, 1e-12, 1e-4, -0.3}) {
      SCOPED_TRACE(testing::Message() << sigma << " " << apart);
      const auto [system, start] =
          flight(Eigen::Matrix<double, 1, 1>(1.0), Eigen::Matrix<double, 1, 1>(2.0 * sigma),
                 Eigen::Matrix<double, 1, 1>(4.0), Eigen::Matrix<double, 1, 1>(0.0),
                 Eigen::Matrix<double, 1, 1>(0.0));
      const auto& mode = system.modes()[0];
      const double frequency = mode.w * (1.0 + apart);
      const Beat beat(mode, frequency);
      const BeatForm y{beat.scale, 0.0}, rate = y.derivative(beat),
                                         acceleration = rate.derivative(beat);
      for (const double t : {0.0, 0.3, 4.0, 70.0}) {
        const auto now = beat.at(t);
        const auto value = [&](const BeatForm& form) { return form.e * now.e + form.r * now.r; };
        EXPECT_LT(std::abs(value(acceleration) + 2.0 * sigma * value(rate) +
                           mode.omega_square * value(y) - std::polar(1.0, frequency * t)),
                  1e-14 * (1.0 + t));
        EXPECT_LE(std::abs(now.e), beat.most(t) * (1.0 + 1e-14));
        EXPECT_LE(std::abs(now.r), 1.0 + 1e-14);
      }
      EXPECT_EQ(beat.at(0.0).e, 0.0);
      const ModalForm form(system, Eigen::Vector2d(0.0, 0.0), 0.5);
      FormAhead ahead;
      ahead.begin(system, form, start, -1.0);
      ahead.add(beat, y, 3.0);
      for (double s = 0.0; s < 40.0; s += 3.1) {
        const auto now = ahead.whole(s);
        EXPECT_NEAR(now.value, -0.5 - (y.e * beat.at(3.0 + s).e).real(), 1e-13);
        const double h = 1e-3, size = 1e-5 * (5.0 + s);
        const auto later = ahead.whole(s + h), sooner = s > h ? ahead.whole(s - h) : later;
        if (s > h) {
          EXPECT_NEAR(now.slope, (later.value - sooner.value) / (2.0 * h), size);
          EXPECT_NEAR(now.second, (later.slope - sooner.slope) / (2.0 * h), size);
          EXPECT_NEAR(now.third, (later.second - sooner.second) / (2.0 * h), size);
        }
        for (double x = 0.0; x <= now.reach && x < 50.0; x += 0.1) {
          EXPECT_LE(std::abs(ahead.whole(s + x).second), now.curvature);
          EXPECT_LE(std::abs(ahead.whole(s + x).third), now.third_bound);
        }
      }
    }
}

struct Search {
  FirstRoot root;
  int calls = 0;
};

Search search(const Flight& flight, const ModalForm& form, double until) {
  const FormAhead ahead(flight.system, form, flight.start, 1.0);
  Search made;
  made.root = first_root(
      [&](double s) {
        ++made.calls;
        return ahead(s);
      },
      0.0, until, 2e-8 / flight.system.fastest(), 1000000);
  return made;
}

const double apart[2] = {1.0, -1.0};

TEST(ModalForm, ItsFirstRootCostsTheSameForEveryRatioOfFrequencies) {
  for (const double X : {5.0, 81.0, 401.0, 100001.0}) {
    const auto colliding = pair(X, 3.0);
    const auto found = search(colliding, ModalForm(colliding.system, apart, {}, 0.0), 10.0);
    ASSERT_EQ(found.root.status, FirstRoot::Status::found) << X;
    EXPECT_NEAR(found.root.s, std::numbers::pi, 1e-15) << X;
    EXPECT_LE(found.calls, 25) << X;
  }
}

// The largest r at which sin s + (r/X) sin X s touches 0 between 0 and pi: where its slope is 0 too.
double grazing_ratio(double X) {
  long double low = std::numbers::pi_v<long double>, high = 1.5L * low;
  for (int i = 0; i < 80; ++i) {
    const long double x = 0.5L * (low + high);
    const bool is_before = X * std::sin(x / X) * std::cos(x) - std::sin(x) * std::cos(x / X) < 0.0L;
    (is_before ? low : high) = x;
  }
  return double(-X * std::sin(low / X) / std::sin(low));
}

TEST(ModalForm, ItsFirstRootIsNotSkippedWhereTheFastModeGrazes) {
  for (const double X : {9.0, 401.0})
    for (const double share : {1.0 - 1e-9, 1.0 - 1e-12, 1.0 + 1e-12, 1.0 + 1e-9}) {
      const auto colliding = pair(X, grazing_ratio(X) * share);
      const auto found = search(colliding, ModalForm(colliding.system, apart, {}, 0.0), 10.0);
      ASSERT_EQ(found.root.status, FirstRoot::Status::found);
      if (share < 1.0) {
        EXPECT_NEAR(found.root.s, std::numbers::pi, 1e-14) << X << ' ' << share;
      } else {
        EXPECT_LT(found.root.s * X, 5.0) << X << ' ' << share;
      }
    }
}

TEST(ModalForm, ItsFirstRootIsThatOfDenseSampling) {
  // Three modes, two of them fast, damped and not by the same rate, with a gap.
  for (const double gap : {0.05, 0.4, 1.1}) {
    const Eigen::Vector3d square(1.0, 300.0, 2000.0), sigma(0.01, 0.3, 0.02);
    const auto three =
        flight(Eigen::Matrix3d::Identity(), Eigen::Matrix3d(2.0 * sigma.asDiagonal()),
               Eigen::Matrix3d(square.asDiagonal()), Eigen::Vector3d(1.0, 0.1, -0.05),
               Eigen::Vector3d(0.3, -4.0, 9.0));
    const double b[3] = {1.0, 1.0, 0.7};
    const ModalForm form(three.system, b, {}, gap);
    std::vector<ModalState> now(3);
    double first = 0.0;
    for (double s = 0.0; s < 20.0 && first == 0.0; s += 1e-4) {
      for (std::size_t j = 0; j < 3; ++j)
        now[j] = advance(three.system.modes()[j], three.start[j], s);
      if (form.derivative(now, 0) < 0.0) first = s;
    }
    const auto found = search(three, form, 20.0).root;
    EXPECT_EQ(found.status == FirstRoot::Status::found, first > 0.0);
    EXPECT_NEAR(found.s, first, 1.01e-4) << gap;
  }
}

TEST(ModalForm, FirstRootOfAGrowingMotionIsFound) {
  using One = Eigen::Matrix<double, 1, 1>;
  const double b = 1.0;
  // cosh s reaches 1000, and e^(0.1 s) cos w s reaches -8.
  const auto falling = flight(One(1.0), One(0.0), One(-1.0), One(-1.0), One(0.0));
  EXPECT_NEAR(search(falling, ModalForm(falling.system, {&b, 1}, {}, 1000.0), 50.0).root.s,
              std::acosh(1000.0), 1e-13);
  const auto fluttering = flight(One(1.0), One(-0.2), One(1.01), One(1.0), One(0.1));
  const auto found = search(fluttering, ModalForm(fluttering.system, {&b, 1}, {}, 8.0), 50.0).root;
  EXPECT_NEAR(std::exp(0.1 * found.s) * std::cos(found.s), -8.0, 1e-12);
  EXPECT_LT(found.s, 7.0 * std::numbers::pi);
}

}  // namespace
}  // namespace clackers::numerics
