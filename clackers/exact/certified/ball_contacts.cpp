// What happens at contacts: which are held, when a flight ends, impulses.
#ifdef CLACKERS_HAS_ARB

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/certified/ball_flights.hpp"
#include "clackers/exact/certified/ball_matrix.hpp"

namespace clackers::certified {

const model::Contact<>& BallFlights::contact(std::size_t i) const {
  const auto count = problem_.contacts.size();
  return i < count ? problem_.contacts[i] : springs_->contacts()[i - count];
}

bool BallFlights::is_held(std::size_t i) const { return std::ranges::count(held_, i) > 0; }

// Displacements and velocities of the pivots are what the others make them.
void BallFlights::hold(const std::vector<std::size_t>& contacts) {
  held_ = contacts;
  std::vector<model::Contact<>> closed;
  for (const auto i : held_) closed.push_back(contact(i));
  const auto& c =
      constraint_.emplace(closed, n_, [](const Ball& x) { return std::abs(x.middle()); });
  constrained_inverse_ = constrained_inverse_mass();
  for (std::size_t k = 0; k < held_.size(); ++k) {
    Ball u = c.gaps[k], v;
    for (std::size_t i = 0; i < n_; ++i) {
      if (c.is_pivot[i]) continue;
      u = u - c.shares[k][i] * y_[i];
      v = v - c.shares[k][i] * y_[n_ + i];
    }
    y_[c.pivots[k]] = u;
    y_[n_ + c.pivots[k]] = v;
  }
  find_rate();
}

// S (S' M S)^-1 S', where the columns of S are the motions with held contacts.
BallVector BallFlights::constrained_inverse_mass() const {
  const auto free = n_ - held_.size();
  BallVector basis(free * n_), mass, reduced, inverse(n_ * n_);
  for (std::size_t i = 0, row = 0; i < n_; ++i) {
    if (constraint_->is_pivot[i]) continue;
    basis[row * n_ + i] = 1.0;
    for (std::size_t k = 0; k < held_.size(); ++k)
      basis[row * n_ + constraint_->pivots[k]] = -constraint_->shares[k][i];
    ++row;
  }
  if (free == 0) return inverse;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) mass.emplace_back(problem_.system.mass(long(i), long(j)));
  for (std::size_t c = 0; c < free; ++c) {
    const auto column = basis.begin() + long(c * n_);
    for (const auto& entry : product(basis, product(mass, {column, column + long(n_)})))
      reduced.push_back(entry);
  }
  const auto responses = solved(reduced, basis);
  for (std::size_t c = 0; c < free; ++c)
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        inverse[i * n_ + j] = inverse[i * n_ + j] + basis[c * n_ + i] * responses[c * n_ + j];
  return inverse;
}

// M^-1 times a force.
BallVector BallFlights::responses(const Eigen::VectorXd& force) const {
  return product(inverse_mass_, {force.begin(), force.end()});
}

// With `first` = 0; with n its rate over unit_.
Ball BallFlights::gap(std::size_t i, const BallVector& y, std::size_t first) const {
  const auto& c = contact(i);
  Ball sum = first == 0 ? -Ball(c.gap) : Ball();
  for (std::size_t j = 0; j < n_; ++j)
    if (const double b = c.direction[long(j)]; b != 0.0) sum = sum + y[first + j] * b;
  return sum;
}

// What holds the contact closed, over unit_: of B' p = M a - f the rows of the pivots.
Ball BallFlights::force(std::size_t held, const BallVector& y) const {
  const auto forces = velocities(product(rate_, y), n_), a = product(constrained_inverse_, forces);
  const auto j = std::size_t(std::ranges::find(held_, held) - held_.begin());
  Ball sum;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto pivot = constraint_->pivots[k];
    Ball lacking = -forces[pivot];
    for (std::size_t i = 0; i < n_; ++i)
      lacking = lacking + a[i] * problem_.system.mass(long(pivot), long(i));
    sum = sum + constraint_->inverse[k][j] * lacking;
  }
  return sum;
}

