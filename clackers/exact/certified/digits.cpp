#include "clackers/exact/certified/digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "clackers/base/error.hpp"

#ifdef CLACKERS_HAS_ARB
#include "clackers/exact/certified/enclosure.hpp"
#endif

namespace clackers::certified {

#ifdef CLACKERS_HAS_ARB

struct Digits::State {
  State(const model::Motion& motion, int n) : enclosure(enclosure_of(motion)), digits(n) {}

  std::unique_ptr<Enclosure> enclosure;
  int digits;

  // Enough for most values at the first attempt: log2(10) bits a digit.
  long first_bits() const { return static_cast<long>(3.33 * digits) + 24; }

  // Texts of values that `evaluate(bits)` gives and `write(values, text)` goes through, again with
  // twice the bits as long as one of them is not certain.
  template <class Evaluate, class Write>
  auto certain(Evaluate evaluate, Write write) {
    for (long bits = first_bits();; bits *= 2) {
      const WorkingBits scope(bits);
      bool all = true;
      const auto text = [&](const Ball& value, const std::optional<Fraction>& fraction) {
        auto decimal = decimals(value, digits, fraction);
        all = all && decimal.has_value();
        return decimal.value_or("");
      };
      auto texts = write(evaluate(bits), text);
      if (all) return texts;
    }
  }
};

namespace {

Digits::KinematicTexts texts_of(const KinematicBalls& balls, auto text,
                                const std::optional<Fraction>& fraction) {
  Digits::KinematicTexts out;
  for (const auto& [from, to] :
       {std::pair{&balls.u, &out.u}, {&balls.v, &out.v}, {&balls.a, &out.a}})
    for (const auto& value : *from) to->push_back(text(value, fraction));
  return out;
}

}  // namespace

Digits::Digits(const model::Motion& motion, long long digits) {
  if (digits < 1 || digits > most)
    refuse("digits", "digits", fmt::format("{}", digits), fmt::format("1 <= digits <= {}", most));
  state_ = std::make_unique<State>(motion, static_cast<int>(digits));
}

std::string Digits::time(double t) const {
  const WorkingBits scope(4096);  // a double is exact, and so are its products with 10^1000
  return decimals(Ball(t), std::max(17, state_->digits)).value();
}

Digits::KinematicTexts Digits::at(double t, model::Side side) {
  // At t = 0 the values are roots of fractions; after it they are transcendental (Lindemann), or 0.
  std::optional<Fraction> fraction;
  if (t == 0.0) fraction = Fraction{state_->enclosure->fraction_bits(0)};
  return state_->certain(
      [&](long bits) { return state_->enclosure->at(t, side, bits); },
      [&](const KinematicBalls& now, auto text) { return texts_of(now, text, fraction); });
}

Digits::ImpactTexts Digits::impact(long long k) {
  // exp(-sigma t_k) is a power of e^pi, transcendental (Gelfond), unless sigma is 0. So is t_k.
  std::optional<Fraction> fraction;
  if (state_->enclosure->is_undamped()) fraction = Fraction{state_->enclosure->fraction_bits(k)};
  const auto write = [&](const ImpactBalls& hit, auto text) {
    return ImpactTexts{text(hit.t, {}),
                       texts_of(hit.before, text, fraction),
                       texts_of(hit.after, text, fraction),
                       text(hit.impulse, fraction),
                       text(hit.energy_before, fraction),
                       text(hit.energy_after, fraction)};
  };
  return state_->certain([&](long bits) { return state_->enclosure->impact(k, bits); }, write);
}

#else

struct Digits::State {};

Digits::Digits(const model::Motion&, long long) {
  throw InputError(
      "digits: this program was built without Arb, which encloses values to any number of digits; "
      "allowed: double precision, without --digits. Install Arb (Debian: libflint-arb-dev), then "
      "configure and build again.",
      "needs-arb");
}

// Never called: nothing can be constructed.
std::string Digits::time(double) const { return {}; }
Digits::KinematicTexts Digits::at(double, model::Side) { return {}; }
Digits::ImpactTexts Digits::impact(long long) { return {}; }

#endif

Digits::~Digits() = default;

}  // namespace clackers::certified
