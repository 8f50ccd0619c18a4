#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/ball_flights.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/exact/certified/ball_matrix.hpp"

namespace clackers::certified {
namespace {

// The forces of `rate` become accelerations.
void accelerate(BallVector& rate, const BallVector& inverse_mass, std::size_t n) {
  std::ranges::copy(product(inverse_mass, velocities(rate, n)), rate.begin() + long(n));
}

}  // namespace

BallFlights::BallFlights(const model::ImpactProblem<>& problem,
                         const std::vector<std::size_t>& held)
    : problem_(problem),
      springs_(model::one_sided_springs(problem)),
      n_(std::size_t(problem.dof())) {
  if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>())
    forces_ = load->forces();
  size_ = 2 * n_ + 1 + 2 * forces_.size();
  for (std::size_t i = 0; springs_ != nullptr && i < springs_->contacts().size(); ++i)
    closed_.push_back(springs_->contacts()[i].gap_at(problem.start.u) < 0.0);
  hold({});
  inverse_mass_ = constrained_inverse_;

  t_ = problem.start.t;
  y_.resize(size_);
  for (std::size_t i = 0; i < n_; ++i) {
    y_[i] = problem.start.u[long(i)];
    y_[n_ + i] = Ball(problem.start.v[long(i)]) / unit_;
  }
  y_[2 * n_] = 1.0;
  for (std::size_t j = 0; j < forces_.size(); ++j) {
    const Ball phase = Ball(forces_[j].phase) + Ball(forces_[j].frequency) * t_;
    y_[2 * n_ + 1 + 2 * j] = cos(phase);
    y_[2 * n_ + 2 + 2 * j] = sin(phase);
  }
  if (!held.empty()) hold(held);
}

// In the rows of velocities forces, not accelerations: sums of doubles as they stand, so that
// forces in balance come out as 0.
void BallFlights::find_rate() {
  rate_.assign(size_ * size_, {});
  const auto& s = problem_.system;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) {
      entry(n_ + i, j) = -s.stiffness(long(i), long(j));
      entry(n_ + i, n_ + j) = -s.damping(long(i), long(j));
    }
  for (std::size_t k = 0; k < closed_.size(); ++k) {
    if (!closed_[k]) continue;
    const auto& spring = springs_->contacts()[k];
    for (std::size_t i = 0; i < n_; ++i) {
      const Ball force = Ball(spring.direction[long(i)]) * springs_->stiffnesses()[k];
      entry(n_ + i, 2 * n_) = entry(n_ + i, 2 * n_) + force * spring.gap;
      for (std::size_t j = 0; j < n_; ++j)
        entry(n_ + i, j) = entry(n_ + i, j) - force * spring.direction[long(j)];
    }
  }
  for (std::size_t j = 0; j < forces_.size(); ++j) {
    const auto& f = forces_[j];
    const auto cosine = 2 * n_ + 1 + 2 * j;
    auto& force = entry(n_ + std::size_t(f.dof), cosine);
    force = force + f.amplitude;
    entry(cosine, cosine + 1) = -f.frequency;
    entry(cosine + 1, cosine) = f.frequency;
  }
  BallVector absolute_inverse;
  for (const auto& m : constrained_inverse_) absolute_inverse.push_back(upper(m));
  // The largest rate of any entry for entries of `columns` that are at most 1.
  const auto norm = [&](std::size_t columns) {
    BallVector most(size_);
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j < columns; ++j) most[i] = most[i] + upper(entry(i, j));
    accelerate(most, absolute_inverse, n_);
    return largest(most);
  };
  // A power of 2, and the same for all regimes, so that a state may go on in another.
  if (const double square = norm(n_).middle(); y_.empty() && square > 0.0)
    unit_ = std::exp2(std::round(0.5 * std::log2(square)));
  for (std::size_t i = 0; i < n_; ++i) {
    entry(i, n_ + i) = unit_;
    for (std::size_t j = 0; j < size_; ++j)
      if (j < n_ || j >= 2 * n_) entry(n_ + i, j) = entry(n_ + i, j) / unit_;
  }
  norm_ = norm(size_);
}

BallVector BallFlights::rate(const BallVector& y) const {
  auto rate = product(rate_, y);
  accelerate(rate, constrained_inverse_, n_);
  return rate;
}

// In parts of |A| h <= 4, so that no term is much larger than the sum. What
// follows a term T of order k is at most |T| q/(1 - q), q = |A| h/(k + 1).
BallVector BallFlights::advanced(BallVector y, const Ball& s) const {
  const double whole = (norm_ * upper(s)).middle();
  const auto parts = std::max(1.0, std::ceil(0.25 * whole));
  const Ball h = s / parts, reach = upper(norm_ * upper(h));
  for (double part = 0.0; part < parts; ++part) {
    BallVector term = y;
    std::vector<bool> moves(size_, false);
    for (long k = 1;; ++k) {
      term = rate(term);
      for (std::size_t i = 0; i < size_; ++i) {
        term[i] = term[i] * h / double(k);
        moves[i] = moves[i] || !term[i].is_zero();
        y[i] = y[i] + term[i];
      }
      const Ball q = reach / double(k + 1), rest = upper(largest(term) * q * 2.0);
      // An entry without a term of the first orders has none.
      if (k < long(size_) || !(q < Ball(0.5))) continue;
      if (!(rest < scaled(largest(y), -WorkingBits::now())) && !rest.is_zero()) continue;
      for (std::size_t i = 0; i < size_; ++i)
        if (moves[i]) arb_add_error(y[i].get(), rest.get());
      break;
    }
  }
  return y;
}

// What s is known by grows for no longer than it lasts.
BallVector BallFlights::advanced(const Ball& s) const {
  const Ball to = middle(s);
  return advanced(advanced(y_, to), s - to);
}

KinematicBalls BallFlights::at(const Ball& t) const { return kinematics(advanced(t - t_)); }

KinematicBalls BallFlights::kinematics(const BallVector& y) const {
  const auto change = rate(y);
  KinematicBalls now;
  for (std::size_t i = 0; i < n_; ++i) {
    now.u.push_back(y[i]);
    now.v.push_back(y[n_ + i] * unit_);
    now.a.push_back(change[n_ + i] * unit_);
  }
  return now;
}

bool BallFlights::is_known(long bits) const {
  const Ball least = scaled(largest(y_), -bits);
  return std::ranges::all_of(
      y_, [&](const Ball& x) { return radius(x) < least || arb_is_exact(x.get()) != 0; });
}

}  // namespace clackers::certified

#endif
