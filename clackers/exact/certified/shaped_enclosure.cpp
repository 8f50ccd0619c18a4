#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/shaped_enclosure.hpp"

#include <cmath>
#include <variant>

#include "clackers/exact/assembly/assemblies.hpp"
#include "clackers/exact/assembly/assembly.hpp"

namespace clackers::certified {

using exact::AlternatingParameters;
using exact::AssemblyParameters;
using exact::BuildingsParameters;
using exact::RowParameters;

namespace {

// sin(odd pi / 2)
// first, first f(1), first f(1) f(2), ... of the ratios f of numerator and denominator.
template <class Numerator, class Denominator>
std::vector<Ball> products(const Ball& first, int count, Numerator numerator,
                           Denominator denominator) {
  std::vector<Ball> all{first};
  for (int i = 1; i < count; ++i) all.push_back(all.back() * numerator(i) / denominator(i));
  return all;
}

Ball half(const Ball& x) { return scaled(x, -1); }

void add_oscillation(KinematicBalls& to, std::size_t i, const Ball& amplitude, const Ball& w,
                     const Ball& cosine, const Ball& sine) {
  to.u[i] = to.u[i] + amplitude * cosine;
  to.v[i] = to.v[i] - amplitude * w * sine;
  to.a[i] = to.a[i] - amplitude * w * w * cosine;
}

KinematicBalls at_rest(std::size_t dof) {
  return {std::vector<Ball>(dof), std::vector<Ball>(dof), std::vector<Ball>(dof)};
}

}  // namespace

ShapedEnclosure::ShapedEnclosure(const exact::ShapedMotion& motion)
    : Enclosure({.collides = true,
                 .eta = motion.flight().eta,
                 .first_impact = motion.flight().first_impact,
                 .at_once = std::ssize(motion.pattern().contacts.front())}),
      parameters_(motion.parameters()),
      dof_(motion.dof()) {}

// Products of up to 999 odd numbers and powers of the binary fractions of a matrix, squared, beside
// what the parameters bring.
double ShapedEnclosure::fraction_bits(long long flights) const {
  return 65536.0 + 64.0 * double(dof_) + 4400.0 * double(flights);
}

bool ShapedEnclosure::is_undamped() const {
  const auto decay = [](const auto& p) {
    if constexpr (requires { p.sigma; })
      return p.sigma;
    else
      return p.xi1;
  };
  return std::visit(decay, parameters_) == 0.0;
}

const ShapedEnclosure::Constants& ShapedEnclosure::constants() {
  if (c_.bits == WorkingBits::now()) return c_;
  c_ = {};
  c_.bits = WorkingBits::now();
  std::visit([&](const auto& p) { fill(p); }, parameters_);
  return c_;
}

// Of each building W and D (exact/assembly/building_shape.hpp).
void ShapedEnclosure::fill(const BuildingsParameters& p) {
  c_.omega = p.Omega;
  c_.sigma = p.sigma;
  const Ball V = p.V, momentum = Ball(p.m1) * V;
  c_.impulses_by_turn = {{(Ball(1.0) + p.eta) * momentum}};
  c_.energy = half(momentum * V * (Ball(1.0) + p.r));
  const auto add = [&](double storeys, double multiple, const Ball& velocity) {
    const int n = int(storeys);
    const auto numerator = [n](int i) { return double(2 * (n - i)); };
    c_.coefficients.push_back(
        products(velocity, n, numerator, [](int i) { return double(2 * i - 1); }));
    c_.coefficients.push_back(products(velocity / (c_.omega * multiple), n, numerator,
                                       [](int i) { return double(2 * i + 1); }));
  };
  add(p.left, 1.0, V);
  add(p.right, p.X, -(Ball(p.r) * V));
}

KinematicBalls ShapedEnclosure::shape(const BuildingsParameters& p, const Phase& phase) {
  auto now = at_rest(std::size_t(dof_));
  const auto& c = constants();
  std::size_t first = 0;
  for (const bool is_right : {false, true}) {
    const auto n = std::size_t(is_right ? p.right : p.left);
    const double multiple = is_right ? p.X : 1.0;
    const auto& W = c.coefficients[is_right ? 2 : 0];
    const auto& D = c.coefficients[is_right ? 3 : 1];
    const auto [sine, cosine] = turned(phase, multiple, 2.0 * multiple);
    Ball drifts;
    for (std::size_t i = n; i-- > 0;) {  // storey i + 1
      const std::size_t p_cos = 2 * (n - i) - 1, p_sin = 2 * i;
      const Ball common = power(cosine, p_cos - 1) * power(sine, p_sin);
      drifts = drifts + D[i] * common * sine;
      Ball change = -(Ball(double(p_cos)) * common * sine);
      if (i > 0)
        change = change + Ball(double(p_sin)) * power(cosine, p_cos + 1) * power(sine, p_sin - 1);
      now.u[first + i] = drifts;
      now.v[first + i] = W[i] * common * cosine;
      now.a[first + i] = c.omega * multiple * W[i] * change;
    }
    first += n;
  }
  return now;
}

// Of each mass its frequency and its amplitude.
void ShapedEnclosure::fill(const RowParameters& p) {
  c_.omega = p.Omega;
  c_.sigma = p.sigma;
  const auto row = exact::row_masses(p);
  Ball up, down, momentum;
  for (const auto& mass : row) {
    auto& sum = mass.velocity > 0.0 ? up : down;
    sum = sum + mass.velocity;
  }
  c_.coefficients.resize(2);
  auto &frequencies = c_.coefficients[0], &amplitudes = c_.coefficients[1];
  auto& impulses = c_.impulses_by_turn.emplace_back();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto& [rounded, multiple, velocity] = row[i];
    const Ball mass = velocity > 0.0 ? Ball(p.m1) : -(Ball(p.m1) * up / down);
    frequencies.push_back(c_.omega * multiple);
    amplitudes.push_back(Ball(quarter_sine(multiple) * velocity) / frequencies.back());
    momentum = momentum + mass * velocity;
    if (i + 1 < row.size()) impulses.push_back((Ball(1.0) + p.eta) * momentum);
    c_.energy = c_.energy + half(mass * velocity * velocity);
  }
}

