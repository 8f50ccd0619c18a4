#pragma once

#include <Eigen/Core>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clackers/exact/flights/first_crossing.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/lcp.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::certified {
class FlightsEnclosure;
}

namespace clackers::exact {

/// Goes from impact to impact: regimes.cpp has the modal systems, impact_search.cpp what closes next,
/// impacts.cpp the impacts, resting_contacts.cpp what stays closed, flight_states.cpp the states between flights.
class PiecewiseMotion::Builder {
  using Index = Eigen::Index;
  using MatrixXd = Eigen::MatrixXd;
  using VectorXd = Eigen::VectorXd;

 public:
  /// All outlive it.
  Builder(const model::ImpactProblem<>& problem, const ImpactLaw& law, std::size_t most_flights,
          PiecewiseMotion& motion);

  void build();

 private:
  /// Flights of so many masses are made precise by balls, those of more are in double-double where their modes are.
  static constexpr int most_masses_of_balls = 8;
  /// Speeds below this share of their sizes are those of masses that stay together.
  static constexpr double touching_share = 1e-12;

  /// Of a contact: its gap, and the change of z by a unit impulse.
  struct Row {
    ForcedModes::Observable seen;
    VectorXd impulse;
    auto gap() const { return seen.by_state.col(0); }
    auto rate() const { return seen.by_state.col(1); }
  };
  /// A contact that closes s seconds into the flight, or a held one whose force ends there.
  struct Closing {
    std::size_t contact = 0;
    double s = 0.0, gap_error = 0.0, time_error = 0.0;
    bool is_soft = false;  // lands without a speed that the error lets be seen
    double first() const { return s - time_error; }
    double last() const { return s + time_error; }
  };
  /// How the gap of a contact begins in a flight: the derivatives below this order are 0. An idle one is held, and its
  /// force is 0 up to the end of the flight.
  enum class Begin { open, by_speed, by_acceleration, by_jerk, idle };
  /// z in a regime, the error of it, and that of the instant where an impact sets it.
  struct State {
    std::size_t regime = 0;
    double t = 0.0;
    VectorXd z;
    FlightErrors errors;
    double time_error = 0.0;
    ForcedModes::Numbers precise{};  // z in double-double, or empty
    double late = 0.0;               // of the instant of `precise` after t
  };

  const Flight& flight() const { return m_.flights_.back(); }
  const ForcedModes& modes() const { return m_.modes(flight()); }
  const Row& row(std::size_t i) const { return rows_[flight().regime][i]; }
  bool is_spring(std::size_t i) const { return i >= springs(); }
  bool is_held(std::size_t i) const { return !is_spring(i) && closed_[flight().regime][i]; }
  /// What must not become negative: the gap of an open contact, the force of a held one.
  const ForcedModes::Observable& watched(std::size_t i) const {
    return is_held(i) ? *m_.forces_[flight().regime][i] : row(i).seen;
  }
  /// Contacts from here on are springs.
  std::size_t springs() const { return problem_.contacts.size(); }
  double delassus(std::size_t regime, std::size_t i, std::size_t j) const {
    return rows_[regime][i].rate().dot(rows_[regime][j].impulse);
  }

  /// The structure with these contacts held and these springs closed; the last entry is for what an
  /// ImpactLaw changes after the first impact.
  std::size_t regime(const std::vector<bool>& closed);
  std::size_t after_impact(std::size_t regime);
  std::size_t with_held(std::size_t regime, const std::vector<std::size_t>& contacts, bool held);
  std::vector<std::size_t> held(std::size_t regime) const { return m_.held_in(regime); }
  /// Of held contacts the last are the coordinates u = offset + basis q, and the forces that the
  /// contacts need for given forces on the masses.
  struct Constraint {
    MatrixXd basis, forces;
    VectorXd offset;
  };
  Constraint constraint(const std::vector<std::size_t>& contacts) const;
  /// A spring closes or opens. Displacements, velocities and forces are continuous.
  void change_regime();
  void start();
  void begin(State state);

  // flight_states.cpp

  /// The state where the flight begins.
  State here() const;
  State arrived(double s) const;
  /// The state in which these end the flight; with double-double their instant and its errors as well.
  State arrived(std::vector<Closing>& closings) const;
  /// The same instant in another regime.
  State seen_in(std::size_t regime, const State& state) const;
  /// Adds these impulses, in double-double after correcting them; `rates` are what closing contacts have to gain. Returns
  /// what the rates of z are wrong by.
  VectorXd strike(State& state, const VectorXd& rates, VectorXd& impulses) const;
  /// Begins the flight again from its state by balls, whose error is that of rounding it. False where
  /// this was done, or is not possible.
  bool sharpen();
  /// What closes first, with a sharper state where the error does not show it.
  std::vector<Closing> sharp_closings();

  /// What is watched, of springs and of contacts that were passed the distance from coming back.
  numerics::LocalBound watch(std::size_t i, double s) const { return ahead_[i].whole(s); }
  /// A bound on the error of what is watched of contact i, s seconds into the flight.
  double error_of(std::size_t i, double s) const;
  /// The flight is searched in windows, each twice as long as the one before, so that the error of
  /// gaps is bounded by about what it is.
  std::vector<Closing> next_contacts();
  /// The spring that closes or opens first, and when.
  std::optional<std::pair<std::size_t, double>> next_switching(double from, double until,
                                                               double fastest) const;
  /// Seconds into the flight in which contact i may close and open without being followed.
  double unresolved(std::size_t i) const;
  [[noreturn]] void refuse_length() const;
  /// certain_gap times a bound on the error of each gap up to s seconds into the flight.
  std::vector<double> levels(double s) const;
  /// From where on contact i is open, or pressed, for certain; nothing where its rebound is lower
  /// than its error.
  std::optional<double> opening(std::size_t i, double level) const;
  /// The same of one that begins by its derivative of order 2 or 3 and is open up to `first` for certain, in
  /// steps: bounds on the next derivative of all modes are too large for one step where a mesh has many.
  std::optional<double> climb(std::size_t i, int order, double first, double level) const;
  std::vector<Closing> search(const std::vector<double>& level, const std::vector<double>& from,
                              double to) const;
  Closing soft_landing(std::size_t i, const Crossing& found) const;
  double highest_force() const;
  [[noreturn]] void refuse_graze(std::size_t i, double t, double gap, double error) const;
  /// A closed contact that does not open, or by less than the error.
  [[noreturn]] void refuse_closed(std::size_t i, const numerics::LocalBound& gap,
                                  double level) const;

