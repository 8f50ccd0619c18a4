#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/pair/parameters.hpp"
#include "clackers/exact/quantities/sensitivity.hpp"
#include "clackers/numerics/exp2.hpp"
#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {
namespace {

using model::Kinematics;
using model::Side;
using numerics::DoubleDouble;
using numerics::exp2_rounded;

// One mass: a deviation of its displacement and velocity.
struct Deviation {
  double u = 0.0, v = 0.0;
};

// Of both masses, as the common part C that an impact keeps and the relative one R whose sign it
// reverses: x1 = C + R/(1 + r), x2 = C - r R/(1 + r). A stop is a second mass of infinite mass: r = 0.
struct Split {
  Deviation C, R;
};

struct Body {
  double mass = 1.0, sigma = 0.0, w = 1.0;  // w: damped frequency
  double square = 1.0;                      // w^2 + sigma^2
  double multiple = 1.0, start = 0.0;
  double V = 0.0;  // velocity after an impact over that of mass 1
  // Derivatives of sigma, w and square with respect to the parameter.
  double sigma_p = 0.0, w_p = 0.0, square_p = 0.0;
  Deviation initial;
};

// Free flight over a time after which exp(-sigma t) = e and the angle wt has this cosine and sine.
Deviation fly(const Body& b, const Deviation& z, double e, double c, double s) {
  return {e * (z.u * c + (z.v + b.sigma * z.u) / b.w * s),
          e * (z.v * c - (b.sigma * z.v + b.square * z.u) / b.w * s)};
}

// d/dp of the first flight with u(0), v(0) = -sigma u(0) held fixed.
Deviation first_change(const Body& b, double t, double e, double c, double s) {
  const double u = b.sigma_p * (s / b.w - t * c) - b.w_p * t * s;
  const double rate = b.sigma_p * b.w * t * s - b.w_p * (s + b.w * t * c);
  return {b.start * e * u, b.start * e * (rate - b.sigma * u)};
}

// d/dp of exp(-sigma x) sin(wx)/w and of its time derivative, V times.
Deviation later_change(const Body& b, double x, double e, double c, double s) {
  const double w = b.w, q = b.sigma / w;
  const double u = -b.sigma_p * x * s / w + b.w_p * (x * c - s / w) / w;
  const double v = -b.sigma_p * (x * (c - q * s) + s / w) - b.w_p * (x * s - q * s / w + q * x * c);
  return {b.V * e * u, b.V * e * v};
}

class RawSensitivity : public Sensitivity {
 public:
  RawSensitivity(const ClosedForm& motion, std::string_view name) : motion_(motion) {
    const auto& c = motion.flight();
    n_ = c.masses.size();
    eta_ = c.eta;
    period_ = c.period.hi;
    const auto& mass = motion.problem().system.mass;
    r_ = n_ == 2 ? mass(0, 0) / mass(1, 1) : 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      auto& b = bodies_[i];
      const auto& from = c.masses[i];
      b.mass = mass(Eigen::Index(i), Eigen::Index(i));
      b.sigma = c.decay.hi * std::log(2.0);
      b.w = from.multiple * c.turns.hi * numerics::pi.hi;
      b.square = b.w * b.w + b.sigma * b.sigma;
      b.multiple = from.multiple;
      b.start = from.b.hi;
      b.V = i == 0 ? 1.0 : -r_;
      read(name, i);
    }
    if (name == "eta") rho_.R.v = (1.0 + r_) / eta_;
    if (name == "m1") rho_.C.v = -(1.0 + eta_) * r_ / (eta_ * bodies_[0].mass * (1.0 + r_));
    if (name == "m2") rho_.C.v = (1.0 + eta_) * r_ * r_ / (eta_ * bodies_[0].mass * (1.0 + r_));
    if (name == "gap") rho_.R.u = -(1.0 + eta_);
    if (c.collides) prepare_impacts(c);
  }

