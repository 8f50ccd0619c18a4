#pragma once

#include <span>
#include <string_view>

namespace clackers::methods {

/// What a compliant law knows of a contact.
struct CompliantContact {
  double stiffness;    ///< k > 0 [N/m^n], n of the law
  double mass;         ///< effective mass m_e = 1 / (b . M^-1 b) [kg]
  double damping = 0;  ///< CompliantLaw::damping of its restitution, dimensionless
  double w0 = 0;       ///< approach speed at first touch [m/s]; 0: it closed at rest
};

/// A contact force [N], positive in compression, and its derivatives.
struct ContactForce {
  double value = 0.0, by_d = 0.0, by_w = 0.0;
};

/// A law that replaces an impact by a force of the penetration d [m] and its rate w = d' [m/s], with
/// elastic part k d^n. It acts from first touch (d = 0, w = w0) until d <= 0 and w <= 0.
struct CompliantLaw {
  enum class Restitution {
    elastic,   ///< only eta = 1
    positive,  ///< 0 < eta <= 1
    any
  };

  std::string_view name, summary;
  double exponent;  ///< n
  Restitution restitution;
  /// The coefficient of the damping part for eta; 0 for eta = 1.
  double (*damping)(double eta);
  /// The force while the contact acts, for every d and w; 0 for d <= 0 unless the contact has just
  /// closed and its viscous part is in compression.
  ContactForce (*force)(const CompliantContact& contact, double d, double w);
  /// The rebound speed of two free bodies over w0 is eta itself, at every speed.
  bool restitution_is_exact;
  std::string_view source;

  bool models(double eta) const;
  /// How long a contact of two free bodies lasts at this approach speed without damping [s]; damping
  /// makes it longer. Infinite for speed 0 unless n = 1, where speed does not matter.
  double contact_time(double stiffness, double mass, double speed) const;
  /// The stiffness for which contact_time() is `time`.
  double stiffness_for(double time, double mass, double speed) const;
};

/// All laws, the default one first.
std::span<const CompliantLaw> compliant_laws();

/// The law of a name in the table. Throws std::logic_error for another.
const CompliantLaw& compliant_law(std::string_view name);

}  // namespace clackers::methods
