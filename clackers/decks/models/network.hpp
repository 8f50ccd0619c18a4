#pragma once

#include <string_view>
#include <vector>

#include "clackers/decks/deck.hpp"
#include "clackers/decks/text.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::decks {

inline constexpr int ground = -1;

/// A spring and damper between two masses (from 0), or a mass and the ground.
struct Link {
  int mass, other;
  double stiffness, damping;
};

/// u of `upper` - u of `lower` >= gap: a contact, or a spring that acts where it is violated.
struct Stop {
  int upper, lower;
  double gap, restitution, stiffness;
};

/// What a format has.
struct Abilities {
  bool restitution = false;  ///< below 1
  bool loads = false;        ///< amplitude cos(frequency t + phase)
  bool springs = true;       ///< in compression only
};

/// A problem as elements: diagonal masses, links, stops. Where the program has no contact with a coefficient
/// of restitution, a spring takes its place: `stiffness` lets a contact last `contact_time`.
struct Network {
  std::vector<double> masses;
  std::vector<Link> links;
  std::vector<Stop> contacts, springs;
  std::vector<model::HarmonicForce> loads;
  double contact_time = 0.0;  ///< [s]

  /// The contacts, each with the stiffness that stands for it, and the springs.
  std::vector<Stop> one_sided() const;
};

/// Throws InputError (no-deck) for a mass matrix that is not diagonal, a direction that is no difference of
/// two displacements, and for what the format lacks.
Network network_of(const Subject& subject, std::string_view format, Abilities abilities);

/// The ladder of a compliant contact: from 8 to 64 steps a contact, or of a problem without contacts
/// from 16 to 256 a period; and what `check` expects of an integrator of that order.
std::vector<Level> compliant_steps(const Network& network, const model::ImpactProblem<>& problem);
std::string_view compliant_claim(const Network& network,
                                 std::string_view smooth = "--expect proper:2");

/// "Each contact is a spring of k N/m that lasts t s": a comment of the model.
std::string stiffness_note(const Network& network);

}  // namespace clackers::decks
