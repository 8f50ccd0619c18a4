#include "clackers/exact/bodies/bar_waves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"

namespace clackers::exact {

using numerics::Wide, numerics::WideReal;

namespace {

constexpr std::size_t most_pieces = 20'000;

bool is_positive(const Wide& x) { return x.value > x.error; }

// An instant that may be any of both.
Wide covering(const Wide& a, const Wide& b) {
  return {a.value, std::max<WideReal>(a.error, abs(a.value - b.value) + b.error)};
}

Wide linear(const auto& piece, const Wide& t) { return piece.value + piece.slope * (t - piece.t); }

// Pieces that begin at the same time within their errors are one.
template <class List>
void push(List& list, auto piece) {
  if (!list.empty() && !is_positive(piece.t - list.back().t)) {
    piece.t = covering(list.back().t, piece.t);
    list.back() = piece;
  } else {
    list.push_back(piece);
  }
}

// When gap + rate s + slope s^2/2 comes down to 0; nothing where it does not within `span`.
std::optional<Wide> closing_time(const Wide& gap, const Wide& rate, const Wide& slope,
                                 const Wide& span, std::string_view who, double now) {
  std::optional<Wide> s;
  if (slope.value == 0 && slope.error == 0) {
    if (is_positive(-rate)) s = gap / -rate;
  } else if (slope.value < 0 || is_positive(-rate)) {
    const auto square = rate * rate - Wide(2.0) * gap * slope;
    if (!is_positive(square)) {
      if (square.value < -square.error) return std::nullopt;
      // A touch without speed: nothing follows from one that comes only after a change.
      if (slope.value > 0 && -rate.value / slope.value > span.value) return std::nullopt;
      throw InputError(fmt::format("{}: near t = {:.9g} s the ends touch so softly that it is not "
                                   "certain whether they do; allowed: motions in which contact "
                                   "begins with a speed. Change the height or the gap.",
                                   who, now),
                       "not-admissible");
    }
    const auto root = sqrt(square);
    s = rate.value > 0 ? (rate + root) / -slope : Wide(2.0) * gap / (root - rate);
  }
  if (s && s->value < 0) *s = {0, s->error - s->value};
  if (s && s->value > span.value) s.reset();
  return s;
}

}  // namespace

BarContact::Waves::Waves(const BarsParameters& parameters, std::string_view who)
    : p_(parameters), gap_(parameters.gap) {
  for (const auto& bar : p_.bars) {
    const auto [tau, c, z] = WaveOf<Wide>::of(bar);
    Ends ends{tau, c, z, {}};
    const auto twice = Wide(2.0) * tau;
    ends.out.push_back({-twice, Wide(bar.v0) + Wide(p_.g) * twice, Wide(-p_.g)});
    waves_.push_back(std::move(ends));
  }
  if (p_.N > 0.0) {
    const auto fall = Wide(p_.N) * waves_[0].tau;
    gap_ = Wide(0.5) * Wide(p_.g) * fall * fall;
    // From lower heights the next falls are others.
    if (p_.N >= 3.0 && p_.N == std::floor(p_.N))
      period_ = Wide(4.0) * (Wide(p_.N) + Wide(1.0)) * waves_[0].tau;
  }
  build(who);
}

auto BarContact::Waves::folded(double t) const -> Folded {
  if (!(period_.value > 0) || t < 2 * period_.value) return {t};
  const WideReal k = floor(t / period_.value) - 1;
  return {Wide(t) - Wide(k, 0) * period_, k};
}

void BarContact::Waves::build(std::string_view who) {
  // A change at the end itself is one of the run.
  const WideReal end = WideReal(p_.end) * (1 + epsilon),
                 last = period_.value > 0 ? std::min<WideReal>(end, 2 * period_.value) : end;
  const std::size_t bars = waves_.size(), right = bars - 1;
  std::array<Wide, 2> share{1.0, 1.0};  // of the rate that each end takes when they meet
  compliance_ = waves_[0].z;
  if (bars == 2) {
    const auto sum = waves_[0].z + waves_[1].z;
    share = {waves_[1].z / sum, waves_[0].z / sum};
    compliance_ = waves_[0].z * share[0];
  }
  std::array<std::size_t, 2> in{};  // of each bar's pieces the one that arrives
  Phase now;
  now.gap = gap_;
  now.closed = gap_.value == 0;
  for (bool ends = false; !ends;) {
    std::array<Piece, 2> a;
    for (std::size_t b = 0; b < bars; ++b) {
      const auto& [tau, c, z, out] = waves_[b];
      const auto twice = Wide(2.0) * tau;
      for (; in[b] + 1 < out.size(); ++in[b]) {
        const auto arrives = out[in[b] + 1].t + twice;
        if (is_positive(arrives - now.t)) break;
        now.t = covering(now.t, arrives);
      }
      const auto& piece = out[in[b]];
      a[b] = {now.t, linear(piece, now.t - twice) - Wide(p_.g) * twice, piece.slope};
    }
    now.rate = a[right].value;
    now.slope = a[right].slope;
    if (bars == 2) {
      now.rate = now.rate - a[0].value;
      now.slope = now.slope - a[0].slope;
    }
    if (now.closed &&
        (is_positive(now.rate) || (!is_positive(-now.rate) && is_positive(now.slope)))) {
      now.closed = false;
      events_.push_back({false, now.t});
    }
    for (std::size_t b = 0; b < bars; ++b) {
      const Wide part = (b == right ? -share[b] : share[b]);
      const auto sent = [&](double times) -> Piece {
        if (!now.closed) return a[b];
        return {now.t, a[b].value + Wide(times) * part * now.rate,
                a[b].slope + Wide(times) * part * now.slope};
      };
      now.end[b] = bars == 1 && now.closed ? Piece{now.t, 0.0, 0.0} : sent(1.0);
      push(waves_[b].out, sent(2.0));
    }
    push(phases_, now);
    if (phases_.size() > most_pieces)
      throw InputError(
          fmt::format("{}: the waves have more than {} pieces by t = {:.9g} s; allowed: "
                      "at most so many. End the run earlier.",
                      who, most_pieces, now.t.nearest()),
          "not-admissible");
    // To the next change.
    Wide next(last, 0);
    for (std::size_t b = 0; b < bars; ++b)
      if (in[b] + 1 < waves_[b].out.size()) {
        const auto arrives = waves_[b].out[in[b] + 1].t + Wide(2.0) * waves_[b].tau;
        if (arrives.value < next.value) next = arrives;
      }
    const auto span = next - now.t;
    bool closes = false;
    if (now.closed) {
      if (is_positive(-now.rate) && is_positive(now.slope))
        if (const auto s = -now.rate / now.slope; s.value < span.value) next = now.t + s;
    } else if (const auto s =
                   closing_time(now.gap, now.rate, now.slope, span, who, now.t.nearest())) {
      next = now.t + *s;
      closes = true;
    }
    ends = !closes && next.value >= last;
    const auto s = next - now.t;
    for (std::size_t b = 0; b < bars; ++b)
      now.end_moved[b] = now.end_moved[b] + moved(now.end[b].value, now.end[b].slope, s);
    if (now.closed)
      now.impulse = now.impulse - compliance_ * moved(now.rate, now.slope, s);
    else
      now.gap = closes ? Wide(0.0) : now.gap + moved(now.rate, now.slope, s);
    if (bars == 1) now.end_moved[0] = now.gap - gap_;
    now.t = next;
    if (closes) {
      now.closed = true;
      events_.push_back({true, now.t});
    }
  }
}

Wide BarContact::Waves::arriving(std::size_t bar, const Wide& t, Side side,
                                 const WideReal& slack) const {
  const auto& [tau, c, z, out] = waves_[bar];
  const auto twice = Wide(2.0) * tau, left = t - twice;
  return linear(piece_at(out, left, side, slack), left) - Wide(p_.g) * twice;
}

Wide BarContact::Waves::outgoing(std::size_t bar, const Wide& t, Side side,
                                 const WideReal& slack) const {
  return linear(piece_at(waves_[bar].out, t, side, slack), t);
}

Wide BarContact::Waves::sum_of_out(std::size_t bar, const Wide& from, const Wide& to) const {
  const auto& out = waves_[bar].out;
  const auto after =
      std::ranges::upper_bound(out, from.value, {}, [](const Piece& p) { return p.t.value; });
  Wide sum, start = from;
  for (auto i = std::size_t(std::max<std::ptrdiff_t>(0, after - out.begin() - 1));; ++i) {
    const bool is_last = i + 1 == out.size() || out[i + 1].t.value >= to.value;
    const auto stop = is_last ? to : out[i + 1].t;
    sum = sum + moved(linear(out[i], start), out[i].slope, stop - start);
    if (is_last) return sum;
    start = stop;
  }
}

Wide BarContact::Waves::displacement(std::size_t bar, const Wide& x, const Wide& t) const {
  const auto& waves = waves_[bar];
  const auto late = x / waves.c, twice = Wide(2.0) * waves.tau, g = Wide(p_.g);
  const auto from = t - late, to = t + late;
  const auto of_a = [&](const Wide& begin) {
    return sum_of_out(bar, begin - twice, to - twice) - g * twice * (to - begin);
  };
  const auto weight = Wide(0.5) * g * late * late;
  if (from.value < 0) return Wide(0.5) * (of_a(0.0) - sum_of_out(bar, from, 0.0)) + weight;
  const auto& phase = this->phase(from, Side::right, 0);
  return phase.end_moved[bar] + moved(phase.end[bar].value, phase.end[bar].slope, from - phase.t) +
         Wide(0.5) * of_a(from) + weight;
}

Wide BarContact::Waves::impulse(const Wide& t) const {
  const auto& now = phase(t, Side::right, 0);
  return now.closed ? now.impulse - compliance_ * moved(now.rate, now.slope, t - now.t)
                    : now.impulse;
}

}  // namespace clackers::exact
