#include "clackers/exact/pair/exact_data_pair.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/parameter_ranges.hpp"
#include "clackers/exact/pair/wide_motion.hpp"

namespace clackers::exact {
namespace {

// Sums and products of at most seven doubles within the ranges below are exact in so many bits:
// X^2 Omega^2 and sigma^2 are at most 460 binary places apart.
using Exact = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<1024, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

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

WideMotion exact_data_motion(std::string_view who, const ExactDataParameters& p) {
  constexpr double smallest = 1e-30, largest = 1e30;
  require_scale(who, "m2", p.m2, smallest, largest);
  require_scale(who, "Omega", p.Omega, smallest, largest);
  if (p.sigma != 0.0) require_scale(who, "sigma", p.sigma, smallest, largest);
  require_scale(who, "A_over_X", p.A_over_X, smallest, largest);
  require_scale(who, "r", p.r, smallest, largest);
  require_restitution(who, p.eta);
  const auto ratio = frequency_ratio(who, p.X);
  if (ratio.exchanged)
    refuse(who, "X", p.X, "an odd whole number",
           "1 over one is no short binary fraction; swap the masses instead.", "not-odd");
  require_exact_data(who, p);

  const Wide quotient = p.A_over_X;
  WideMotion motion;
  motion.omega = p.Omega;
  motion.sigma = p.sigma;
  motion.eta = p.eta;
  motion.end = p.t_end;
  motion.masses = {{Wide(p.r) * p.m2, quotient * p.X, 1.0},
                   {p.m2, -quarter_sine(p.X) * Wide(p.r) * quotient, p.X}};
  require_end(who, motion);
  require_admissible(who, motion, ratio, p.r);
  return motion;
}

}  // namespace

ExactDataPair::ExactDataPair(const ExactDataParameters& p, std::string_view who)
    : ExactDataPair(p, exact_data_motion(who, p)) {}

ExactDataPair::ExactDataPair(const ExactDataParameters& p, const WideMotion& motion)
    : ClosedForm(motion), parameters_(p), constants_(pair_constants(motion, {p.X, false})) {}

}  // namespace clackers::exact
