#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clackers/exact/certified/ball.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::certified {

/// A motion of the module exact to any number of digits: each value is enclosed with more and more
/// bits until its decimals are certain, and then correctly rounded. One thread at a time.
class Digits {
 public:
  static constexpr int most = 1000;

  struct KinematicTexts {
    std::vector<std::string> u, v, a;  ///< [m], [m/s], [m/s^2], of each mass
  };
  struct ImpactTexts {
    std::string t;
    KinematicTexts before, after;
    std::string impulse, energy_before, energy_after;
  };

  /// Throws InputError unless 1 <= digits <= most; for a motion of another kind (no-enclosure); and
  /// always when built without Arb (needs-arb), telling what to install.
  Digits(const model::Motion& motion, long long digits);
  ~Digits();

  /// A double as it stands, for the times: at least 17 digits, so that it reads back as the same.
  std::string time(double t) const;
  /// The state at t within the motion; `side` as for model::Motion::sample().
  KinematicTexts at(double t, model::Side side);
  /// Impact 1, 2, ... up to the motion's impact_count(end).
  ImpactTexts impact(long long k);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What is known of a number apart from the ball that holds it: its square is a fraction of whole
/// numbers whose denominator is below 2^bits. Such a number can lie exactly halfway between two
/// decimal numbers, and no ball shows that; but a ball that is narrow enough proves it, because two
/// different fractions cannot be arbitrarily close.
struct Fraction {
  double bits = 0.0;
};

/// The number that `value` holds, correctly rounded to n >= 1 significant digits, half to even;
/// nothing when the ball is too wide to decide. Without `fraction` the number must not lie halfway,
/// unless the ball is exact. From 1e-5 to below 10^n as in 0.0012300, else as in 1.2300e-17; 0 is 0.
std::optional<std::string> decimals(const Ball& value, int n,
                                    const std::optional<Fraction>& fraction = {});

}  // namespace clackers::certified
