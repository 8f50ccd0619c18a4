#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/ball_flights.hpp"

#include <arb_mat.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::certified {
namespace {

using Vector = std::vector<Ball>;

// X with A X = B; both row by row.
Vector solved(const Vector& a, const Vector& b) {
  const auto n = long(std::llround(std::sqrt(double(a.size())))), m = long(b.size()) / n;
  arb_mat_t left, right;
  arb_mat_init(left, n, n);
  arb_mat_init(right, n, m);
  for (long i = 0; i < n; ++i) {
    for (long j = 0; j < n; ++j)
      arb_set(arb_mat_entry(left, i, j), a[std::size_t(i * n + j)].get());
    for (long j = 0; j < m; ++j)
      arb_set(arb_mat_entry(right, i, j), b[std::size_t(i * m + j)].get());
  }
  const bool is_found = arb_mat_solve(right, left, right, WorkingBits::now()) != 0;
  Vector x(b.size());
  for (long i = 0; i < n; ++i)
    for (long j = 0; j < m; ++j)
      arb_swap(x[std::size_t(i * m + j)].get(), arb_mat_entry(right, i, j));
  arb_mat_clear(left);
  arb_mat_clear(right);
  if (!is_found)
    throw InputError(
        "digits: a mass matrix or contacts that are nearly "
        "singular; allowed: others.",
        "no-enclosure");
  return x;
}

// Of a matrix, row by row.
Vector product(const Vector& a, const Vector& x) {
  Vector y(a.size() / x.size());
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j)
      if (const Ball& entry = a[i * x.size() + j]; !entry.is_zero() && !x[j].is_zero())
        arb_addmul(y[i].get(), entry.get(), x[j].get(), WorkingBits::now());
  return y;
}

Ball largest(const Vector& x) {
  Ball most;
  for (const auto& value : x)
    if (const Ball now = upper(value); most < now) most = now;
  return most;
}

// The forces of `rate` become accelerations.
void accelerate(Vector& rate, const Vector& inverse_mass, std::size_t n) {
  const auto forces = rate.begin() + long(n);
  std::ranges::copy(product(inverse_mass, {forces, forces + long(n)}), forces);
}

}  // namespace

BallFlights::BallFlights(const model::ImpactProblem<>& problem)
    : problem_(problem),
      springs_(model::one_sided_springs(problem)),
      n_(std::size_t(problem.dof())) {
  if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>())
    forces_ = load->forces();
  size_ = 2 * n_ + 1 + 2 * forces_.size();
  const auto& s = problem.system;
  Vector mass, identity(n_ * n_);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j < n_; ++j) mass.emplace_back(s.mass(long(i), long(j)));
    identity[i * n_ + i] = 1.0;
  }
  inverse_mass_ = solved(mass, identity);
  for (std::size_t i = 0; springs_ != nullptr && i < springs_->contacts().size(); ++i)
    closed_.push_back(springs_->contacts()[i].gap_at(problem.start.u) < 0.0);
  find_rate();

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
}

const model::Contact<>& BallFlights::contact(std::size_t i) const {
  const auto count = problem_.contacts.size();
  return i < count ? problem_.contacts[i] : springs_->contacts()[i - count];
}