// Newton's method of intervals.
bool BallFlights::end(const exact::PiecewiseMotion::Event& event) {
  const auto first = event.contacts.front();
  Ball s = Ball(event.when.lo) - t_;
  const Ball last = Ball(event.when.hi) - t_;
  arb_union(s.get(), s.get(), last.get(), WorkingBits::now());
  for (bool is_narrower = true; is_narrower;) {
    const Ball to = middle(s);
    const auto there = advanced(y_, to), near = advanced(there, s - to);
    const Ball value = is_held(first) ? force(first, there) : gap(first, there, 0);
    const Ball slope = is_held(first) ? force(first, rate(near)) : gap(first, near, n_) * unit_;
    if (slope.holds_zero()) return false;
    const Ball next = to - value / slope;
    Ball both;
    if (arb_intersection(both.get(), s.get(), next.get(), WorkingBits::now()) == 0) return false;
    is_narrower = radius(scaled(both, 1)) < radius(s);
    s = both;
  }
  y_ = advanced(s);
  t_ = t_ + s;
  // A single mass is at the contact exactly.
  for (const auto i : event.contacts)
    if (const auto mass = single_mass(i))
      y_[*mass] = Ball(contact(i).gap) / contact(i).direction[long(*mass)];
  return true;
}

// Of a contact that no other mass moves.
std::optional<std::size_t> BallFlights::single_mass(std::size_t i) const {
  const auto& b = contact(i).direction;
  if ((b.array() != 0.0).count() != 1) return std::nullopt;
  long mass = 0;
  b.cwiseAbs().maxCoeff(&mass);
  return std::size_t(mass);
}

std::vector<Ball> BallFlights::collide(const std::vector<std::size_t>& contacts,
                                       const std::vector<std::size_t>& held) {
  BallVector delassus, speeds;
  std::vector<BallVector> of_unit;
  for (const auto i : contacts) of_unit.push_back(responses(contact(i).direction));
  const auto along = [&](const BallVector& response, std::size_t i) {
    Ball sum;
    for (std::size_t k = 0; k < n_; ++k)
      if (const double b = contact(i).direction[long(k)]; b != 0.0) sum = sum + response[k] * b;
    return sum;
  };
  for (const auto i : contacts) {
    for (const auto& response : of_unit) delassus.push_back(along(response, i));
    speeds.push_back(-(gap(i, y_, n_) * unit_ * (Ball(1.0) + contact(i).restitution)));
  }
  const auto impulses = solved(delassus, speeds);
  for (const auto i : held)
    if (is_held(i) && std::ranges::count(contacts, i) == 0)
      for (const auto& response : of_unit)
        if (!along(response, i).is_zero())
          throw InputError(
              "digits: an impact that may open a held contact; allowed: "
              "motions in which it acts on it or does not.",
              "no-enclosure");
  const auto before = y_;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (std::size_t k = 0; k < n_; ++k)
      y_[n_ + k] = y_[n_ + k] + impulses[c] * of_unit[c][k] / unit_;
  // And a single mass exactly as fast as the law says.
  for (const auto i : contacts)
    if (const auto mass = single_mass(i))
      y_[n_ + *mass] = -(before[n_ + *mass] * contact(i).restitution);
  return impulses;
}

std::vector<Ball> BallFlights::pass(const exact::PiecewiseMotion::Event& event,
                                    const std::vector<std::size_t>& held) {
  const auto first = event.contacts.front();
  std::vector<Ball> impulses;
  if (const auto count = problem_.contacts.size(); first >= count) {
    closed_[first - count].flip();
    find_rate();
  } else if (!is_held(first)) {
    impulses = collide(event.contacts, held);
  }
  if (held != held_) hold(held);
  return impulses;
}

}  // namespace clackers::certified

#endif
