#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/methods/contact/compliant_law.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {

struct Penalty {
  static constexpr std::string_view name = "penalty";
  static constexpr bool takes_friction = true;
  static constexpr std::string_view summary =
      "a one-sided spring or spring and damper in place of each contact, as in finite-element codes";
  static constexpr std::string_view card =
      R"(A one-sided compliant law in place of each contact, in the integrator's own equilibrium:

    M a + C v + K u + p(u, v) = f(t),   p = -sum_j F(d_j, w_j) b_j,   d_j = gap_j - b_j . u,
    w_j = -b_j . v

solved by Newton's iteration where the integrator is implicit. The law is one of

    linear                   F = k d
    hertz                    F = k d^1.5
    kelvin-voigt             F = k d + 2 xi sqrt(k m_e) w,  xi = -ln(eta)/sqrt(pi^2 + ln(eta)^2)
    kelvin-voigt-no-tension  the same where it is positive, otherwise 0
    hunt-crossley            F = k d^1.5 (1 + 3 (1 - eta)/2 w/w0)
    lankarani-nikravesh      F = k d^1.5 (1 + 3 (1 - eta^2)/4 w/w0)
    ye                       F = k d^1.5 (1 + 8 (1 - eta)/(5 eta) w/w0)
    jankowski                F = k d^1.5, for w > 0 with 2 xi sqrt(k m_e sqrt(d)) w more,
                             xi = 9 sqrt(5)/2 (1 - eta^2)/(eta (eta (9 pi - 16) + 16))

with 1/m_e = b . M^-1 b and the approach speed w0 at first touch. The elastic laws, linear and
hertz, model only eta = 1, ye and jankowski eta > 0; for eta = 1 all are elastic. kelvin-voigt
rebounds with eta itself; with the others, other than 1, the masses rebound with another
restitution (nominal 0.5: 0.550, 0.663, 0.725, 0.470, 0.495 in the order above), so that their
limit for stiff contacts is another motion. A contact that closes at rest has w0 = 0 and then no
hysteretic damping.

An impact is reported at the first touch of each contact, located on the step map, with equal
velocities before and after and no impulse: the force acts later, over the contact time,
pi sqrt(m_e/k) of a linear law and 3.2180 (m_e^2/(k^2 w0))^(1/5) of the others, without damping.
The default stiffness of a contact is, for a linear law, 1e4 times the diagonal stiffness of the
first degree of freedom in its row, or more: so much that a contact lasts at most a fortieth of
the shortest period of a mass in its row, alone on its springs. A softer contact lets the fast
mass bounce where the true masses do not collide. For the other laws it is the one with the same
contact time at the approach speed sqrt(2 E/m_e), the largest that the energy E at the start
allows.

Dry friction becomes a smooth force of the sliding speed s, with x = s/width

    F = kinetic tanh x + (limit - kinetic) x/3 exp((1 - x^2/9)/2)

under which nothing comes to rest: what should stick creeps. The default width is a hundredth of
the speed limit/(m_e omega) that a mass in the row, alone on its springs of frequency omega, gains
by the limit; a step of m_e width/limit or less resolves it. Friction is taken without contacts.

Order       none: the error comes to stand at the contact time, of order k^(-1/2) for linear
            laws and k^(-2/5) for the others.
Stability   that of the integrator with the stiffness of the closed contact.
Dissipation that of integrator and law; energy is created or lost where a contact lasts few
            steps.
Memory      that of the integrator; w0 of each closed contact.
Rest        on the spring, after the rebounds of the law; a closed contact reports nothing.
Cost        that of the integrator while all contacts are open; with a closed one one to three
            corrections by Newton's iteration, each a factorization, or for more than two degrees
            of freedom a back-substitution and one more for each closed contact.
Source      P. Wriggers, Computational Contact Mechanics, 2nd ed., Springer (2006); of each law:
            clackers show penalty:law=NAME.
)";
  static const std::vector<Field<Penalty>>& fields();

  std::string law{compliant_laws().front().name};
  /// [N/m], with n = 3/2 [N/m^1.5], > 0; NaN: the default above.
  double stiffness = std::numeric_limits<double>::quiet_NaN();
  /// [m/s], > 0; NaN: the default above.
  double width = std::numeric_limits<double>::quiet_NaN();

  /// Throws InputError unless 0 < stiffness < infinity, or NaN.
  void validate() const;
  Claim claim(const Facts& integrator) const;
  double model_order() const;
  /// To those of linear motion only.
  std::optional<Objection> objection_to(const Facts& method) const;
  std::optional<Objection> objection(const Facts& method,
                                     const model::ImpactProblem<>& problem) const;
  /// The shortest of the contacts', at the largest approach speed that the energy at the start
  /// allows [s]; 0 without contacts, and where that speed is needed and 0.
  double contact_time(const model::ImpactProblem<>& problem) const;
  /// Of the regular law of each row of friction [m/s]; infinite where there is no default.
  template <int Dof>
  std::vector<double> widths(const model::ImpactProblem<Dof>& problem) const;
  /// Of each contact [N/m^n]. Infinite, NaN or 0 where there is no default.
  template <int Dof>
  std::vector<double> stiffnesses(const model::ImpactProblem<Dof>& problem) const;

  /// The smooth law in place of friction.
  template <int Dof>
  model::ImpactProblem<Dof> with_regular_friction(model::ImpactProblem<Dof> problem) const;

  template <int Dof>
  class Loop;
};

}  // namespace clackers::methods
