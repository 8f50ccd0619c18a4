#include "clackers/exact/bodies/mass_on_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/bodies/bar_waves.hpp"

namespace clackers::exact {

using model::Side;
using numerics::Bounded, numerics::narrowed, numerics::Wide, numerics::WideReal;
using Polynomial = std::vector<Wide>;

namespace {

constexpr std::size_t longest_list = 20'000;

Polynomial combined(double a, const Polynomial& x, double b, const Polynomial& y) {
  Polynomial sum(std::max(x.size(), y.size()));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (i < x.size()) sum[i] = Wide(a) * x[i];
    if (i < y.size()) sum[i] = sum[i] + Wide(b) * y[i];
  }
  return sum;
}

Wide polynomial(const Polynomial& p, const Wide& x) {
  Wide sum;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
  return sum;
}

}  // namespace

MassOnBar::MassOnBar(const MassOnBarParameters& parameters, std::string_view who) : p_(parameters) {
  const Wide M(p_.M);
  const auto wave = WaveOf<Wide>::of(p_.bar);
  tau_ = wave.transit, c_ = wave.speed, z_ = wave.impedance;
  kappa_ = z_ / M;
  back_ = p_.is_fixed ? -1.0 : 1.0;
  start_ = Wide(p_.gap) / Wide(p_.V);
  const double ratio = (M / (z_ * tau_)).nearest();
  if (!(ratio >= 0.01 && ratio <= 100.0))
    refuse(who, "M", p_.M,
           fmt::format("0.01 to 100 times the mass of the bar, {:.6g} kg", (z_ * tau_).nearest()));
  follow_contact(who);
  reflect(who);
  require_one_contact(who);
}

Wide MassOnBar::value(const Polynomial& coefficients, const Wide& s) const {
  if (coefficients.empty()) return {};
  return exp(-(kappa_ * s)) * polynomial(coefficients, s / tau_);
}

// G with G' - kappa G the polynomial: exp(-kappa s) G is the integral.
Polynomial MassOnBar::antiderivative(const Polynomial& p) const {
  Polynomial g(p.size());
  Wide above;
  for (std::size_t i = p.size(); i-- > 0;) {
    g[i] = (above - p[i]) / kappa_;
    above = Wide(double(i)) * g[i] / tau_;
  }
  return g;
}

// P and Q of v and a: Q+ = -+(2 P - Q), P+' = kappa Q+ with v continuous; contact ends where P = Q.
void MassOnBar::follow_contact(std::string_view who) {
  constexpr int most_intervals = 200, parts = 256;
  const auto twice = Wide(2.0) * tau_;
  Polynomial P{Wide(p_.V)}, Q;
  out_.push_back({start_ - twice - twice, start_, {}, {}});
  for (int j = 0; j < most_intervals; ++j) {
    const auto origin = start_ + Wide(double(j)) * twice;
    const auto force = combined(1.0, P, -1.0, Q);
    const auto contact_force = [&](const WideReal& s) {
      return polynomial(force, Wide(s, 0) / tau_).value;
    };
    WideReal inside = 0, outside = 0;
    bool ends = !(contact_force(0) > 0);
    for (int i = 1; i <= parts && !ends; ++i) {
      outside = twice.value * i / parts;
      ends = !(contact_force(outside) > 0);
      if (!ends) inside = outside;
    }
    if (!ends || outside > 0) out_.push_back({origin, origin, combined(2.0, P, -1.0, Q), {}});
    if (ends) {
      for (int i = 0; i < 260 && outside > 0; ++i) {
        const WideReal middle = (inside + outside) / 2;
        (contact_force(middle) > 0 ? inside : outside) = middle;
      }
      // What the rounding of the polynomial moves its root by.
      Wide s(outside, 0);
      if (outside > 0) {
        const auto at_root = polynomial(force, s / tau_);
        const WideReal step = twice.value * WideReal(1e-20),
                       slope = (contact_force(outside - step) - contact_force(outside)) / step;
        s.error = (at_root.error + abs(at_root.value)) * 2 / slope;
      }
      end_of_contact_ = origin + s;
      last_speed_ = value(P, s);
      out_.push_back({end_of_contact_, origin, Q, {}});
      return;
    }
    // On to the next interval.
    const auto arriving =
        combined(back_.value > 0 ? 2.0 : -2.0, P, back_.value > 0 ? -1.0 : 1.0, Q);
    Polynomial next{value(P, twice)};
    for (std::size_t i = 0; i < arriving.size(); ++i)
      next.push_back(kappa_ * tau_ * arriving[i] / Wide(double(i + 1)));
    P = std::move(next);
    Q = arriving;
  }
  refuse(who, "M", p_.M, "a mass that leaves the bar within 400 L/c", {}, "not-admissible");
}

