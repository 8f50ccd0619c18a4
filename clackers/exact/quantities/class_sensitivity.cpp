#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/quantities/sensitivity.hpp"
#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {
namespace {

using model::Kinematics;
using model::Side;
using Complex = std::complex<double>;

// Derivatives of what the motion is made of: of Omega and sigma, and of ln eta and ln |u_i(0)|.
struct Rates {
  double omega = 0.0, sigma = 0.0, log_eta = 0.0;
  double log_start[2] = {0.0, 0.0};
};

struct Named {
  std::string name;
  Rates rates;
};

double over(double x) { return x == 0.0 ? 0.0 : 1.0 / x; }

// omega1 [rad/s] is the undamped frequency of the mass whose damping ratio xi1 is.
Rates rates_of_damping_ratio(double omega, double omega1, double xi1) {
  return {.omega = -omega * xi1 / ((1.0 - xi1) * (1.0 + xi1)), .sigma = omega1};
}

std::vector<Named> table(double omega, double sigma, const PairParameters& p) {
  return {{"m1", {.omega = -0.5 * omega / p.m1, .sigma = -0.5 * sigma / p.m1}},
          {"k1", {.omega = 0.5 * omega / p.k1, .sigma = 0.5 * sigma / p.k1}},
          {"xi1", rates_of_damping_ratio(omega, std::sqrt(p.k1 / p.m1), p.xi1)},
          {"A", {.log_start = {1.0 / p.A, 1.0 / p.A}}},
          {"r", {.log_start = {0.0, 1.0 / p.r}}},
          {"eta", {.log_eta = over(p.eta)}}};
}

std::vector<Named> table(double, double, const ExactDataParameters& p) {
  return {{"m2", {}},
          {"Omega", {.omega = 1.0}},
          {"sigma", {.sigma = 1.0}},
          {"A_over_X", {.log_start = {1.0 / p.A_over_X, 1.0 / p.A_over_X}}},
          {"r", {.log_start = {0.0, 1.0 / p.r}}},
          {"eta", {.log_eta = over(p.eta)}}};
}

std::vector<Named> table(double omega, double, const RigidStopParameters& p) {
  return {{"xi1", rates_of_damping_ratio(omega, 1.0, p.xi1)}, {"eta", {.log_eta = over(p.eta)}}};
}

std::vector<Named> table(double omega, double, const FreeMassParameters& p) {
  return {{"xi1", rates_of_damping_ratio(omega, 1.0, p.xi1)}};
}

std::vector<Named> table(const ClosedForm& motion) {
  const auto& c = motion.flight();
  const double omega = c.turns.hi * numerics::pi.hi, sigma = c.decay.hi * std::log(2.0);
  return std::visit([&](const auto& p) { return table(omega, sigma, p); }, motion.parameters());
}

// Of U = b eta^k exp(lambda t - i p k pi), lambda = -sigma + i p Omega, the motion is the real part:
// u of U, v of lambda U, a of lambda^2 U.
class ClassSensitivity : public Sensitivity {
 public:
  ClassSensitivity(const ClosedForm& motion, const Rates& rates) : motion_(motion), rates_(rates) {}

  Kinematics at(double t, Side side) const override {
    const auto [flight, theta_over_pi] = motion_.phase(t, side);
    const auto& c = motion_.flight();
    const auto n = static_cast<Eigen::Index>(c.masses.size());
    Kinematics d{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
    if (c.eta == 0.0 && flight > 0.0) return d;
    const auto halvings = c.log2_eta * flight - c.decay * t;
    // Smaller than every double.
    if (halvings.hi < -4000.0) return d;
    const auto [significand, exponent] = numerics::exp2(halvings);
    const double sigma = c.decay.hi * std::log(2.0), omega = c.turns.hi * numerics::pi.hi;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& mass = c.masses[static_cast<std::size_t>(i)];
      const auto [sine, cosine] = numerics::sincospi(theta_over_pi * mass.multiple);
      // Without 2^exponent, which may leave the doubles where the derivative does not.
      const Complex U = significand.hi * Complex(cosine.hi, sine.hi);
      const double b = mass.b.hi;
      const Complex lambda(-sigma, mass.multiple * omega);
      const Complex change(-rates_.sigma, mass.multiple * rates_.omega);
      const Complex growth = rates_.log_start[i] + flight * rates_.log_eta + t * change;
      const auto scaled = [&, e = exponent](const Complex& factor) {
        return numerics::scale((b * factor * U).real(), e) + 0.0;  // no -0
      };
      d.u[i] = scaled(growth);
      d.v[i] = scaled(change + lambda * growth);
      d.a[i] = scaled(lambda * (2.0 * change + lambda * growth));
    }
    return d;
  }

 private:
  const ClosedForm& motion_;
  Rates rates_;
};

}  // namespace

std::vector<std::string> class_parameters(const ClosedForm& motion) {
  std::vector<std::string> names;
  for (const auto& row : table(motion)) names.push_back(row.name);
  return names;
}

std::unique_ptr<Sensitivity> class_sensitivity(const ClosedForm& motion,
                                               std::string_view parameter) {
  const auto all = table(motion);
  const auto found = std::ranges::find(all, parameter, &Named::name);
  if (found == all.end()) {
    const auto names = class_parameters(motion);
    refuse_name("class parameter to differentiate by", parameter, names,
                fmt::format("{}", fmt::join(names, ", ")));
  }
  if (parameter == "eta" && motion.flight().eta == 0.0 &&
      motion.phase(motion.end(), Side::right).flight > 0.0)
    throw InputError(
        "sensitivity to eta: eta = 0; allowed: 0 < eta <= 1. At 0 the masses come to rest together "
        "and restitution can only grow: there is no derivative. Use a small eta instead.",
        "no-derivative");
  return std::make_unique<ClassSensitivity>(motion, found->rates);
}

}  // namespace clackers::exact
