#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/flights_enclosure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/error.hpp"

namespace clackers::certified {

const BallFlights* FlightsEnclosure::begun(std::size_t flight) {
  constexpr long most_bits = 1 << 15;
  const auto refuse = [&](const char* why) {
    throw InputError(
        fmt::format(
            "digits: {}; allowed: values other than 0, and motions up to where "
            "contacts stay closed, and of one mass from its rest to the end on, of impacts whose order is certain.",
            why),
        "no-enclosure");
  };
  if (WorkingBits::now() > most_bits) refuse("a value is 0, or an impact has no speed");
  if (bits_ < WorkingBits::now()) begun_.clear();
  bits_ = std::max(bits_, WorkingBits::now());
  const WorkingBits scope(bits_);
  if (begun_.empty()) begun_.emplace_back(motion_.problem());
  while (begun_.size() <= flight) {
    const auto event = motion_.event(begun_.size() - 1);
    if (!event) refuse("a contact is held, or contacts close together by chance");
    auto next = begun_.back();
    if (!next.pass(*event)) return nullptr;
    begun_.push_back(std::move(next));
  }
  return &begun_[flight];
}

std::optional<std::pair<Eigen::VectorXd, Eigen::VectorXd>> FlightsEnclosure::doubles(
    std::size_t flight, double t) {
  constexpr long least_bits = 256, most_bits = 512, wanted = 100;
  for (long bits = std::max(bits_, least_bits); bits <= most_bits; bits *= 2) try {
      const WorkingBits scope(bits);
      const auto* known = begun(flight);
      if (known == nullptr || !known->is_known(wanted)) continue;
      const auto now = known->at(t);
      std::pair<Eigen::VectorXd, Eigen::VectorXd> state{motion_.dof(), motion_.dof()};
      for (std::size_t i = 0; i < now.u.size(); ++i) {
        state.first[long(i)] = now.u[i].middle();
        state.second[long(i)] = now.v[i].middle();
      }
      return state;
    } catch (const InputError&) {
      break;
    }
  return std::nullopt;
}

// Contacts of one mass that is held to the end: it is at the gap, exactly, and does not move.
const model::Contact<>* FlightsEnclosure::holding(double t) const {
  if (motion_.dof() > 1) return nullptr;
  for (const auto& closed : motion_.closed_contacts())
    if (!closed.opens && closed.begins.hi <= t)
      return &motion_.problem().contacts[std::size_t(closed.contact)];
  return nullptr;
}

KinematicBalls FlightsEnclosure::at_now(long long k, double t) {
  if (const auto* held = holding(t))
    return {{Ball(held->gap) / held->direction[0]}, {Ball()}, {Ball()}};
  if (const auto* known = begun(std::size_t(k))) return known->at(t);
  Ball any;
  arb_indeterminate(any.get());
  const std::vector<Ball> unknown(std::size_t(motion_.dof()), any);
  return {unknown, unknown, unknown};
}

ImpactBalls FlightsEnclosure::impact_now(long long k) {
  const auto flight = motion_.flight_before(k);
  ImpactBalls hit;
  if (begun(flight + 1) == nullptr) {
    arb_indeterminate(hit.t.get());
    return hit;
  }
  auto flights = begun_[flight];
  const auto event = *motion_.event(flight);
  flights.end(event.contacts, event.when.lo, event.when.hi);
  const auto& s = motion_.problem().system;
  const auto state = [&](KinematicBalls& to, Ball& energy) {
    to = flights.at_begin();
    for (std::size_t i = 0; i < to.u.size(); ++i)
      for (std::size_t j = 0; j < to.u.size(); ++j)
        energy = energy + scaled(to.v[i] * to.v[j] * s.mass(long(i), long(j)) +
                                     to.u[i] * to.u[j] * s.stiffness(long(i), long(j)),
                                 -1);
  };
  state(hit.before, hit.energy_before);
  const auto impulses = flights.collide(event.contacts);
  state(hit.after, hit.energy_after);
  hit.t = flights.begin();
  for (std::size_t c = 0; c < impulses.size(); ++c)
    if (int(event.contacts[c]) == motion_.impact(k).contact) hit.impulse = impulses[c];
  return hit;
}

}  // namespace clackers::certified

#endif
