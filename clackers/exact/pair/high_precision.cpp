#include "clackers/exact/pair/high_precision.hpp"

#include <fmt/format.h>

// The only source of the module that pays for compiling it.
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/pair/admissibility.hpp"

namespace clackers::exact {
namespace {

template <unsigned bits>
using Number = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<bits, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;
using Real = Number<384>;

double to_double(const Real& x) { return x.convert_to<double>(); }

numerics::DoubleDouble to_double_double(const Real& x) {
  const double hi = to_double(x);
  return {hi, to_double(x - hi)};
}

numerics::TripleDouble to_triple_double(const Real& x) {
  const auto [hi, mid] = to_double_double(x);
  return {hi, mid, to_double(x - hi - mid)};
}

Real precise_pi() { return boost::math::constants::pi<Real>(); }

// A motion given by few numbers, from which all others follow.
struct RealMotion {
  struct Mass {
    Real mass;              // [kg]
    Real start;             // b = u(0) [m]
    double multiple = 1.0;  // p = damped frequency / Omega, odd

    // k / m = p^2 Omega^2 + sigma^2 [1/s^2]
    Real stiffness_over_mass(const RealMotion& motion) const {
      const Real own = multiple * motion.omega;
      return own * own + motion.sigma * motion.sigma;
    }
  };

