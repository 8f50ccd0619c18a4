#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/flights_enclosure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "clackers/base/error.hpp"

namespace clackers::certified {

namespace {

// Of the fraction of whole numbers that a double is.
double bits_of(double x) {
  int exponent = 0, bits = 53;
  auto whole = static_cast<long long>(std::ldexp(std::frexp(std::abs(x), &exponent), bits));
  if (whole == 0) return 0.0;
  for (; whole % 2 == 0; whole /= 2) --bits;
  return bits + std::abs(exponent - bits);
}

}  // namespace

bool FlightsEnclosure::is_undamped() const {
  const auto& problem = motion_.problem();
  const auto* load = problem.system.add_load.target<model::HarmonicLoad>();
  return motion_.dof() == 1 && problem.system.damping.isZero(0.0) &&
         model::one_sided_springs(problem) == nullptr &&
         (load == nullptr || std::ranges::all_of(load->forces(), [](const auto& f) {
            return f.frequency == 0.0 && f.phase == 0.0;
          }));
}

// Energies and impulses, squared, are polynomials of degree 8 at most in the numbers of the problem, divided by as many; each
// impact multiplies speeds by a restitution.
double FlightsEnclosure::fraction_bits(long long flights) const {
  if (!is_undamped()) return 16384.0 + 4400.0 * motion_.dof();
  const auto& problem = motion_.problem();
  double bits = 4.0 + bits_of(problem.system.mass(0, 0)) + bits_of(problem.system.stiffness(0, 0)) +
                bits_of(problem.start.u[0]) + bits_of(problem.start.v[0]),
         restitution = 0.0;
  if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>())
    for (const auto& force : load->forces()) bits += bits_of(force.amplitude);
  for (const auto& contact : problem.contacts) {
    bits += bits_of(contact.gap) + bits_of(contact.direction[0]);
    restitution = std::max(restitution, bits_of(contact.restitution));
  }
  return 8.0 * (bits + restitution * double(flights + 1));
}

long long FlightsEnclosure::flight(double t, model::Side side) {
  auto k = motion_.flight_at(t, side);
  if (motion_.flight_at(t, model::Side::left) == motion_.flight_at(t, model::Side::right)) {
    while (k > 0 && order(t, k - 1) < 0) --k;
    while (order(t, k) > 0) ++k;
  }
  return static_cast<long long>(k);
}

int FlightsEnclosure::order(double t, std::size_t flight) {
  constexpr long least_bits = 128, most_bits = 4096;
  const auto event = motion_.event(flight);
  if (!event || t < event->when.lo || t > event->when.hi) return 0;
  for (long bits = least_bits; bits <= most_bits; bits *= 2) {
    const WorkingBits scope(bits);
    const auto* next = begun(flight + 1);
    if (next != nullptr && Ball(t) < next->begin()) return -1;
    if (next != nullptr && next->begin() < Ball(t)) return 1;
  }
  return 0;
}

const BallFlights* FlightsEnclosure::begun(std::size_t flight) {
  constexpr long most_bits = 1 << 15;
  const auto refuse = [](const char* why, const char* allowed) {
    throw InputError(fmt::format("digits: {}; allowed: {}.", why, allowed), "no-enclosure");
  };
  if (WorkingBits::now() > most_bits && is_stuck_)
    refuse("an impact or a release has no speed that its instant lets be seen",
           "motions up to there");
  if (WorkingBits::now() > most_bits)
    refuse("a value is 0 or halfway between two decimal numbers",
           "other values, or another number of digits");
  if (!motion_.is_resolved(flight))
    refuse("impacts accumulate, or a contact closes without a speed",
           "times before, and of one mass those from its rest to the end");
  if (bits_ < WorkingBits::now()) begun_.clear();
  bits_ = std::max(bits_, WorkingBits::now());
  const WorkingBits scope(bits_);
  if (begun_.empty()) begun_.emplace_back(motion_.problem(), motion_.held(0));
  is_stuck_ = false;
  while (begun_.size() <= flight) {
    const auto event = motion_.event(begun_.size() - 1);
    if (!event)
      refuse("contacts close together by chance", "motions of impacts whose order is certain");
    auto next = begun_.back();
    is_stuck_ = !next.end(*event);
    if (is_stuck_) return nullptr;
    next.pass(*event, motion_.held(begun_.size()));
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
  flights.end(event);
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
  const auto impulses = flights.pass(event, motion_.held(flight + 1));
  state(hit.after, hit.energy_after);
  hit.t = flights.begin();
  for (std::size_t c = 0; c < impulses.size(); ++c)
    if (int(event.contacts[c]) == motion_.impact(k).contact) hit.impulse = impulses[c];
  return hit;
}

}  // namespace clackers::certified

#endif
