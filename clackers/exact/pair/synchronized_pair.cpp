#include "clackers/exact/pair/synchronized_pair.hpp"

#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/parameter_ranges.hpp"
#include "clackers/exact/pair/wide_motion.hpp"

namespace clackers::exact {

namespace {

WideMotion pair_motion(std::string_view who, const PairParameters& p, const FrequencyRatio& ratio) {
  require_scale(who, "m1", p.m1);
  require_scale(who, "k1", p.k1);
  require_damping_ratio(who, p.xi1);
  require_scale(who, "A", p.A);
  require_scale(who, "r", p.r);
  require_restitution(who, p.eta);

  const Wide omega1 = sqrt(Wide(p.k1) / p.m1), xi1 = p.xi1, odd = ratio.odd;
  const Wide omega_d1 = omega1 * sqrt(1 - xi1 * xi1);
  const double s = quarter_sine(ratio.odd);
  WideMotion motion;
  motion.sigma = xi1 * omega1;
  motion.eta = p.eta;
  motion.end = p.t_end;
  if (ratio.exchanged) {
    motion.omega = omega_d1 / odd;
    motion.masses = {{p.m1, s * Wide(p.A), ratio.odd},
                     {Wide(p.m1) / p.r, -Wide(p.r) * p.A * odd, 1.0}};
  } else {
    motion.omega = omega_d1;
    motion.masses = {{p.m1, p.A, 1.0}, {Wide(p.m1) / p.r, -s * Wide(p.r) * p.A / odd, ratio.odd}};
  }
  require_end(who, motion);
  require_admissible(who, motion, ratio, p.r);
  return motion;
}

}  // namespace

SynchronizedPair::SynchronizedPair(const PairParameters& p, std::string_view who)
    : SynchronizedPair(p, frequency_ratio(who, p.X),
                       pair_motion(who, p, frequency_ratio(who, p.X))) {}

SynchronizedPair::SynchronizedPair(const PairParameters& p, const FrequencyRatio& ratio,
                                   const WideMotion& motion)
    : ClosedForm(motion), parameters_(p), constants_(pair_constants(motion, ratio)) {}

}  // namespace clackers::exact
