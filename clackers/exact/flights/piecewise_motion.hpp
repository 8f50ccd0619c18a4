#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/exact/flights/flight_errors.hpp"
#include "clackers/exact/flights/forced_modes.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::exact {

/// How impacts depart from Newton's law at the instant of contact. The default is the law itself.
struct ImpactLaw {
  /// The impulse is multiplied by these, one factor a mass; empty for 1. A factor that differs from
  /// mass to mass does not conserve momentum.
  std::vector<double> impulse_factor{};
  /// Impact that has no effect, and the one whose impulse acts twice; from 1, 0 for none. After
  /// a missed one masses pass through each other and come back without an impact.
  int missed = 0, doubled = 0;
  /// Impacts act at the first time start + n grid [s] that is not before the contact, with the
  /// velocities of that time; 0 for the instant of contact.
  double grid = 0.0;
  /// Damping is multiplied by this after the first impact.
  double damping_after_impact = 1.0;
};

/// The motion of any linear structure with contacts, flight by flight: between impacts modes of
/// free vibration and the steady response to harmonic forces, impacts located by steps that pass no
/// contact (first_crossing.hpp). Contacts that close together (simultaneity.hpp) obey Newton's law
/// all at once: impulses p >= 0, b . v(+) >= -restitution b . v(-), one of each pair an equality; a
/// linear complementarity problem.
///
/// Contacts that are one-sided springs (model::OneSidedSprings) are closed or open: a closed one is
/// part of another modal system. The force is continuous where they close and open, so a wrong
/// switching time has no effect of first order. Dips below 1e-14 of the sizes may remain unnoticed.
///
/// Contacts stay closed after impacts without restitution, after impacts that accumulate and from a start in
/// touch, as constraints of another modal system, until their force ends (resting_contacts.cpp). At
/// impacts of others they obey the law with them. Of impacts that accumulate the last are not
/// followed, but allowed for in the bound.
///
/// error_bound() holds to first order in rounding: the errors of each flight, among them those of
/// modes by what they leave of the equations, are carried on by the flights' own maps and through
/// each impact by its saltation matrix, increased by the terms of second order there. The whole
/// motion is refused where errors of that size decide whether masses touch or part, or which contact
/// closes first. Const, safe to share between threads. Source: piecewise modal superposition, common.
class PiecewiseMotion : public model::Motion {
 public:
  /// Throws InputError for an invalid problem, a start at another time than 0, two contacts in the
  /// same direction, and as ForcedModes does; and where the motion is not available: a
  /// contact that is approached to less than the error, a force that comes so near to 0, impacts
  /// whose order decides and is not certain, two contacts of coupled masses that
  /// accumulate together, more than 1e5 flights, more than 2 GB of errors; displacements at
  /// the end that are not known to 1 % of the largest.
  explicit PiecewiseMotion(const model::ImpactProblem<>& problem,
                           std::string_view who = "piecewise");
  /// The motion in double precision from start.t on, whatever the error: what it would not let be
  /// seen is decided by rounding, and error_bound() is infinite. Restitution may be above 1, and damping
  /// below 0; impacts that depart from Newton's law come one after another. Throws InputError as above for what is not
  /// available, a contact violated at the start and more than `most_impacts` flights.
  PiecewiseMotion(const model::ImpactProblem<>& problem, const ImpactLaw& law, double until,
                  int most_impacts);

  int dof() const override { return int(regimes_[0].dof()); }
  double end() const override { return end_; }
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;
  /// What the modes of the present flight can add up to, and the steady response.
  model::Kinematics envelope(double t) const override;
  model::Kinematics error_bound(double t) const override;
  long long impact_count(double t) const override;
  /// Of contacts that close together each is an impact of its own, with the velocities before and
  /// after all of them.
  model::MotionImpact impact(long long index) const override;
  std::vector<model::ClosedContact> closed_contacts() const override { return closed_; }
  Eigen::VectorXd contact_forces(double t, model::Side side) const override;

  /// What ends a flight: contacts that close together and push, and held ones that do then; held contacts whose
  /// force ends; or a spring that closes or opens, whose number follows those of the contacts.
  struct Event {
    model::TimeEnclosure when;
    std::vector<std::size_t> contacts;
  };
  /// Of flight 0, 1, ..., for a second way to the motion. Nothing where contacts close together by no
  /// symmetry, or where it does not end.
  std::optional<Event> event(std::size_t flight) const;
  /// Whether flights resolve all that happens before this one.
  bool is_resolved(std::size_t flight) const;
  /// Contacts that are held in it, ascending.
  std::vector<std::size_t> held(std::size_t flight) const {
    return held_in(flights_[flight].regime);
  }
  /// The flight at t, and the one that impact 1, 2, ... ends.
  std::size_t flight_at(double t, model::Side side) const;
  std::size_t flight_before(long long impact) const {
    return hits_[std::size_t(impact - 1)].flight;
  }
  const model::ImpactProblem<>& problem() const { return problem_; }

  /// Of the structure with all springs open.
  const numerics::ModalSystem& modes() const { return regimes_[0].system(); }
  /// Times at which springs close [s], ascending.
  const std::vector<double>& spring_contacts() const { return spring_contacts_; }

 private:
  using Vector = Eigen::VectorXd;
  class Builder;
  /// What flights do not resolve: impacts that accumulate, or a landing without speed, of a contact
  /// that is closed for certain from `until` on.
  struct Unresolved {
    std::size_t contact = 0;
    double from = 0.0, until = 0.0;
    model::Kinematics bound;         // how far the true motion is away
    double rest = 0.0, scale = 0.0;  // the speed falls as (rest - t)/scale, 0: it does not
  };
  struct Flight {
    double t = 0.0;
    std::size_t regime = 0;
    Vector free;          // z without the steady response
    FlightErrors errors;  // of z, at t; with bounds
    std::optional<Event> ends{};
    bool is_precise = false;  // z was found in double-double, and rounded
  };
  struct Hit {
    double t = 0.0, time_error = 0.0, impulse = 0.0;
    int contact = 0;
    std::size_t flight = 0;  // the one that it ends
  };

  const ForcedModes& modes(const Flight& flight) const { return regimes_[flight.regime]; }
  Vector total(const Flight& flight, double t) const;
  model::Kinematics in_flight(const Flight& flight, double t) const;
  bool is_held(std::size_t flight, std::size_t contact) const;
  std::vector<std::size_t> held_in(std::size_t regime) const;
  /// Whether it ends at t give or take the error of that. At the instant of an impact itself the side decides.
  bool may_end(std::size_t flight, double t) const;
  FlightErrors errors_after(const Flight& flight, double s) const;
  /// What rounding in doubles does to z, s seconds into the flight.
  Vector local_errors(const Flight& flight, double s) const;

  std::string who_;
  model::ImpactProblem<> problem_;
  double end_ = 0.0;
  bool has_bounds_ = true;
  std::deque<ForcedModes> regimes_;  // the first has no closed spring and no held contact
  /// Of each regime, for each contact of the problem: its force, where it is held.
  std::deque<std::vector<std::optional<ForcedModes::Observable>>> forces_;
  std::vector<double> spring_contacts_;
  std::vector<Flight> flights_;
  std::vector<Hit> hits_;
  std::vector<Unresolved> unresolved_;
  std::vector<model::ClosedContact> closed_;
};

/// The problem that a linear penalty method solves: for each contact a spring of this stiffness > 0
/// [N/m] that acts in compression alone. Throws InputError (penalty-needs-elastic) for a
/// restitution other than 1.
model::ImpactProblem<> with_springs(model::ImpactProblem<> problem, double stiffness);

}  // namespace clackers::exact
