#include "clackers/methods/contact/compliant_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace clackers::methods {
namespace {

double none(double) { return 0.0; }

ContactForce linear(const CompliantContact& c, double d, double) {
  if (!(d > 0.0)) return {};
  return {c.stiffness * d, c.stiffness, 0.0};
}

ContactForce hertz(const CompliantContact& c, double d, double) {
  if (!(d > 0.0)) return {};
  const double k_root = c.stiffness * std::sqrt(d);
  return {k_root * d, 1.5 * k_root, 0.0};
}

// The damping ratio of a linear oscillator that rebounds with eta: its amplitude falls by
// exp(-pi xi / sqrt(1 - xi^2)) in half a period.
double viscous(double eta) {
  if (!(eta > 0.0)) return 1.0;
  const double ln = -std::log(eta);
  return ln / std::hypot(std::numbers::pi, ln);
}

ContactForce spring_and_damper(const CompliantContact& c, double d, double w) {
  const double damper = 2.0 * c.damping * std::sqrt(c.stiffness * c.mass);
  return {c.stiffness * d + damper * w, c.stiffness, damper};
}

ContactForce kelvin_voigt(const CompliantContact& c, double d, double w) {
  const auto force = spring_and_damper(c, d, w);
  return d > 0.0 || force.value > 0.0 ? force : ContactForce{};
}

ContactForce kelvin_voigt_no_tension(const CompliantContact& c, double d, double w) {
  const auto force = spring_and_damper(c, d, w);
  return force.value > 0.0 ? force : ContactForce{};
}

double hunt_crossley(double eta) { return 1.5 * (1.0 - eta); }
double lankarani_nikravesh(double eta) { return 0.75 * (1.0 - eta * eta); }
double ye(double eta) { return 1.6 * (1.0 - eta) / eta; }

ContactForce hysteretic(const CompliantContact& c, double d, double w) {
  const auto elastic = hertz(c, d, w);
  if (!(c.w0 > 0.0)) return elastic;
  const double slope = c.damping / c.w0, factor = 1.0 + slope * w;
  return {elastic.value * factor, elastic.by_d * factor, elastic.value * slope};
}

double jankowski(double eta) {
  const double pi = std::numbers::pi;
  return 4.5 * std::sqrt(5.0) * (1.0 - eta * eta) / (eta * (eta * (9.0 * pi - 16.0) + 16.0));
}

ContactForce damped_approach(const CompliantContact& c, double d, double w) {
  auto force = hertz(c, d, w);
  if (!(d > 0.0 && w > 0.0)) return force;
  const double damper = 2.0 * c.damping * std::sqrt(c.stiffness * std::sqrt(d) * c.mass);
  force.value += damper * w;
  force.by_d += 0.25 * damper * w / d;
  force.by_w = damper;
  return force;
}

using enum CompliantLaw::Restitution;

constexpr auto table = std::to_array<CompliantLaw>({
    {"linear", "F = k d, elastic", 1.0, elastic, none, linear, true,
     "P. Wriggers, Computational Contact Mechanics, 2nd ed., Springer (2006)"},
    {"hertz", "F = k d^1.5, elastic", 1.5, elastic, none, hertz, true,
     "H. Hertz, J. Reine Angew. Math. 92, 156-171 (1882)"},
    {"kelvin-voigt", "F = k d + c w, exact eta; in tension before it opens", 1.0, any, viscous,
     kelvin_voigt, true, "S. A. Anagnostopoulos, Earthq. Eng. Struct. Dyn. 16, 443-456 (1988)"},
    {"kelvin-voigt-no-tension", "F = max(0, k d + c w); rebounds faster than eta", 1.0, any,
     viscous, kelvin_voigt_no_tension, false,
     "S. A. Anagnostopoulos, Earthq. Eng. Struct. Dyn. 33, 897-902 (2004)"},
    {"hunt-crossley", "F = k d^1.5 (1 + 3 (1 - eta) / 2 w / w0); rebounds faster than eta", 1.5,
     any, hunt_crossley, hysteretic, false,
     "K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42, 440-445 (1975)"},
    {"lankarani-nikravesh", "F = k d^1.5 (1 + 3 (1 - eta^2) / 4 w / w0); rebounds faster than eta",
     1.5, any, lankarani_nikravesh, hysteretic, false,
     "H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112, 369-376 (1990)"},
    {"ye", "F = k d^1.5 (1 + 8 (1 - eta) / (5 eta) w / w0); nearly eta", 1.5, positive, ye,
     hysteretic, false, "K. Ye, L. Li, H. Zhu, Earthq. Eng. Struct. Dyn. 38, 1135-1142 (2009)"},
    {"jankowski", "F = k d^1.5, and a damper c(d) w while approaching; nearly eta", 1.5, positive,
     jankowski, damped_approach, false,
     "R. Jankowski, Earthq. Eng. Struct. Dyn. 35, 517-524 (2006)"},
});

// d of a free contact runs from 0 to its peak and back in 2 I peak / w0, and
// I = integral over x in [0, 1] of (1 - x^(n + 1))^(-1/2).
double twice_integral(double n) {
  const double p = 1.0 / (n + 1.0);
  return 2.0 * p * std::sqrt(std::numbers::pi) * std::tgamma(p) / std::tgamma(p + 0.5);
}

}  // namespace

bool CompliantLaw::models(double eta) const {
  return restitution == any || eta == 1.0 || (restitution == positive && eta > 0.0);
}

// k peak^(n + 1) / (n + 1) = m_e w0^2 / 2 gives the peak.
double CompliantLaw::contact_time(double stiffness, double mass, double speed) const {
  const double n = exponent;
  return twice_integral(n) * std::pow(0.5 * (n + 1.0) * mass / stiffness, 1.0 / (n + 1.0)) *
         std::pow(speed, (1.0 - n) / (1.0 + n));
}

double CompliantLaw::stiffness_for(double time, double mass, double speed) const {
  const double n = exponent;
  const double peak_factor = time / twice_integral(n) * std::pow(speed, (n - 1.0) / (n + 1.0));
  return 0.5 * (n + 1.0) * mass / std::pow(peak_factor, n + 1.0);
}

std::span<const CompliantLaw> compliant_laws() { return table; }

const CompliantLaw& compliant_law(std::string_view name) {
  const auto row = std::ranges::find(table, name, &CompliantLaw::name);
  if (row == table.end()) throw std::logic_error("no compliant law " + std::string(name));
  return *row;
}

}  // namespace clackers::methods
