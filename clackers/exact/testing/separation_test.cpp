// Appendix A of the paper: u1 - u2 of the motion against D, D' and D'', Eq. (A.6)-(A.17), as derived
// and not as printed. Independent of ClosedForm: long double, phases as they stand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/exact/pair/closed_form.hpp"

namespace clackers::exact {
namespace {

constexpr long double pi_long = std::numbers::pi_v<long double>;

// Eq. (A.13) and (A.17), one function.
long double D_prime(int N, long double angle) {
  const long double X = 4 * N + 1;
  return std::cos(angle) + 3.0L / X * std::cos(X * angle);
}

// One instant of a flight, where sqrt(1 - xi1^2) t = shift + angle, -pi/2 < angle < pi/2.
struct Instant {
  double t;
  long double shift, angle, omega;
};

// `visit` is given N, xi1, an instant and u1 - u2 there. Flights j pi - pi/2 to j pi + pi/2: those of
// even j are the first case of Eq. (A.6), those of odd j the second.
void at_instants(int first_flight, auto visit) {
  for (const int N : {1, 2, 5, 20})
    for (const double xi1 : {0.0, 0.1, 0.6}) {
      const SynchronizedPair pair({.xi1 = xi1, .X = 4.0 * N + 1.0, .r = 3.0, .t_end = 40.0});
      const long double omega = std::sqrt(1.0L - static_cast<long double>(xi1) * xi1);
      for (int j = first_flight; j <= first_flight + 4; j += 2)
        for (const long double wish : {-1.5L, -0.9L, -0.31L, 0.0L, 0.2L, 0.77L, 1.56L}) {
          const double t = double((j * pi_long + wish) / omega);
          if (t < 0.0) continue;
          SCOPED_TRACE(testing::Message() << "N = " << N << " xi1 = " << xi1 << " t = " << t);
          const auto now = pair.at(t, model::Side::right);
          visit(N, xi1, Instant{t, j * pi_long, omega * t - j * pi_long, omega},
                now.u[0] - now.u[1]);
        }
    }
}

// Two displacements of half a unit each, their difference, and the phase of the reference.
double bound(int N, const Instant& at, long double envelope) {
  return double(envelope * (2.0L * 0x1p-52L + 8.0L * (4 * N + 1) * at.omega * at.t * 0x1p-64L));
}

TEST(Separation, OfTheFirstCaseIsEqA13TimesTheEnvelope) {
  at_instants(0, [](int N, double xi1, const Instant& at, double gap) {
    const long double envelope = std::exp(-xi1 * (at.shift + at.angle) / at.omega);  // Eq. (A.9)
    EXPECT_NEAR(gap, double(envelope * D_prime(N, at.angle)), bound(N, at, envelope));
    EXPECT_GT(D_prime(N, at.angle), 0.0L);
  });
}

TEST(Separation, OfTheSecondCaseIsEqA17TimesTheEnvelope) {
  at_instants(1, [](int N, double xi1, const Instant& at, double gap) {
    // Eq. (A.16) with (2k + 1) pi, which is `shift`.
    const long double envelope = std::exp(-xi1 * (at.shift + at.angle) / at.omega);
    EXPECT_NEAR(gap, double(envelope * D_prime(N, at.angle)), bound(N, at, envelope));
  });
}

TEST(Separation, IsNotEqA12AsPrinted) {
  // The parenthesis closes before the cosine: (cos + 3/X) cos, negative where the masses are apart.
  const SynchronizedPair pair({.xi1 = 0.0, .X = 5.0, .r = 3.0});
  const auto now = pair.at(0.5, model::Side::right);
  EXPECT_NEAR(now.u[0] - now.u[1], 0.3968963926, 1e-10);
  EXPECT_LT((std::cos(0.5) + 3.0 / 5.0) * std::cos(2.5), -1.0);
}

TEST(Separation, OfTheSecondCaseIsNotThatOfEqA16AsPrinted) {
  // 2 k pi for (2k + 1) pi in the exponent: too large by exp(xi1 pi / sqrt(1 - xi1^2)).
  at_instants(1, [](int N, double xi1, const Instant& at, double gap) {
    const long double printed = std::exp(-xi1 * (at.shift - pi_long + at.angle) / at.omega);
    const long double factor = printed * D_prime(N, at.angle) / gap;
    // The smallest gap here is 2e-3 of the envelope, known to 2e-15 of it: bound().
    EXPECT_NEAR(double(factor / std::exp(xi1 * pi_long / at.omega)), 1.0, 1e-12);
  });
}

}  // namespace
}  // namespace clackers::exact