  std::vector<Mass> masses;
  Real omega;  // Omega, the damped frequency whose half period separates the impacts [1/s]
  Real sigma;  // common rate of decay [1/s]
  double eta = 1.0;
  double end = 0.0;
  bool collides = true;
  std::optional<FrequencyRatio> ratio = {};  // of two masses
  double r = 1.0;                            // m1/m2 as given
};

// Above 2^50 half periods the phase would not be known to 2^-100.
void require_end(std::string_view who, const RealMotion& motion) {
  constexpr double most_half_periods = 0x1p50;
  require_positive(who, "t_end", motion.end);
  if (motion.omega * motion.end / precise_pi() > most_half_periods)
    refuse(who, "t_end", motion.end,
           fmt::format(
               "0 < t_end <= {} s, which is 2^50 half periods",
               std::nextafter(to_double(most_half_periods * precise_pi() / motion.omega), 0.0)),
           "Beyond, impacts lie closer together than double precision resolves their times.");
}

RealMotion unit_mass(double xi1, double eta, double end, bool collides) {
  RealMotion motion;
  motion.omega = sqrt(1 - Real(xi1) * xi1);
  motion.sigma = xi1;
  motion.eta = eta;
  motion.end = end;
  motion.collides = collides;
  motion.masses = {{1, 1, 1.0}};
  return motion;
}

RealMotion motion_of(std::string_view, const FreeMassParameters& p) {
  return unit_mass(p.xi1, 1.0, p.t_end, false);
}

RealMotion motion_of(std::string_view, const RigidStopParameters& p) {
  return unit_mass(p.xi1, p.eta, p.t_end, true);
}

RealMotion motion_of(std::string_view who, const PairParameters& p) {
  const auto ratio = frequency_ratio(who, p.X);
  const Real omega1 = sqrt(Real(p.k1) / p.m1), xi1 = p.xi1, odd = ratio.odd;
  const Real omega_d1 = omega1 * sqrt(1 - xi1 * xi1);
  const double s = quarter_sine(ratio.odd);
  RealMotion motion;
  motion.sigma = xi1 * omega1;
  motion.eta = p.eta;
  motion.end = p.t_end;
  motion.ratio = ratio;
  motion.r = p.r;
  if (ratio.is_inverse) {
    motion.omega = omega_d1 / odd;
    motion.masses = {{p.m1, s * Real(p.A), ratio.odd},
                     {Real(p.m1) / p.r, -Real(p.r) * p.A * odd, 1.0}};
  } else {
    motion.omega = omega_d1;
    motion.masses = {{p.m1, p.A, 1.0}, {Real(p.m1) / p.r, -s * Real(p.r) * p.A / odd, ratio.odd}};
  }
  return motion;
}

// Sums and products of at most seven doubles within the ranges below are exact in so many bits:
// X^2 Omega^2 and sigma^2 are at most 460 binary places apart.
using Exact = Number<1024>;

void require_binary64(std::string_view who, std::string_view input, const Exact& value) {
  const auto nearest = value.convert_to<double>();
  if (nearest == value) return;
  throw InputError(
      fmt::format(
          "{}: {} = {:.17g} is not exactly a binary64 number (the nearest is off by {:.1e}); "
          "allowed: values with which every model input is one. Use short binary fractions "
          "such as 0.0625, or synchronized-pair, which rounds its inputs.",
          who, input, nearest, Exact(value - nearest).convert_to<double>()),
      "not-exact-data");
}

void require_exact_data(std::string_view who, const ExactDataParameters& p) {
  const Exact m2 = p.m2, omega = p.Omega, sigma = p.sigma, X = p.X, r = p.r;
  const Exact m1 = r * m2, own = X * omega, u1 = X * p.A_over_X, u2 = r * p.A_over_X;
  require_binary64(who, "m1 = r m2", m1);
  // c2 = 2 m2 sigma then needs no look: c1 is r times it, and a factor needs no more bits than a
  // product.
  require_binary64(who, "c1 = 2 m1 sigma", 2 * m1 * sigma);
  require_binary64(who, "k1 = m1 (Omega^2 + sigma^2)", m1 * (omega * omega + sigma * sigma));
  require_binary64(who, "k2 = m2 (X^2 Omega^2 + sigma^2)", m2 * (own * own + sigma * sigma));
  require_binary64(who, "u1(0) = X (A/X)", u1);
  require_binary64(who, "|u2(0)| = r (A/X)", u2);
  require_binary64(who, "|v1(0)| = sigma u1(0)", sigma * u1);
  require_binary64(who, "|v2(0)| = sigma |u2(0)|", sigma * u2);
}

RealMotion motion_of(std::string_view who, const ExactDataParameters& p) {
  require_exact_data(who, p);
  const Real quotient = p.A_over_X;
  RealMotion motion;
  motion.omega = p.Omega;
  motion.sigma = p.sigma;
  motion.eta = p.eta;
  motion.end = p.t_end;
  motion.ratio = FrequencyRatio{p.X, false};
  motion.r = p.r;
  motion.masses = {{Real(p.r) * p.m2, quotient * p.X, 1.0},
                   {p.m2, -quarter_sine(p.X) * Real(p.r) * quotient, p.X}};
  return motion;
}

FlightConstants flight_constants(const RealMotion& motion) {
  const Real log_2 = log(Real(2));
  FlightConstants c;
  c.collides = motion.collides;
  c.eta = motion.eta;
  c.end = motion.end;
  c.turns = to_triple_double(motion.omega / precise_pi());
  c.period = to_triple_double(precise_pi() / motion.omega);
  c.decay = to_double_double(motion.sigma / log_2);
  c.period_decay = to_double_double(motion.sigma * precise_pi() / (motion.omega * log_2));
  if (motion.eta > 0.0) c.log2_eta = to_double_double(log(Real(motion.eta)) / log_2);

  Real energy = 0;
  for (const auto& mass : motion.masses) {
    const Real &b = mass.start, &sigma = motion.sigma;
    const Real own = mass.multiple * motion.omega;
    const Real v_hit = -quarter_sine(mass.multiple) * b * own;
    const Real square = mass.stiffness_over_mass(motion);
    MassConstants m;
    m.multiple = mass.multiple;
    m.b = to_double_double(b);
    m.v_cos = to_double_double(-b * sigma);
    m.v_sin = to_double_double(-b * own);
    m.a_cos = to_double_double(b * (sigma * sigma - own * own));
    m.a_sin = to_double_double(2 * b * sigma * own);
    m.v_hit = to_double_double(v_hit);
    m.a_hit = to_double_double(-2 * sigma * v_hit);
    m.u_envelope = to_double(abs(b));
    m.v_envelope = to_double(abs(b) * sqrt(square));
    m.a_envelope = to_double(abs(b) * square);
    c.masses.push_back(m);
    energy += mass.mass * v_hit * v_hit / 2;
    // The momenta of two masses are opposite: either one gives the impulse.
    c.impulse = to_double_double((1 + Real(motion.eta)) * mass.mass * abs(v_hit));
  }
  c.energy = to_double_double(energy);
  return c;
}

model::ImpactProblem<> impact_problem(const RealMotion& motion) {
  const auto n = static_cast<Eigen::Index>(motion.masses.size());
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = system.damping = system.stiffness = Eigen::MatrixXd::Zero(n, n);
  problem.start = {0.0, Eigen::VectorXd(n), Eigen::VectorXd(n)};
  problem.end = motion.end;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& mass = motion.masses[static_cast<std::size_t>(i)];
    system.mass(i, i) = to_double(mass.mass);
    system.damping(i, i) = to_double(2 * mass.mass * motion.sigma);
    system.stiffness(i, i) = to_double(mass.mass * mass.stiffness_over_mass(motion));
    problem.start.u[i] = to_double(mass.start);
    // Not -sigma u when sigma is 0: that is -0, which prints as such.
    problem.start.v[i] = motion.sigma == 0 ? 0.0 : to_double(-motion.sigma * mass.start);
  }
  if (motion.collides) {
    model::Contact<> contact;
    contact.direction = Eigen::VectorXd::Ones(n);
    if (n == 2) contact.direction[1] = -1.0;
    contact.restitution = motion.eta;
    problem.contacts.push_back(contact);
  }
  return problem;
}

PairConstants pair_constants(const RealMotion& motion, const model::ImpactProblem<>& problem) {
  const auto& [mass, damping, stiffness, load, nonlinear] = problem.system;
  const auto frequency = [&](std::size_t i) {
    return Real(sqrt(motion.masses[i].stiffness_over_mass(motion)));
  };
  const Real period = precise_pi() / motion.omega;
  PairConstants c;
  c.ratio = *motion.ratio;
  c.r = motion.r;
  c.m1 = mass(0, 0);
  c.m2 = mass(1, 1);
  c.c1 = damping(0, 0);
  c.c2 = damping(1, 1);
  c.k1 = stiffness(0, 0);
  c.k2 = stiffness(1, 1);
  c.omega1 = to_double(frequency(0));
  c.omega2 = to_double(frequency(1));
  c.omega_D1 = to_double(motion.masses[0].multiple * motion.omega);
  c.omega_D2 = to_double(motion.masses[1].multiple * motion.omega);
  c.xi1 = to_double(motion.sigma / frequency(0));
  c.xi2 = to_double(motion.sigma / frequency(1));
  c.sigma = to_double(motion.sigma);
  c.u1 = problem.start.u[0];
  c.u2 = problem.start.u[1];
  c.v1 = problem.start.v[0];
  c.v2 = problem.start.v[1];
  c.period = to_double(period);
  c.first_impact = to_double(period / 2);
  c.r_star = r_star(c.ratio.odd);
  c.margin = admissibility_margin(c.ratio, motion.r);
  return c;
}

// With x = X phi, phi = pi/2 - Omega t the angle before the impact, slow minus fast displacement
// is proportional to X sin(x/X) + r sin x. Its minimum over r decides: r* = -X sin(x/X)/sin(x) at
// the x in (pi, 3 pi/2) where tan x = X tan(x/X). The ratio is stationary there, so the error of
// the double x (1e-15) enters squared.
Real real_r_star(double X) {
  if (X == 3.0) return 3;
  const double x = graze_angle(X);
  return -X * sin(Real(x) / X) / sin(Real(x));
}

}  // namespace