// M^-1 times a force.
Vector BallFlights::responses(const Eigen::VectorXd& force) const {
  return product(inverse_mass_, {force.begin(), force.end()});
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
  Vector absolute_inverse;
  for (const auto& m : inverse_mass_) absolute_inverse.push_back(upper(m));
  // The largest rate of any entry for entries of `columns` that are at most 1.
  const auto norm = [&](std::size_t columns) {
    Vector most(size_);
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

Vector BallFlights::rate(const Vector& y) const {
  auto rate = product(rate_, y);
  accelerate(rate, inverse_mass_, n_);
  return rate;
}

// In parts of |A| h <= 4, so that no term is much larger than the sum. What
// follows a term T of order k is at most |T| q/(1 - q), q = |A| h/(k + 1).
Vector BallFlights::advanced(Vector y, const Ball& s) const {
  const double whole = (norm_ * upper(s)).middle();
  const auto parts = std::max(1.0, std::ceil(0.25 * whole));
  const Ball h = s / parts, reach = upper(norm_ * upper(h));
  for (double part = 0.0; part < parts; ++part) {
    Vector term = y;
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
Vector BallFlights::advanced(const Ball& s) const {
  const Ball to = middle(s);
  return advanced(advanced(y_, to), s - to);
}

KinematicBalls BallFlights::at(const Ball& t) const { return kinematics(advanced(t - t_)); }

KinematicBalls BallFlights::kinematics(const Vector& y) const {
  const auto change = rate(y);
  KinematicBalls now;
  for (std::size_t i = 0; i < n_; ++i) {
    now.u.push_back(y[i]);
    now.v.push_back(y[n_ + i] * unit_);
    now.a.push_back(change[n_ + i] * unit_);
  }
  return now;
}

// With `first` = 0; with n its rate over unit_.
Ball BallFlights::gap(std::size_t i, const Vector& y, std::size_t first) const {
  const auto& c = contact(i);
  Ball sum = first == 0 ? -Ball(c.gap) : Ball();
  for (std::size_t j = 0; j < n_; ++j)
    if (const double b = c.direction[long(j)]; b != 0.0) sum = sum + y[first + j] * b;
  return sum;
}

// Newton's method of intervals.
bool BallFlights::end(const std::vector<std::size_t>& contacts, double lo, double hi) {
  const auto first = contacts.front();
  Ball s = Ball(lo) - t_;
  const Ball last = Ball(hi) - t_;
  arb_union(s.get(), s.get(), last.get(), WorkingBits::now());
  for (bool is_narrower = true; is_narrower;) {
    const Ball to = middle(s);
    const auto there = advanced(y_, to);
    const Ball slope = gap(first, advanced(there, s - to), n_) * unit_;
    if (slope.holds_zero()) return false;
    const Ball next = to - gap(first, there, 0) / slope;
    Ball both;
    if (arb_intersection(both.get(), s.get(), next.get(), WorkingBits::now()) == 0) return false;
    is_narrower = radius(scaled(both, 1)) < radius(s);
    s = both;
  }
  y_ = advanced(s);
  t_ = t_ + s;
  // A single mass is at the contact exactly.
  for (const auto i : contacts)
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

std::vector<Ball> BallFlights::collide(const std::vector<std::size_t>& contacts) {
  Vector delassus, speeds;
  std::vector<Vector> of_unit;
  for (const auto i : contacts) of_unit.push_back(responses(contact(i).direction));
  for (const auto i : contacts) {
    const auto& b = contact(i).direction;
    for (const auto& response : of_unit) {
      Ball sum;
      for (std::size_t k = 0; k < n_; ++k)
        if (b[long(k)] != 0.0) sum = sum + response[k] * b[long(k)];
      delassus.push_back(sum);
    }
    speeds.push_back(-(gap(i, y_, n_) * unit_ * (Ball(1.0) + contact(i).restitution)));
  }
  const auto impulses = solved(delassus, speeds);
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

bool BallFlights::pass(const exact::PiecewiseMotion::Event& event) {
  if (!end(event.contacts, event.when.lo, event.when.hi)) return false;
  if (const auto count = problem_.contacts.size(); event.contacts.front() >= count) {
    closed_[event.contacts.front() - count].flip();
    find_rate();
  } else {
    collide(event.contacts);
  }
  return true;
}

bool BallFlights::is_known(long bits) const {
  const Ball least = scaled(largest(y_), -bits);
  return std::ranges::all_of(
      y_, [&](const Ball& x) { return radius(x) < least || arb_is_exact(x.get()) != 0; });
}

}  // namespace clackers::certified

#endif