  /// The contacts that close first. Those that act on each other and whose order the errors do not
  /// show belong to them only if they close together for certain; the others come in flights of
  /// their own.
  std::vector<Closing> closing_first(const std::vector<Closing>& closings) const;
  /// Whether an impulse of one changes the gap rate of the other.
  bool act_on_each_other(std::size_t a, std::size_t b) const;
  void happen(const std::vector<Closing>& closings);
  /// Newton's law for contacts that close together, held ones among them.
  void collide(std::vector<Closing> closings);
  /// Of contacts that are closed at an impact those that are so after it; the others open.
  std::vector<std::size_t> staying(const std::vector<std::size_t>& closed, const VectorXd& impulses,
                                   const State& after);
  /// Nothing but rounding of the speed before the impact is left: a plastic impact at equilibrium.
  bool at_rest(const VectorXd& u, const VectorXd& after, const VectorXd& before) const;
  /// p >= 0 with w = q + W p >= 0, one of each pair 0, of these contacts.
  VectorXd solve(std::size_t regime, const VectorXd& q, const std::vector<std::size_t>& contacts,
                 double t);
  /// An impact that departs from Newton's law.
  void depart(const Closing& closing);
  bool departs() const {
    return law_.missed > 0 || law_.doubled > 0 || law_.grid > 0.0 || !law_.impulse_factor.empty();
  }
  /// What an impact does to errors: R + sum over contacts of g_c n_c'/(n_c . f-): contact c, whose gap a perturbation changes
  /// by n_c . dx, comes that over its gap rate earlier, and g_c is its part of f+ - R f-. Of
  /// contacts that close together this holds while they stay together, or do not act on each other.
  /// `shared` is what contacts that were closed before, or are after, add to the parts.
  FlightErrors::Impact saltation(std::size_t regime, const std::vector<Closing>& closings,
                                 const VectorXd& impulses, const VectorXd& z,
                                 const VectorXd& a_before, VectorXd shared) const;

  /// A bound on the error of row . z, for a state as `state`.
  double deviation(const State& state, const VectorXd& row) const;

  // resting_contacts.cpp

  /// The regime in which contacts that are closed without a gap rate go on: those whose force would be
  /// negative open. By accelerations, and where those leave it undecided, by their rates.
  std::size_t resting(const State& state, const std::vector<std::size_t>& contacts);
  std::size_t resting_by_jerk(const State& state, const std::vector<std::size_t>& contacts);
  /// The regime in which these contacts, of which no derivative is certain, are held without a force; refused where
  /// that is not proven.
  std::size_t resting_idle(const State& state, const std::vector<std::size_t>& contacts);
  /// Held contacts whose force ends.
  void release(std::vector<Closing> closings);
  /// Contact i rebounds with impacts that accumulate: rest follows where that is certain. Throws InputError
  /// where the impacts that are left out are not small.
  bool come_to_rest(std::size_t i, double level, bool is_resolved);
  /// Contact i lands without a speed that can be seen.
  void land(const Closing& closing);
  /// For some seconds the gap of contact i is below `gap`, and its rate and acceleration are bounded,
  /// while the flight to begin holds it already.
  struct Bounce {
    std::size_t contact = 0;
    double seconds = 0.0, gap = 0.0, rate = 0.0, acceleration = 0.0;
    double drift = 0.0;  // of the gap from the first instant to the last
  };
  /// Nothing where another contact of the same part may close or open then.
  std::optional<Unresolved> left_out(const Bounce& bounce, const State& free, State& held) const;

  const model::ImpactProblem<>& problem_;
  const ImpactLaw& law_;
  const std::size_t most_flights_;
  PiecewiseMotion& m_;
  numerics::LcpSolver lcp_;
  std::vector<model::Contact<>> contacts_;  // those of the problem, then springs
  std::vector<double> stiffnesses_;         // of the springs
  std::vector<std::vector<bool>> closed_;   // of each regime
  std::vector<std::size_t> part_;           // of each contact; no force or impact joins two parts
  std::vector<bool> passed_;                // contacts that an impact left without effect
  std::vector<numerics::FormAhead> ahead_;  // of each contact in this flight
  std::deque<std::vector<Row>> rows_;       // of each regime
  std::optional<std::pair<std::size_t, double>> switching_;
  double stiffest_ = 0.0;              // frequency of a spring and the masses that it joins
  std::vector<Begin> begins_, opens_;  // of this flight, of the next
  ForcedModes::Numbers precise_;       // z where this flight begins, in double-double, or empty
  std::optional<std::size_t> sharp_;   // the last flight that was begun again
  std::shared_ptr<certified::FlightsEnclosure> balls_;
  double bytes_ = 0.0;    // of the errors of all flights
  bool is_over_ = false;  // nothing collides any more
  double fastest_ = 0.0;  // speed of a mass so far, at the start and before impacts
  std::string no_rest_;   // why impacts that accumulate were not seen to end in rest
};

}  // namespace clackers::exact