KinematicBalls ShapedEnclosure::shape(const RowParameters& p, const Phase& phase) {
  auto now = at_rest(std::size_t(dof_));
  const auto& c = constants();
  const auto slow = turned(phase, 1.0, 0.0), fast = turned(phase, p.X, 0.0);
  for (std::size_t i = 0; i < now.u.size(); ++i) {
    const auto& [sine, cosine] = double(i + 1) == p.fast ? fast : slow;
    add_oscillation(now, i, c.coefficients[1][i], c.coefficients[0][i], cosine, sine);
  }
  return now;
}

void ShapedEnclosure::fill(const AlternatingParameters& p) {
  c_.omega = 2.0 * p.Omega;
  c_.sigma = p.sigma;
  const Ball speed = p.Omega, sigma = p.sigma;
  c_.impulses_by_turn = {{Ball(2.0) * speed}, {Ball(2.0) * speed}};
  c_.energy = half((Ball(2.0) + p.r) * speed * speed + Ball(2.0) * sigma * sigma);
}

// With x the phase of the outer masses since the upper one was struck, their displacements are sin x
// and -cos x; after an odd number of impacts they have exchanged their roles.
KinematicBalls ShapedEnclosure::shape(const AlternatingParameters& p, const Phase& phase) {
  auto now = at_rest(3);
  const auto [sine, cosine] = turned(phase, 0.5, 1.0);
  const Ball outer = p.Omega;
  if (phase.is_odd) {
    add_oscillation(now, 0, Ball(1.0), outer, cosine, sine);
    add_oscillation(now, 2, Ball(-1.0), outer, sine, -cosine);
  } else {
    add_oscillation(now, 0, Ball(1.0), outer, sine, -cosine);
    add_oscillation(now, 2, Ball(-1.0), outer, cosine, sine);
  }
  const auto middle = turned(phase, p.rh, 0.0);
  const double sign = (std::fmod(p.rh, 4.0) == 0.0) == phase.is_odd ? 1.0 : -1.0;
  add_oscillation(now, 1, Ball(sign) * p.r / (2.0 * p.rh), Ball(2.0 * p.rh) * outer, middle.sine,
                  -middle.cosine);
  return now;
}

// The amplitudes of the slow and of the fast oscillation: S g = x by forward substitution.
void ShapedEnclosure::fill(const AssemblyParameters& p) {
  const Ball one = 1.0, xi1 = p.xi1;
  c_.omega = sqrt((one - xi1) * (one + xi1));
  c_.sigma = xi1;
  const exact::AssemblyData data(p);
  c_.coefficients.resize(2);
  auto& impulses = c_.impulses_by_turn.emplace_back();
  for (std::size_t i = 0; i < data.dof(); ++i) {
    const auto [m2, r, A] = data.pair(i / 2);
    const bool is_slow = i % 2 == 0;
    Ball slow = is_slow ? A : 0.0;
    Ball fast = is_slow ? Ball() : Ball(-quarter_sine(p.X)) * r * A / p.X;
    for (std::size_t j = data.first_column(i); j < i; ++j) {
      slow = slow - c_.coefficients[0][j] * data.entry(i, j);
      fast = fast - c_.coefficients[1][j] * data.entry(i, j);
    }
    c_.coefficients[0].push_back(slow);
    c_.coefficients[1].push_back(fast);
    if (!is_slow) continue;
    const Ball speed = c_.omega * A, m1 = Ball(r) * m2;
    impulses.push_back((one + p.eta) * m1 * speed);
    c_.energy = c_.energy + half(m1 * speed * speed * (one + r));
  }
}