  Kinematics at(double t, Side side) const override {
    const auto [flight, theta_over_pi] = motion_.phase(t, side);
    const auto& c = motion_.flight();
    const auto size = static_cast<Eigen::Index>(n_);
    const auto state = motion_.at(t, side);
    Kinematics d{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size),
                 Eigen::VectorXd::Zero(size)};
    // What is left of the flight's start, and the angle since.
    const bool first = flight == 0.0;
    const auto part = first ? theta_over_pi : theta_over_pi + DoubleDouble{0.5, 0.0};
    const double e = exp2_rounded(first ? -(c.decay * t) : -(c.period_decay * part));
    const auto z = first ? std::array<Deviation, 2>{} : both(after(flight));
    const double a = first ? 0.0
                           : a_1_ * exp2_rounded(c.log2_eta * (flight - 1.0)) *
                                 exp2_rounded(-(c.period_decay * (flight - 1.0)));
    for (std::size_t i = 0; i < n_; ++i) {
      const auto& b = bodies_[i];
      const auto [sine, cosine] = numerics::sincospi(part * b.multiple);
      auto x = fly(b, first ? b.initial : z[i], e, cosine.hi, sine.hi);
      const auto y = first ? first_change(b, t, e, cosine.hi, sine.hi)
                           : later_change(b, part.hi * period_, a * e, cosine.hi, sine.hi);
      x.u += y.u;
      x.v += y.v;
      const auto at = static_cast<Eigen::Index>(i);
      d.u[at] = x.u + 0.0;  // no -0
      d.v[at] = x.v + 0.0;
      // a = -2 sigma v - square u, differentiated.
      d.a[at] = -2.0 * b.sigma * x.v - b.square * x.u - 2.0 * b.sigma_p * state.v[at] -
                b.square_p * state.u[at];
    }
    return d;
  }

 private:
  // What the parameter `name` is to mass i.
  void read(std::string_view name, std::size_t i) {
    auto& b = bodies_[i];
    const auto is = [&](const char* first, const char* second) {
      return name == (i == 0 ? first : second);
    };
    if (is("m1", "m2")) {
      b.sigma_p = -b.sigma / b.mass;
      b.w_p = (b.sigma - b.w) * (b.sigma + b.w) / (2.0 * b.mass * b.w);
      b.square_p = -b.square / b.mass;
    } else if (is("k1", "k2")) {
      b.w_p = 1.0 / (2.0 * b.mass * b.w);
      b.square_p = 1.0 / b.mass;
    } else if (is("c1", "c2")) {
      b.sigma_p = 1.0 / (2.0 * b.mass);
      b.w_p = -b.sigma / (2.0 * b.mass * b.w);
    } else if (is("u10", "u20")) {
      b.initial.u = 1.0;
    } else if (is("v10", "v20")) {
      b.initial.v = 1.0;
    }
  }

  static Split split(const std::array<Deviation, 2>& z, double r) {
    return {{(r * z[0].u + z[1].u) / (1.0 + r), (r * z[0].v + z[1].v) / (1.0 + r)},
            {z[0].u - z[1].u, z[0].v - z[1].v}};
  }
  std::array<Deviation, 2> both(const Split& s) const {
    const double weight1 = 1.0 / (1.0 + r_), weight2 = r_ / (1.0 + r_);
    return {{{s.C.u + weight1 * s.R.u, s.C.v + weight1 * s.R.v},
             {s.C.u - weight2 * s.R.u, s.C.v - weight2 * s.R.v}}};
  }

  // Just after the first impact, and what every later flight adds. Of C only the part that is
  // not shared with the later flights.
  void prepare_impacts(const FlightConstants& c) {
    const double e = exp2_rounded(c.period_decay * -0.5);
    a_1_ = -c.masses[0].v_hit.hi * eta_ * e;
    std::array<Deviation, 2> hit, rest, later;
    for (std::size_t i = 0; i < n_; ++i) {
      const auto& b = bodies_[i];
      const double s = quarter_sine(b.multiple);
      const auto z = fly(b, b.initial, e, 0.0, s);
      const auto y = first_change(b, 0.5 * period_, e, 0.0, s);
      hit[i] = {z.u + y.u, z.v + y.v};
      // An even later flight would add C(Y) a_1/(1 + eta): what differs from it is left, formed
      // without that sum, which would cancel for eta near 1.
      const double part = (1.0 - eta_) / (2.0 * eta_ * (1.0 + eta_));
      const double over = 1.0 / (eta_ * b.w * b.w), shift = period_ * b.w_p / b.w;
      rest[i] = {
          z.u + a_1_ * b.V * (b.sigma_p * over - shift * part),
          z.v + a_1_ * b.V *
                    ((period_ * b.sigma_p + b.sigma * shift) * part - 0.5 * b.square_p * over)};
      // Over the whole period, without the decay over it.
      later[i] = {-b.V * period_ * b.w_p / b.w,
                  b.V * period_ * (b.sigma_p + b.sigma * b.w_p / b.w)};
    }
    first_ = split(hit, r_);
    later_ = split(later, r_);
    first_.R.u = -eta_ * first_.R.u + rho_.R.u;
    first_.R.v = -eta_ * first_.R.v + a_1_ * rho_.R.v;
    first_.C = split(rest, r_).C;
    first_.C.v += a_1_ * rho_.C.v / (1.0 + eta_);
    log_q_ = std::log(2.0) * (c.log2_eta - c.period_decay).hi;
  }

  // Just after impact `flight`: every flight reverses all signs and adds to it, every impact reverses
  // R once more; n flights later the sums are geometric.
  Split after(double flight) const {
    const auto& c = motion_.flight();
    const double n = flight - 1.0;
    const double e_n = exp2_rounded(-(c.period_decay * n)), eta_n = exp2_rounded(c.log2_eta * n);
    const double turn = std::fmod(n, 2.0) == 0.0 ? e_n : -e_n, q_n = e_n * eta_n;
    const double share = q_n * a_1_ / (1.0 + eta_);
    Split z;
    z.C.u = turn * first_.C.u + share * later_.C.u;
    z.C.v = turn * first_.C.v + share * (later_.C.v + eta_ * rho_.C.v);
    z.R.u = q_n * (first_.R.u - n * a_1_ * later_.R.u);
    z.R.v = q_n * (first_.R.v + n * a_1_ * (rho_.R.v - later_.R.v));
    // A moved contact adds to every impact the same: 1 + q + ... + q^(n-1) of it.
    if (rho_.R.u != 0.0)
      z.R.u += rho_.R.u * (log_q_ == 0.0 ? n : std::expm1(n * log_q_) / std::expm1(log_q_));
    return z;
  }

  const ClosedForm& motion_;
  std::size_t n_ = 0;
  double eta_ = 1.0, r_ = 0.0, period_ = 0.0, a_1_ = 0.0, log_q_ = 0.0;
  std::array<Body, 2> bodies_;
  Split rho_, first_, later_;
};

}  // namespace

