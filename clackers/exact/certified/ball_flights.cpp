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

// The entries of n velocities.
Vector velocities(const Vector& y, std::size_t n) {
  return {y.begin() + long(n), y.begin() + long(2 * n)};
}

// The forces of `rate` become accelerations.
void accelerate(Vector& rate, const Vector& mobility, std::size_t n) {
  std::ranges::copy(product(mobility, velocities(rate, n)), rate.begin() + long(n));
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
  const auto& s = problem.system;
  Vector mass, identity(n_ * n_);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t j = 0; j < n_; ++j) mass.emplace_back(s.mass(long(i), long(j)));
    identity[i * n_ + i] = 1.0;
  }
  inverse_mass_ = mobility_ = solved(mass, identity);
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
  if (!held.empty()) hold(held);
}

bool BallFlights::is_held(std::size_t i) const { return std::ranges::count(held_, i) > 0; }

// Displacements and velocities of the pivots are what the others make them.
void BallFlights::hold(const std::vector<std::size_t>& contacts) {
  held_ = contacts;
  constraint_.reset();
  mobility_ = inverse_mass_;
  if (!held_.empty()) {
    std::vector<model::Contact<>> closed;
    for (const auto i : held_) closed.push_back(contact(i));
    const auto& c =
        constraint_.emplace(closed, n_, [](const Ball& x) { return std::abs(x.middle()); });
    mobility_ = constrained_mobility();
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
  }
  find_rate();
}

// S (S' M S)^-1 S', where the columns of S are the motions with held contacts.
Vector BallFlights::constrained_mobility() const {
  const auto free = n_ - held_.size();
  Vector basis(free * n_), reduced, mobility(n_ * n_);
  for (std::size_t i = 0, row = 0; i < n_; ++i) {
    if (constraint_->is_pivot[i]) continue;
    basis[row * n_ + i] = 1.0;
    for (std::size_t k = 0; k < held_.size(); ++k)
      basis[row * n_ + constraint_->pivots[k]] = -constraint_->shares[k][i];
    ++row;
  }
  if (free == 0) return mobility;
  const auto column = [&](std::size_t c) {
    return Vector(basis.begin() + long(c * n_), basis.begin() + long((c + 1) * n_));
  };
  Vector mass;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) mass.emplace_back(problem_.system.mass(long(i), long(j)));
  for (std::size_t c = 0; c < free; ++c)
    for (const auto& entry : product(basis, product(mass, column(c)))) reduced.push_back(entry);
  const auto responses = solved(reduced, basis);
  for (std::size_t c = 0; c < free; ++c)
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        mobility[i * n_ + j] = mobility[i * n_ + j] + basis[c * n_ + i] * responses[c * n_ + j];
  return mobility;
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
  Vector absolute_mobility;
  for (const auto& m : mobility_) absolute_mobility.push_back(upper(m));
  // The largest rate of any entry for entries of `columns` that are at most 1.
  const auto norm = [&](std::size_t columns) {
    Vector most(size_);
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j < columns; ++j) most[i] = most[i] + upper(entry(i, j));
    accelerate(most, absolute_mobility, n_);
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
  accelerate(rate, mobility_, n_);
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

// What holds the contact closed, over unit_: of B' p = M a - f the rows of the pivots.
Ball BallFlights::force(std::size_t held, const Vector& y) const {
  const auto forces = velocities(product(rate_, y), n_), a = product(mobility_, forces);
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
  Vector delassus, speeds;
  std::vector<Vector> of_unit;
  for (const auto i : contacts) of_unit.push_back(responses(contact(i).direction));
  const auto along = [&](const Vector& response, std::size_t i) {
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

bool BallFlights::is_known(long bits) const {
  const Ball least = scaled(largest(y_), -bits);
  return std::ranges::all_of(
      y_, [&](const Ball& x) { return radius(x) < least || arb_is_exact(x.get()) != 0; });
}

}  // namespace clackers::certified

#endif
