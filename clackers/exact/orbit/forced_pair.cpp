#include "clackers/exact/orbit/forced_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/pair/parameters.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

using numerics::Bounded;
using numerics::narrowed;
using numerics::Wide;

namespace {

constexpr double largest_phase = 1e12;
/// Nearer to resonance, a rounding of a frequency moves the orbit by more than 1e4 roundings.
constexpr double least_detuning = 1e-4;

constexpr int instants = 2048;

void require_whole(std::string_view who, double n) {
  constexpr auto rule = "a whole number, 1 <= n <= 1e6";
  if (!(n >= 1.0 && n <= 1e6)) refuse(who, "n", n, rule);
  if (n != std::floor(n))
    refuse(who, "n", n, rule, "The motion repeats itself only after whole periods of the force.",
           "not-whole");
}

void require_mass(std::string_view who, const char* omega_name, double omega,
                  const char* sigma_name, double sigma) {
  require_scale(who, omega_name, omega, 1e-30, 1e30);
  require_within(who, sigma_name, sigma, 0.0, 1e30);
}

void require_run(std::string_view who, double T, double n, double omega1, double omega2,
                 double t_end) {
  require_scale(who, "T", T, 1e-30, 1e30);
  require_whole(who, n);
  require_positive(who, "t_end", t_end);
  if (std::max({6.3 * n / T, omega1, omega2}) * std::max(t_end, T) > largest_phase)
    refuse(who, "t_end", t_end, "every phase at most 1e12 rad",
           "Beyond, phases are not known to the digits of a double.");
}

// What a user may change first, the smaller change before the larger.
template <class Parameters>
struct Change {
  const char* name;
  double Parameters::*parameter;
  double factor, summand;
};
template <class Parameters>
std::vector<Change<Parameters>> changes();
template <>
std::vector<Change<ForcedPairParameters>> changes() {
  using P = ForcedPairParameters;
  return {{"V1", &P::V1, 2.0, 0.0}, {"V1", &P::V1, 0.5, 0.0}, {"V1", &P::V1, 8.0, 0.0},
          {"m2", &P::m2, 2.0, 0.0}, {"m2", &P::m2, 0.5, 0.0}, {"m2", &P::m2, 8.0, 0.0},
          {"n", &P::n, 1.0, 1.0},   {"n", &P::n, 1.0, -1.0},  {"T", &P::T, 0.8, 0.0},
          {"T", &P::T, 1.25, 0.0},  {"T", &P::T, 0.5, 0.0},   {"T", &P::T, 0.25, 0.0}};
}
template <>
std::vector<Change<BaseExcitedParameters>> changes() {
  using P = BaseExcitedParameters;
  return {{"A_g", &P::A_g, -1.0, 0.0}, {"n", &P::n, 1.0, 1.0},  {"n", &P::n, 1.0, -1.0},
          {"T", &P::T, 0.8, 0.0},      {"T", &P::T, 1.25, 0.0}, {"T", &P::T, 0.5, 0.0},
          {"T", &P::T, 0.25, 0.0}};
}

void require_detuned(std::string_view who, int i, double omega, double T, const Wide& distance) {
  if (std::abs(distance.nearest()) >= least_detuning) return;
  throw InputError(
      fmt::format("{}: omega{} T = {:.6g} pi; allowed: away from resonance. Mass {} alone "
                  "makes whole or half oscillations between impacts, and no force of finite "
                  "amplitude keeps the orbit; change T or omega{} by a few percent.",
                  who, i, (Wide(omega) * T / Wide::pi()).nearest(), i, i),
      "not-admissible");
}

void require_detuned(std::string_view who, int i, double omega, double sigma, double T) {
  const auto sine = sin(Wide(omega) * T * 0.5), growth = sinh(Wide(sigma) * T * 0.5);
  require_detuned(who, i, omega, T, sqrt(growth * growth + sine * sine));
}

// Constants are computed with 256 bits.
OrbitFormulas<Bounded> narrowed_orbit(const OrbitFormulas<Wide>& wide) {
  OrbitFormulas<Bounded> orbit;
  orbit.T = narrowed(wide.T);
  orbit.nu = narrowed(wide.nu);
  orbit.n = wide.n;
  orbit.eta = wide.eta;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& x = wide.masses[i];
    orbit.masses[i] = {narrowed(x.m), narrowed(x.w),  narrowed(x.sigma),
                       narrowed(x.D), narrowed(x.V),  narrowed(x.P),
                       narrowed(x.Q), narrowed(x.p0), narrowed(x.p1)};
  }
  return orbit;
}

}  // namespace

