#pragma once

#include <optional>
#include <vector>

#include "clackers/exact/certified/ball_matrix.hpp"
#include "clackers/exact/flights/held_contacts.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::certified {

/// Displacement [m], velocity [m/s] and acceleration [m/s^2] of each mass.
struct KinematicBalls {
  std::vector<Ball> u, v, a;
};

/// The flights of a linear structure with harmonic loads, contacts and
/// one-sided springs, whose impacts and releases are known but for their digits: y' = A y of
/// displacements, velocities, the loads' phases and 1, by Taylor series of
/// balls with a bound on what is left out. Knows no modes. All with the working
/// bits that it was made with, and of the doubles of the problem as they stand.
class BallFlights {
 public:
  /// `problem` outlives it. Contacts that are springs have the numbers after
  /// the others; `held` are closed from the start on.
  BallFlights(const model::ImpactProblem<>& problem, const std::vector<std::size_t>& held);

  /// In this flight, at any t.
  KinematicBalls at(const Ball& t) const;
  /// Where it began.
  KinematicBalls at_begin() const { return kinematics(y_); }
  /// Where this flight began [s].
  const Ball& begin() const { return t_; }
  /// Ends the flight at the only such instant within event.when. False where the balls are too wide
  /// to show that the gap, or the force of a held contact, moves all the time.
  bool end(const exact::PiecewiseMotion::Event& event);
  /// What happens there; from then on these contacts are held. Returns the impulses by Newton's law, of impacts
  /// only. Throws InputError (no-enclosure) where it might open a held contact that has no impulse.
  std::vector<Ball> pass(const exact::PiecewiseMotion::Event& event,
                         const std::vector<std::size_t>& held);

  /// Whether every displacement and velocity is known to this many bits of the
  /// largest.
  bool is_known(long bits) const;

 private:
  const model::Contact<>& contact(std::size_t i) const;
  bool is_held(std::size_t contact) const;
  std::optional<std::size_t> single_mass(std::size_t contact) const;
  Ball& entry(std::size_t row, std::size_t column) { return rate_[row * size_ + column]; }
  BallVector responses(const Eigen::VectorXd& force) const;
  void find_rate();
  void hold(const std::vector<std::size_t>& contacts);
  BallVector constrained_inverse_mass() const;
  std::vector<Ball> collide(const std::vector<std::size_t>& contacts,
                            const std::vector<std::size_t>& held);
  BallVector rate(const BallVector& y) const;
  KinematicBalls kinematics(const BallVector& y) const;
  BallVector advanced(const Ball& s) const;
  BallVector advanced(BallVector y, const Ball& s) const;
  Ball gap(std::size_t i, const BallVector& y, std::size_t first) const;
  Ball force(std::size_t held, const BallVector& y) const;

  const model::ImpactProblem<>& problem_;
  const model::OneSidedSprings* springs_;
  std::vector<model::HarmonicForce> forces_;
  std::vector<bool> closed_;  // of the springs
  std::size_t n_, size_;
  double unit_ = 1.0;               // of rates [1/s]: y has v over it
  BallVector inverse_mass_;         // row by row
  BallVector constrained_inverse_;  // the same with held contacts, which it does not accelerate
  std::vector<std::size_t> held_;
  std::optional<exact::HeldContacts<Ball>> constraint_;
  BallVector rate_;  // A, row by row; M times it in rows of velocities
  Ball norm_;        // a bound on that of A
  Ball t_;
  BallVector y_;
};

}  // namespace clackers::certified