Derived derive(std::string_view who, const Parameters& parameters) {
  require_ranges(who, parameters);
  const auto motion = std::visit([who](const auto& p) { return motion_of(who, p); }, parameters);
  require_end(who, motion);
  if (motion.ratio) {
    const auto& slow = motion.masses[motion.ratio->is_inverse ? 1 : 0];
    require_admissible(who, *motion.ratio, motion.r,
                       {to_double(motion.omega), to_double(motion.sigma), to_double(slow.start)});
  }
  Derived derived{flight_constants(motion), impact_problem(motion), {}};
  if (motion.ratio) derived.pair = pair_constants(motion, derived.problem);
  return derived;
}

FlightConstants derive_flight(std::string_view who, double omega, double sigma, double eta,
                              double end) {
  require_scale(who, "Omega", omega);
  if (sigma != 0.0 && !(sigma >= smallest_scale && sigma <= largest_scale))
    refuse(who, "sigma", sigma, "0 or 1e-60 <= sigma <= 1e+60");
  require_restitution(who, eta);
  RealMotion motion;
  motion.omega = omega;
  motion.sigma = sigma;
  motion.eta = eta;
  motion.end = end;
  require_end(who, motion);
  return flight_constants(motion);
}

double r_star(double X) {
  return X == 1.0 ? std::numeric_limits<double>::infinity() : to_double(real_r_star(X));
}

double excess_over_r_star(const FrequencyRatio& ratio, double r) {
  if (ratio.odd == 1.0) return -1.0;
  const Real slow_over_fast = ratio.is_inverse ? 1 / Real(r) : Real(r);
  const Real excess = slow_over_fast / real_r_star(ratio.odd) - 1;
  // 1e-25 lies far above the error of r* (1e-29) and far below the distance 1e-16 of a double from
  // an r* that is none; r*(3) = 3 and r*(5) = 4 are doubles.
  return abs(excess) < 1e-25 ? 0.0 : to_double(excess);
}

double highest_harmonic(double odd, double peak, double threshold) {
  const Real X = odd;
  Real n = floor(sqrt(X * X + Real(peak) / threshold) / 2);
  // The root is rounded, these products are exact.
  const auto counts = [&](const Real& m) { return (4 * m * m - X * X) * threshold <= peak; };
  while (!counts(n)) n -= 1;
  while (counts(n + 1)) n += 1;
  return to_double(n);
}

}  // namespace clackers::exact