void ForcedPair::build(std::string_view who, const ForcedPairParameters& p) {
  require_scale(who, "m1", p.m1, 1e-30, 1e30);
  require_scale(who, "m2", p.m2, 1e-30, 1e30);
  require_mass(who, "omega1", p.omega1, "sigma1", p.sigma1);
  require_mass(who, "omega2", p.omega2, "sigma2", p.sigma2);
  if (!(p.eta >= 1e-3 && p.eta <= 1.0))
    refuse(
        who, "eta", p.eta, "1e-3 <= eta <= 1",
        "After a plastic impact the masses would not separate with the speed that the orbit needs.");
  require_run(who, p.T, p.n, p.omega1, p.omega2, p.t_end);
  require_within(who, "D1", p.D1, -1e30, 1e30);
  require_within(who, "D2", p.D2, -1e30, 1e30);
  require_scale(who, "V1", p.V1, 1e-30, 1e30);
  require_detuned(who, 1, p.omega1, p.sigma1, p.T);
  require_detuned(who, 2, p.omega2, p.sigma2, p.T);
  formulas_ = narrowed_orbit(OrbitFormulas<Wide>(p));
}

void ForcedPair::build(std::string_view who, const BaseExcitedParameters& p) {
  require_scale(who, "m1", p.m1, 1e-30, 1e30);
  require_mass(who, "omega1", p.omega1, "sigma1", 0.0);
  require_mass(who, "omega2", p.omega2, "sigma2", 0.0);
  require_run(who, p.T, p.n, p.omega1, p.omega2, p.t_end);
  if (!(std::abs(p.A_g) >= 1e-30 && std::abs(p.A_g) <= 1e30))
    refuse(who, "A_g", p.A_g, "1e-30 <= |A_g| <= 1e+30");
  for (const auto& [i, omega] : {std::pair(1, p.omega1), std::pair(2, p.omega2)}) {
    require_detuned(who, i, omega, 0.0, p.T);
    require_detuned(who, i, omega, p.T, cos(Wide(omega) * p.T * 0.5));
  }
  formulas_ = narrowed_orbit(OrbitFormulas<Wide>(p));
}

// The gap starts at 0 and opens. |g''| and |g'''| are bounded for the whole flight, so the steps of first_root pass no
// zero; the one that it finds must be the impact at T, where g = (V1 - V2)/eta (T - s) to first order.
std::optional<ForcedPair::Closing> ForcedPair::closing() const {
  const double T = this->T(), speed = velocity(0) - velocity(1), nu = this->nu();
  double curvature = 0.0, third = 0.0, fastest = nu;
  for (const auto& mass : formulas_.masses) {
    const double square = mass.square().nearest(), own = std::sqrt(square);
    const double free = square * std::hypot(mass.P.nearest(), mass.Q.nearest());
    const double steady = nu * nu * std::hypot(mass.p0.nearest(), mass.p1.nearest());
    curvature += free + steady;
    third += free * own + steady * nu;
    fastest = std::max(fastest, own);
  }
  const auto bound = [&](double s) {
    const auto mass1 = formulas_.mass_state(formulas_.masses[0], s),
               mass2 = formulas_.mass_state(formulas_.masses[1], s);
    numerics::LocalBound gap;
    gap.value = ((mass1.u - mass2.u) - (formulas_.masses[0].D - formulas_.masses[1].D)).nearest();
    gap.slope = (mass1.v - mass2.v).nearest();
    gap.second = (mass1.a - mass2.a).nearest();
    gap.curvature = curvature * (1.0 + 1e-9);
    gap.third_bound = third * (1.0 + 1e-9);
    gap.reach = T;
    gap.whole = false;  // only whether there is a root is asked
    return gap;
  };
  const double near = 1e-7 * T;
  const auto root = numerics::first_root(bound, 0.0, T - near, 1e-7 / fastest, 1000000);
  if (speed > 0.0 && root.status == numerics::FirstRoot::Status::none) return std::nullopt;
  Closing closing{root.status == numerics::FirstRoot::Status::found ? root.s : 0.0, 0.0};
  for (int i = 1; i < instants; ++i)
    closing.overlap = std::max(closing.overlap, -bound(T * i / instants).value);
  return closing;
}

double ForcedPair::smallest_share() const {
  const double T = this->T(), speed = velocity(0) - velocity(1);
  double least = std::min(1.0, 1.0 / formulas_.eta);
  for (int i = 1; i < instants; ++i) {
    const double s = T * i / instants;
    const auto g = (formulas_.mass_state(formulas_.masses[0], s).u -
                    formulas_.mass_state(formulas_.masses[1], s).u) -
                   (formulas_.masses[0].D - formulas_.masses[1].D);
    least = std::min(least, g.nearest() * T / (speed * s * (T - s)));
  }
  return least;
}