std::vector<std::string> raw_parameters(const ClosedForm& motion) {
  const bool collides = motion.flight().collides;
  if (motion.dof() == 2)
    return {"m1", "m2", "k1", "k2", "c1", "c2", "eta", "gap", "u10", "u20", "v10", "v20"};
  if (collides) return {"m1", "k1", "c1", "eta", "gap", "u10", "v10"};
  return {"m1", "k1", "c1", "u10", "v10"};
}

std::unique_ptr<Sensitivity> raw_sensitivity(const ClosedForm& motion, std::string_view parameter) {
  const auto names = raw_parameters(motion);
  if (std::ranges::find(names, parameter) == names.end())
    refuse_name("parameter to differentiate by", parameter, names,
                fmt::format("{}", fmt::join(names, ", ")));
  if (motion.flight().eta == 0.0 && motion.phase(motion.end(), Side::right).flight > 0.0)
    throw InputError(
        fmt::format(
            "sensitivity to {}: eta = 0; allowed: 0 < eta <= 1. At 0 the masses stay in "
            "contact after the first impact; disturbed ones press or part by the sign of "
            "the disturbance, and the formula divides by eta: there is no derivative. Use a "
            "small eta instead.",
            parameter),
        "no-derivative");
  return std::make_unique<RawSensitivity>(motion, parameter);
}

}  // namespace clackers::exact
