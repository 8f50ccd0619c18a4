#include "clackers/exact/bodies/mass_on_bar.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/constants.hpp"
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

Polynomial product(const Polynomial& x, const Polynomial& y) {
  if (x.empty() || y.empty()) return {};
  Polynomial xy(x.size() + y.size() - 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < y.size(); ++k) xy[i + k] = xy[i + k] + x[i] * y[k];
  return xy;
}

// p(from + sign x), a polynomial in x.
Polynomial shifted(const Polynomial& p, const Wide& from, double sign) {
  Polynomial q;
  for (std::size_t i = p.size(); i-- > 0;) {
    q.emplace_back();
    for (std::size_t k = q.size(); k-- > 0;)
      q[k] = from * q[k] + (k > 0 ? Wide(sign) * q[k - 1] : p[i]);
  }
  return q;
}

// The integral from 0.
Polynomial integrated(const Polynomial& p) {
  Polynomial sum(1);
  for (const auto& x : p) sum.push_back(x / Wide(double(sum.size())));
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
  follow(who);
}

Wide MassOnBar::value(const Polynomial& coefficients, const Wide& s) const {
  if (coefficients.empty()) return {};
  return exp(-(kappa_ * s)) * polynomial(coefficients, s / tau_);
}

// The derivative of exp(-kappa s) p is exp(-kappa s) times this.
Polynomial MassOnBar::derivative(const Polynomial& p) const {
  Polynomial d(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    d[i] = -(kappa_ * p[i]);
    if (i + 1 < p.size()) d[i] = d[i] + Wide(double(i + 1)) * p[i + 1] / tau_;
  }
  return d;
}

// G with G' - rate G the polynomial: exp(-rate s) G is the integral.
Polynomial MassOnBar::antiderivative(const Polynomial& p, const Wide& rate) const {
  Polynomial g(p.size());
  Wide above;
  for (std::size_t i = p.size(); i-- > 0;) {
    g[i] = (above - p[i]) / rate;
    above = Wide(double(i)) * g[i] / tau_;
  }
  return g;
}

void MassOnBar::send(const Wide& t, const Wide& origin, Polynomial o, std::string_view who) {
  if (out_.size() == longest_list)
    refuse(who, "t_end", p_.end, "a run of at most 20000 pieces of waves", {}, "not-admissible");
  auto integral = antiderivative(o, kappa_);
  const auto& last = out_.back();
  const auto before = last.before + value(last.integral, t - last.origin);
  const auto from = value(integral, t - origin);
  out_.push_back({t, origin, std::move(o), std::move(integral), before - from});
}

void MassOnBar::refuse_soft_touch(const Wide& t, std::string_view who) const {
  refuse(
      who, "M", p_.M,
      fmt::format(
          "a mass that certainly touches the bar or does not; soon after t = {:.9g} s this is open",
          t.nearest()),
      "Change M.", "not-admissible");
}

// By halves, until the sign of the function or of its rate is certain over a whole interval, as a number with this
// error.
std::optional<Wide> MassOnBar::first_fall(const Course& f, const Wide& begin, const Wide& end,
                                          bool rises, std::string_view who) const {
  const auto rate = derivative(f.p), curvature = derivative(rate);
  const auto search = [&](const auto& self, const WideReal& from, const WideReal& to,
                          int depth) -> std::optional<Wide> {
    const Wide span((from + to) / 2, (to - from) / 2);
    const auto slope = f.b + value(rate, span);
    if ((at(f, middle(span)) - upper(slope) * Wide(span.error, 0)).is_positive())
      return std::nullopt;
    if (slope.is_positive()) return std::nullopt;
    if (rises && from == begin.value && value(curvature, span).is_positive()) return std::nullopt;
    if ((-slope).is_positive()) {
      const auto last = at(f, {to, 0});
      if (last.is_positive()) return std::nullopt;
      if ((-last).is_positive()) {
        WideReal above = from, below = to;
        for (int i = 0; i < 260; ++i) {
          const WideReal half = (above + below) / 2;
          (at(f, {half, 0}).value > 0 ? above : below) = half;
        }
        // The function falls at least at the least slope of the interval.
        const auto left = upper(at(f, {below, 0}));
        return Wide(below, upper(left / (upper(slope) - Wide(2 * slope.error, 0))).value);
      }
    }
    if (depth == 0) refuse_soft_touch(out_.back().t, who);
    if (const auto found = self(self, from, span.value, depth - 1)) return found;
    return self(self, span.value, to, depth - 1);
  };
  return search(search, begin.value, end.value, 200);
}

// From one change of the contact or of the arriving wave to the next. P and Q of v and a: P' = kappa Q with v
// continuous while they touch and 2 P - Q goes out; otherwise the end is free and what arrives goes out.
void MassOnBar::follow(std::string_view who) {
  const auto twice = Wide(2.0) * tau_;
  // A change at the end itself is one of the run.
  const Wide last(WideReal(p_.end) * (1 + epsilon), 0);
  Wide t = start_, speed = p_.V, gap;
  bool closed = true, opens = false;
  out_.push_back({t - twice - twice, t, {}, {}, {}});
  phases_ = {{out_[0].t, speed, false}, {t, speed, true}};
  for (std::size_t in = 0; closed || t.value < last.value;) {
    const auto origin = out_[in].origin + twice, s = t - origin;
    const auto Q = combined(back_, out_[in].coefficients, 0.0, {});
    Polynomial P, force;
    if (closed) {
      P = integrated(Q);
      for (auto& x : P) x = kappa_ * tau_ * x;
      P[0] = speed * exp(kappa_ * s) - polynomial(P, s / tau_);
      force = combined(1.0, P, -1.0, Q);
      if (const auto now = polynomial(force, s / tau_); !now.is_positive()) {
        if (!(-now).is_positive()) refuse_soft_touch(t, who);
        closed = false, opens = true;
        phases_.push_back({t, speed, closed});
      }
    }
    send(t, origin, closed ? combined(2.0, P, -1.0, Q) : Q, who);
    const auto arrives = out_[in + 1].t + twice,
               next = closed || arrives.value < last.value ? arrives : last;
    // While they touch v - a, otherwise the gap.
    const auto& moved = out_.back().integral;
    const Course course =
        closed ? Course{force, {}, {}} : Course{moved, gap + speed * s - value(moved, s), -speed};
    const auto zero = first_fall(course, s, next - origin, opens, who);
    const auto until = zero ? *zero : next - origin;
    if (closed)
      speed = value(P, until);
    else
      gap = zero ? Wide() : at(course, until);
    t = zero ? origin + *zero : next;
    if (zero) {
      closed = !closed;
      phases_.push_back({t, speed, closed});
    } else {
      ++in;
    }
    opens = zero && !closed;
  }
}