template <class Parameters>
void ForcedPair::require_open(std::string_view who, const Parameters& p) const {
  const auto opens = [&](const Parameters& other) {
    try {
      ForcedPair orbit{FlightsParameters(other)};
      orbit.build(who, other);
      return orbit.velocity(0) > 0.0 && orbit.velocity(1) < 0.0 && !orbit.closing();
    } catch (const InputError&) {
      return false;
    }
  };
  if (velocity(0) > 0.0 && velocity(1) < 0.0 && !closing()) return;
  std::string advice = "Choose another T, n or ratio of masses.";
  for (const auto& change : changes<Parameters>()) {
    auto other = p;
    other.*change.parameter = change.factor * p.*change.parameter + change.summand;
    if (!opens(other)) continue;
    advice = fmt::format("With {} = {:.6g} they do not.", change.name, other.*change.parameter);
    break;
  }
  if (!(velocity(0) > 0.0 && velocity(1) < 0.0))
    throw InputError(
        fmt::format(
            "{}: after an impact mass 1 would have {:.6g} m/s and mass 2 {:.6g} m/s; allowed: "
            "above 0 and below 0. These masses would pass through each other. {}",
            who, velocity(0), velocity(1), advice),
        "not-admissible");
  const auto early = *closing();
  throw InputError(
      fmt::format(
          "{}: the masses meet {:.6g} s after an impact instead of T = {} s, and would overlap "
          "by {:.3g} m; allowed: a gap that stays open between impacts. {}",
          who, early.at, T(), early.overlap, advice),
      "not-admissible");
}

ForcedPair::ForcedPair(const ForcedPairParameters& p, std::string_view who)
    : FlightsBy(OrbitFormulas<Bounded>(), p) {
  build(who, p);
  require_open(who, p);
  make_problem(p.t_end);
}

ForcedPair::ForcedPair(const BaseExcitedParameters& p, std::string_view who)
    : FlightsBy(OrbitFormulas<Bounded>(), p) {
  build(who, p);
  require_open(who, p);
  make_problem(p.t_end);
}

// F cos phi = m [(w^2 + sigma^2 - nu^2) p0 + 2 sigma nu p1] and -F sin phi the same of (p1, -p0), for
// phases from an impact on; t = 0 is n half turns later.
ForcedPair::Force ForcedPair::force(const Mass& mass) const {
  const auto stiff = mass.square() - formulas_.nu * formulas_.nu,
             damped = Bounded(2.0) * mass.sigma * formulas_.nu;
  const auto cosine = mass.m * (stiff * mass.p0 + damped * mass.p1);
  const auto sine = mass.m * (stiff * mass.p1 - damped * mass.p0);
  const bool turned = std::fmod(formulas_.n, 2.0) != 0.0;
  const auto sign = turned ? -1.0L : 1.0L;
  return {static_cast<double>(std::hypot(cosine.value, sine.value)),
          static_cast<double>(std::atan2(-sign * sine.value, sign * cosine.value))};
}

void ForcedPair::make_problem(double t_end) {
  std::vector<model::HarmonicForce> forces;
  auto& system = problem_.system;
  system.mass = system.damping = system.stiffness = Eigen::MatrixXd::Zero(2, 2);
  for (int i = 0; i < 2; ++i) {
    const auto& mass = formulas_.masses[std::size_t(i)];
    system.mass(i, i) = mass.m.nearest();
    system.damping(i, i) = (Bounded(2.0) * mass.m * mass.sigma).nearest();
    system.stiffness(i, i) = (mass.m * mass.square()).nearest();
    const auto [amplitude, phase] = force(mass);
    forces.push_back({i, amplitude, nu(), phase});
  }
  system.add_load = model::HarmonicLoad(std::move(forces));
  problem_.contacts = {{Eigen::Vector2d(1.0, -1.0),
                        (formulas_.masses[0].D - formulas_.masses[1].D).nearest(), formulas_.eta}};
  problem_.end = t_end;
  const auto start = at(0.0, model::Side::right);
  problem_.start = {0.0, start.u, start.v};
  margin_ = smallest_share();
  find_size();
}

long long ForcedPair::near_flight(double t) const {
  return static_cast<long long>(std::floor(t / T() + 0.5));
}

void ForcedPair::find_size() {
  size_ = {Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2)};
  for (int i = 0; i <= instants; ++i)
    for (Eigen::Index j = 0; j < 2; ++j) {
      const auto now = formulas_.mass_state(formulas_.masses[std::size_t(j)], T() * i / instants);
      size_.u[j] = std::max(size_.u[j], std::abs(now.u.nearest()));
      size_.v[j] = std::max(size_.v[j], std::abs(now.v.nearest()));
      size_.a[j] = std::max(size_.a[j], std::abs(now.a.nearest()));
    }
}

model::Kinematics ForcedPair::envelope(double t) const {
  model::require_inside("motion", t, end());
  return size_;
}

}  // namespace clackers::exact