// Afterwards the end is free: what arrives goes out again.
void MassOnBar::reflect(std::string_view who) {
  const auto twice = Wide(2.0) * tau_;
  const auto first = std::ranges::find_if(out_, [&](const Piece& piece) {
    return piece.t.value + twice.value > end_of_contact_.value;
  });
  for (auto i = std::size_t(first - out_.begin());
       (out_[i].t + twice).value < WideReal(p_.end) + twice.value; ++i) {
    Piece next = out_[i];
    next.t = next.t + twice;
    next.origin = next.origin + twice;
    for (auto& x : next.coefficients) x = back_ * x;
    out_.push_back(std::move(next));
    if (out_.size() > longest_list)
      refuse(who, "t_end", p_.end, "a run of at most 20000 pieces of waves", {}, "not-admissible");
  }
  for (std::size_t i = 0; i + 1 < out_.size(); ++i) {
    const auto g = antiderivative(out_[i].coefficients);
    out_[i + 1].integral = out_[i].integral + value(g, out_[i + 1].t - out_[i].origin) -
                           value(g, out_[i].t - out_[i].origin);
  }
}

// At 64 instants a transit; the gap opens without speed where the far end is fixed.
void MassOnBar::require_one_contact(std::string_view who) const {
  const double from = end_of_contact_.nearest(), step = tau_.nearest() / 64.0;
  for (double t = from + step; t <= p_.end; t += step) {
    const auto end = Wide(0.5) * (sum_of_out(t) + back_ * sum_of_out(Wide(t) - Wide(2.0) * tau_));
    const auto mass = Wide(0.5) * (sum_of_out(end_of_contact_) +
                                   back_ * sum_of_out(end_of_contact_ - Wide(2.0) * tau_)) +
                      last_speed_ * (Wide(t) - end_of_contact_);
    if (!(end.value > mass.value))
      refuse(who, "t_end", p_.end,
             fmt::format("t_end < {:.6g} s, before the bar strikes the mass once more", t), {},
             "not-admissible");
  }
}

Wide MassOnBar::outgoing(const Wide& t, Side side, const WideReal& slack) const {
  const auto& piece = piece_at(out_, t, side, slack);
  return value(piece.coefficients, t - piece.origin);
}

Wide MassOnBar::sum_of_out(const Wide& t) const {
  const auto& piece = piece_at(out_, t, Side::right, 0);
  const auto g = antiderivative(piece.coefficients);
  return piece.integral + value(g, t - piece.origin) - value(g, piece.t - piece.origin);
}

BarMotion::Point MassOnBar::at(std::size_t, double x, double t, Side side) const {
  const auto late = Wide(x) / c_, half = Wide(0.5), twice = Wide(2.0) * tau_;
  const auto from = Wide(t) - late, to = Wide(t) + late - twice;
  const auto o = outgoing(from, side, half_spacing(t)),
             a = back_ * outgoing(to, side, half_spacing(t));
  return {narrowed(half * (sum_of_out(from) + back_ * sum_of_out(to))), narrowed(half * (o + a)),
          narrowed(Wide(p_.bar.rho) * c_ * half * (a - o))};
}

Bounded MassOnBar::force(double t, Side side) const {
  const auto slack = half_spacing(t);
  const auto o = outgoing(t, side, slack),
             a = back_ * outgoing(Wide(t) - Wide(2.0) * tau_, side, slack);
  const bool is_over =
      t > end_of_contact_.nearest() || (t == end_of_contact_.nearest() && side == Side::right);
  return is_over ? Bounded(0.0) : narrowed(Wide(0.5) * z_ * (o - a));
}

Wide MassOnBar::mass_speed(const Wide& t, Side side) const {
  if (t.value >= end_of_contact_.value) return last_speed_;
  if (t.value < start_.value) return p_.V;
  return Wide(0.5) * (outgoing(t, side, 0) + back_ * outgoing(t - Wide(2.0) * tau_, side, 0));
}

Bounded MassOnBar::impulse(double t, Side) const {
  return narrowed(Wide(p_.M) * (Wide(p_.V) - mass_speed(t, Side::right)));
}

// The squares of the waves by Gauss's rule between fronts, where they are smooth.
BarMotion::Energy MassOnBar::energy(double t) const {
  const long double tau = narrowed(tau_).value, now = t, z = narrowed(z_).value;
  std::vector<long double> fronts{0.0L, tau};
  for (const auto& piece : out_) {
    const auto from = narrowed(piece.t).value;
    for (const auto late : {now - from, from + 2.0L * tau - now})
      if (late > 0.0L && late < tau) fronts.push_back(late);
  }
  std::ranges::sort(fronts);
  long double kinetic = 0.0L, elastic = 0.0L;
  for (std::size_t i = 0; i + 1 < fronts.size(); ++i) {
    const auto square = [&](long double sign) {
      return boost::math::quadrature::gauss<long double, 20>::integrate(
          [&](long double late) {
            const auto o = narrowed(outgoing(Wide(WideReal(now - late), 0), Side::right, 0)).value,
                       a = narrowed(back_ *
                                    outgoing(Wide(WideReal(now + late), 0) - Wide(2.0) * tau_,
                                             Side::right, 0))
                               .value,
                       sum = 0.5L * (a + sign * o);
            return sum * sum;
          },
          fronts[i], fronts[i + 1]);
    };
    kinetic += 0.5L * z * square(1.0L);
    elastic += 0.5L * z * square(-1.0L);
  }
  const auto v = narrowed(mass_speed(t, Side::right)).value;
  kinetic += 0.5L * p_.M * v * v;
  const auto rounded = [](long double x) { return Bounded(x, 1e-15L * std::abs(x)); };
  return {rounded(kinetic), rounded(elastic), 0.0};
}

}  // namespace clackers::exact
