#pragma once

#include <string>
#include <string_view>

namespace clackers {

/// What was measured of a method on a ladder of steps; one a method. The codes of the same
/// names (`clackers explain proper`) define each in words.
enum class Behaviour { exact, proper, reduced, irregular, stagnating, divergent, undecided };

/// What was found against what is claimed.
enum class Verdict { agrees, disagrees, not_claimed, undecided };

/// What a method promises of its errors through impacts: of the displacement's, and of the velocity's
/// where its order is another.
struct Claim {
  Behaviour behaviour = Behaviour::undecided;  ///< undecided: nothing is claimed of displacements
  /// Order of the error, or of its upper envelope when irregular. 0 when stagnating.
  double order = 0.0;
  /// Code of the reason when the behaviour needs one ("contact-stiffness"), otherwise empty.
  std::string reason;
  double velocity_order = 0.0;  ///< 0: nothing is claimed of velocities

  bool is_made() const { return behaviour != Behaviour::undecided || velocity_order > 0.0; }
  bool operator==(const Claim&) const = default;
};

std::string_view to_string(Behaviour behaviour);
std::string_view to_string(Verdict verdict);  ///< "agrees", "disagrees", "not claimed", "undecided"

/// The reverse of to_string. Throws InputError for any other text.
Behaviour behaviour_from(std::string_view text);

/// Whether errors fall towards the exact motion: exact, proper, reduced or irregular.
bool converges(Behaviour behaviour);

}  // namespace clackers