std::vector<BarContact::Event> MassOnBar::events() const {
  std::vector<BarContact::Event> list;
  for (auto i = 1u; i < phases_.size(); ++i)
    list.push_back({phases_[i].closed, narrowed(phases_[i].t)});
  return list;
}

BarMotion::Changes MassOnBar::changes() const {
  Changes found;
  for (const auto& event : events()) found.first.push_back(event.t);
  return found;
}

Wide MassOnBar::outgoing(const Wide& t, Side side, const WideReal& slack) const {
  const auto& piece = piece_at(out_, t, side, slack);
  return value(piece.coefficients, t - piece.origin);
}

auto MassOnBar::wave(const Wide& t, Side side, const WideReal& slack) const -> Wave {
  const auto &piece = piece_at(out_, t, side, slack), &exact = piece_at(out_, t, Side::right, 0);
  const auto s = t - piece.origin, decay = exp(-(kappa_ * s));
  return {decay * polynomial(piece.coefficients, s / tau_),
          &exact == &piece ? piece.before + decay * polynomial(piece.integral, s / tau_)
                           : exact.before + value(exact.integral, t - exact.origin)};
}

BarMotion::Point MassOnBar::at(std::size_t, double x, double t, Side side) const {
  const auto late = Wide(x) / c_, half = Wide(0.5);
  const auto o = wave(Wide(t) - late, side, half_spacing(t)),
             sent = wave(Wide(t) + late - Wide(2.0) * tau_, side, half_spacing(t));
  const auto a = Wide(back_) * sent.value;
  return {narrowed(half * (o.sum + Wide(back_) * sent.sum)), narrowed(half * (o.value + a)),
          narrowed(Wide(p_.bar.rho) * c_ * half * (a - o.value))};
}

Bounded MassOnBar::force(double t, Side side) const {
  const auto slack = half_spacing(t);
  if (!piece_at(phases_, t, side, slack).closed) return 0.0;
  const auto o = outgoing(t, side, slack),
             a = Wide(back_) * outgoing(Wide(t) - Wide(2.0) * tau_, side, slack);
  return narrowed(Wide(0.5) * z_ * (o - a));
}

Wide MassOnBar::mass_speed(double t) const {
  const auto& phase = piece_at(phases_, t, Side::right, 0);
  if (!phase.closed) return phase.speed;
  return Wide(0.5) * (outgoing(t, Side::right, 0) +
                      Wide(back_) * outgoing(Wide(t) - Wide(2.0) * tau_, Side::right, 0));
}

Bounded MassOnBar::impulse(double t, Side) const {
  return narrowed(Wide(p_.M) * (Wide(p_.V) - mass_speed(t)));
}

// Between fronts the squares of the waves are exp(-+2 kappa s) times polynomials; in their product the exponentials
// cancel.
BarMotion::Energy MassOnBar::energy(double time) const {
  const Wide t = time, begin = t - Wide(2.0) * tau_;
  std::vector<Wide> fronts{0.0, tau_};
  for (const auto& piece : out_)
    for (const auto& late : {t - piece.t, piece.t - begin})
      if (late.value > 0 && late.value < tau_.value) fronts.push_back(late);
  std::ranges::sort(fronts, {}, &Wide::value);
  Wide squares, both;
  for (std::size_t i = 0; i + 1 < fronts.size(); ++i) {
    const auto from = fronts[i], length = fronts[i + 1] - from, inside = from + Wide(0.5) * length;
    // exp(-+kappa s) times these, s from the front on.
    const auto local = [&](const Wide& at, double sign) {
      const auto& piece = piece_at(out_, at + Wide(sign) * (inside - from), Side::right, 0);
      const auto s = at - piece.origin, decay = exp(-(kappa_ * s));
      auto p = shifted(piece.coefficients, s / tau_, sign);
      for (auto& factor : p) factor = decay * factor;
      return p;
    };
    const auto o = local(t - from, -1.0), a = local(begin + from, 1.0);
    const auto x = length / tau_;
    const auto square = [&](const Polynomial& p, double sign) {
      const auto rate = Wide(2.0 * sign) * kappa_;
      const auto g = antiderivative(product(p, p), rate);
      return exp(-(rate * length)) * polynomial(g, x) - polynomial(g, 0.0);
    };
    squares = squares + square(o, -1.0) + square(a, 1.0);
    both = both + Wide(back_) * tau_ * polynomial(integrated(product(o, a)), x);
  }
  const auto share = Wide(0.125) * z_, v = mass_speed(time);
  return {narrowed(share * (squares + Wide(2.0) * both) + Wide(0.5) * Wide(p_.M) * v * v),
          narrowed(share * (squares - Wide(2.0) * both)), 0.0};
}

}  // namespace clackers::exact
