#pragma once

#include <memory>
#include <string>
#include <vector>

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

}  // namespace clackers::certified