KinematicBalls ShapedEnclosure::shape(const AssemblyParameters& p, const Phase& phase) {
  auto now = at_rest(std::size_t(dof_));
  const auto& c = constants();
  const auto slow = turned(phase, 1.0, 0.0), fast = turned(phase, p.X, 0.0);
  const Ball w = c.omega * p.X;
  for (std::size_t i = 0; i < now.u.size(); ++i) {
    add_oscillation(now, i, c.coefficients[0][i], c.omega, slow.cosine, slow.sine);
    add_oscillation(now, i, c.coefficients[1][i], w, fast.cosine, fast.sine);
  }
  return now;
}

ShapedEnclosure::SineCosine ShapedEnclosure::turned(const Phase& phase, double multiple,
                                                    double quarters) {
  SineCosine x;
  if (!phase.is_exact) {
    const Ball turns = phase.turns * multiple + scaled(Ball(quarters), -2);
    arb_sin_cos_pi(x.sine.get(), x.cosine.get(), turns.get(), WorkingBits::now());
    return x;
  }
  // Whole eighths of a turn.
  const double eighth = std::fmod(2.0 * multiple * phase.halves + quarters, 8.0);
  const auto sine_of = [](double place) {
    place = place < 0.0 ? place + 8.0 : std::fmod(place, 8.0);
    const double sign = place < 4.0 ? 1.0 : -1.0;
    const double within = std::fmod(place, 4.0);
    if (within == 0.0) return Ball();
    return within == 2.0 ? Ball(sign) : Ball(sign) * sqrt(Ball(0.5));
  };
  return {sine_of(eighth), sine_of(eighth < -2.0 ? eighth + 10.0 : eighth + 2.0)};
}

// E p, E (p' - sigma p), E (p'' - 2 sigma p' + sigma^2 p).
KinematicBalls ShapedEnclosure::state(const Phase& phase, const Ball& decay) {
  auto now = std::visit([&](const auto& p) { return shape(p, phase); }, parameters_);
  const Ball& rate = sigma();
  // What is 0 at an algebraic phase shows itself by being nearer to it than another number could.
  const auto value = [&](const Ball& x) {
    if (phase.is_exact && x.holds_zero() &&
        abs(x) < scaled(Ball(1.0), -long(fraction_bits(0) / 2.0)))
      return Ball();
    return x * decay;
  };
  for (std::size_t i = 0; i < now.u.size(); ++i) {
    const Ball p = now.u[i], first = now.v[i], second = now.a[i];
    now.u[i] = value(p);
    now.v[i] = value(first - rate * p);
    now.a[i] = value(second - rate * (Ball(2.0) * first - rate * p));
  }
  return now;
}

KinematicBalls ShapedEnclosure::at_now(long long k, double t) {
  Phase phase;
  phase.is_odd = k % 2 != 0;
  phase.is_exact = t == 0.0;
  if (phase.is_exact)
    phase.halves = 1.0 - 2.0 * timing_.first_impact;
  else
    phase.turns = omega() * t / Ball::pi() - (double(k) - 0.5 + timing_.first_impact);
  return state(phase, decay_now(k, Ball(t)));
}

ImpactBalls ShapedEnclosure::impact_now(long long k) {
  const auto number = (k - 1) / timing_.at_once + 1;
  const auto& c = constants();
  const auto& contacts = c.impulses_by_turn[std::size_t(number - 1) % c.impulses_by_turn.size()];
  ImpactBalls hit;
  hit.t = instant_now(number);
  const Ball before = decay_now(number - 1, hit.t), after = decay_now(number, hit.t);
  hit.before =
      state({.is_exact = true, .halves = 1.0, .turns = {}, .is_odd = number % 2 == 0}, before);
  hit.after =
      state({.is_exact = true, .halves = -1.0, .turns = {}, .is_odd = number % 2 != 0}, after);
  hit.impulse = contacts[std::size_t((k - 1) % timing_.at_once)] * before;
  hit.energy_before = c.energy * before * before;
  hit.energy_after = c.energy * after * after;
  return hit;
}

}  // namespace clackers::certified

#endif
