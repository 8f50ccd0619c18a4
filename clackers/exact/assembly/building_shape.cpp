#include "clackers/exact/assembly/building_shape.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/exact/pair/parameters.hpp"

namespace clackers::exact {

using numerics::DoubleDouble;

namespace {

// x over a whole number; one Newton step from the double quotient.
DoubleDouble divide(const DoubleDouble& x, double whole) {
  const double head = x.hi / whole;
  const auto back = numerics::two_product(head, whole);
  return numerics::quick_two_sum(head, ((x.hi - back.hi) - back.lo + x.lo) / whole);
}

// first, first f(1), first f(1) f(2), ... with f a ratio of whole numbers.
template <class Numerator, class Denominator>
std::vector<double> products(const DoubleDouble& first, int count, Numerator numerator,
                             Denominator denominator) {
  std::vector<double> all{first.hi};
  DoubleDouble product = first;
  for (int i = 1; i < count; ++i) {
    product = divide(product * numerator(i), denominator(i));
    all.push_back(product.hi);
  }
  return all;
}

// max over x of |cos^p(x) sin^q(x)| as a logarithm.
double log_peak(double p, double q) {
  const auto part = [&](double x) { return x == 0.0 ? 0.0 : 0.5 * x * std::log(x / (p + q)); };
  return part(p) + part(q);
}

// max over x of |d/dx cos^p(x) sin^q(x)| times exp(scale), for odd p and even q. The maximum is where
// z = sin^2(x) solves (p+q)^2 z^2 - (2q(p+q) + p - q) z + q(q-1) = 0, or z = 1 for p = 1.
double slope_peak(double p, double q, double scale) {
  const double sum = p + q, half = q * sum + 0.5 * (p - q);
  const double root = std::sqrt(half * half - sum * sum * q * (q - 1.0));
  const auto size = [&](double z) {
    if (!(z > 0.0 && z < 1.0)) return 0.0;
    return std::exp(scale + 0.5 * ((p - 1.0) * std::log1p(-z) + (q - 1.0) * std::log(z))) *
           std::abs(q - sum * z);
  };
  return std::max({size((half + root) / (sum * sum)), size((half - root) / (sum * sum)),
                   p == 1.0 ? std::exp(scale) : 0.0});
}

}  // namespace

std::vector<double> Building::masses() const {
  const int n = storeys;
  return products(
      {roof_mass, 0.0}, n, [n](int i) { return double(2 * i - 1) * double(2 * n - 2 * i + 1); },
      [n](int i) { return double(2 * i) * double(2 * n - 2 * i); });
}

std::vector<double> Building::stiffnesses() const {
  auto values = masses();
  for (int i = 1; i <= storeys; ++i)
    values[static_cast<std::size_t>(i - 1)] *=
        double(2 * i - 1) * double(2 * storeys - 2 * i + 1) * frequency * frequency;
  return values;
}

BuildingShape::BuildingShape(const std::vector<Part>& parts, double omega, double sigma)
    : sigma_(sigma) {
  for (const auto& part : parts) {
    const int n = part.storeys;
    Coefficients c{n, part.multiple, omega * part.multiple, quarter_sine(part.multiple) < 0.0, {},
                   {}};
    const auto numerator = [n](int i) { return double(2 * (n - i)); };
    c.v = products({part.velocity, 0.0}, n, numerator, [](int i) { return double(2 * i - 1); });
    // velocity / frequency, rounded like a whole number's quotient.
    const DoubleDouble first = divide(divide({part.velocity, 0.0}, omega), part.multiple);
    c.u = products(first, n, numerator, [](int i) { return double(2 * i + 1); });
    parts_.push_back(std::move(c));
    dof_ += static_cast<std::size_t>(n);
  }
}

BuildingShape::Peaks BuildingShape::peaks(const Coefficients& c, int i) {
  const double p = 2 * (c.storeys - i) + 1, q = 2 * i - 2;
  const double scale = std::log(std::abs(c.v[static_cast<std::size_t>(i - 1)]));
  Peaks peak;
  // Displacements rise until the last drift alone is left, at x = pi/2.
  peak.u = std::abs(c.u.back());
  peak.v = std::exp(scale + log_peak(p, q));
  peak.a = c.frequency * slope_peak(p, q, scale);
  peak.terms = p * std::exp(scale + log_peak(p - 1.0, q + 1.0));
  if (q > 0.0) peak.terms += q * std::exp(scale + log_peak(p + 1.0, q - 1.0));
  peak.terms *= c.frequency;
  return peak;
}

model::Kinematics BuildingShape::amplitude() const {
  const auto size = static_cast<Eigen::Index>(dof_);
  model::Kinematics all{Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size)};
  Eigen::Index at = 0;
  for (const auto& c : parts_)
    for (int i = 1; i <= c.storeys; ++i, ++at) {
      const auto peak = peaks(c, i);
      all.u[at] = peak.u;
      all.v[at] = peak.v + sigma_ * peak.u;
      all.a[at] = peak.a + sigma_ * (2.0 * peak.v + sigma_ * peak.u);
    }
  return all;
}

model::Kinematics BuildingShape::error() const {
  const auto size = static_cast<Eigen::Index>(dof_);
  model::Kinematics all{Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size)};
  Eigen::Index at = 0;
  for (const auto& c : parts_) {
    const double units = (3.0 * c.storeys + 14.0) * 0x1p-53;
    for (int i = 1; i <= c.storeys; ++i, ++at) {
      const auto peak = peaks(c, i);
      all.u[at] = units * peak.u;
      all.v[at] = units * (peak.v + sigma_ * peak.u);
      all.a[at] = units * (peak.terms + sigma_ * (2.0 * peak.v + sigma_ * peak.u));
    }
  }
  return all;
}

}  // namespace clackers::exact
