#include "clackers/exact/quantities/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"

namespace clackers::exact {
namespace {

double slow_over_fast(const FrequencyRatio& ratio, double r) {
  return ratio.is_inverse ? 1.0 / r : r;
}

// Impacts until `size` has grown to lost_synchrony, the logarithm growing by `rate` at each.
double impacts_at(double size, double rate) {
  if (size >= lost_synchrony) return 0.0;
  if (rate == 0.0) return infinity;
  return std::max(1.0, std::ceil(std::log(lost_synchrony / size) / rate));
}

void require_share(const char* name, double given, double size) {
  if (!(size > 0.0 && size < 1.0))
    refuse("conditioning", name, given, "a size between 0 and 1, both excluded");
}

// A pair in free flight and through impacts, without the common factor exp(-sigma t), which no
// contact depends on: x = c cos(w theta) + s sin(w theta), w = 1 and q, theta = Omega t.
class DetunedPair {
 public:
  DetunedPair(double X, double r, double eta, double q)
      : r_(r), eta_(eta), q_(q), fast_{-quarter_sine(X) * r / X, 0.0} {}

  // The time to the next contact, after which the masses leave it; infinity once `most` evaluations
  // of the gap are used up. The gap cannot close unseen: its second derivative is at most `bound`,
  // so that it stays positive as long as the parabola from where it is known does.
  double fly(int& most) {
    const double slow = std::hypot(slow_.c, slow_.s), fast = std::hypot(fast_.c, fast_.s);
    const double bound = slow + q_ * q_ * fast, tiny = 1e-14 * (slow + fast);
    double theta = 0.0, gap = slow_.c - fast_.c, rate = slow_.s - q_ * fast_.s;
    for (; most > 0; --most) {
      const double root = std::sqrt(rate * rate + 2.0 * bound * gap);
      theta += rate > 0.0 ? (rate + root) / bound : 2.0 * gap / (root - rate);
      const double c = std::cos(theta), s = std::sin(theta);
      const double cq = std::cos(q_ * theta), sq = std::sin(q_ * theta);
      const double u = slow_.c * c + slow_.s * s;
      const double v1 = slow_.s * c - slow_.c * s, v2 = q_ * (fast_.s * cq - fast_.c * sq);
      gap = u - fast_.c * cq - fast_.s * sq;
      rate = v1 - v2;
      if (gap >= tiny || rate >= 0.0) {
        gap = std::max(gap, 0.0);
        continue;
      }
      const double common = (r_ * v1 + v2) / (1.0 + r_), parting = -eta_ * rate;
      const double scale = 1.0 / std::max({std::abs(u), std::abs(v1), std::abs(v2)});
      slow_ = {scale * u, scale * (common + parting / (1.0 + r_))};
      fast_ = {scale * u, scale * (common - r_ * parting / (1.0 + r_)) / q_};
      return theta;
    }
    return infinity;
  }

 private:
  struct Wave {
    double c, s;
  };
  double r_, eta_, q_;
  Wave slow_{1.0, 0.0}, fast_;
};

// The impact after which a simulated pair is first spaced wrongly, if that is not after `most`;
// infinity where it is, and where it would take too long to see.
double simulated_loss(double X, double r, double eta, double eps, double most) {
  using std::numbers::pi;
  DetunedPair pair(X, r, eta, X * (1.0 + eps));
  int evaluations = 30000;
  // The first impact ends half a spacing.
  double start = -0.5 * pi;
  for (double k = 1.0; k <= most; k += 1.0) {
    const double theta = pair.fly(evaluations);
    if (theta == infinity) return infinity;
    if (std::abs((theta - start) / pi - 1.0) > lost_synchrony) return k;
    start = 0.0;
    // A perfectly plastic impact is the last one.
    if (eta == 0.0) return infinity;
  }
  return infinity;
}

}  // namespace

double detuning_rate(const FrequencyRatio& ratio, double r) {
  const double q = slow_over_fast(ratio, r), X = ratio.odd;
  if (X == 1.0 || q <= 1.0) return 0.0;
  return std::numbers::pi * std::sqrt((q - 1.0) * (X - q) * (X + q) / std::pow(1.0 + q, 3));
}

Conditioning conditioning(const FrequencyRatio& ratio, double r, double eta) {
  if (eta < 1.0) return Conditioning::growing;
  return detuning_rate(ratio, r) > 0.0 ? Conditioning::detuning_fragile : Conditioning::neutral;
}

double impacts_until_perturbation(double eta, double size) {
  require_share("perturbation", size, size);
  return impacts_at(size, -std::log(eta));
}

double impacts_until_detuning(const FrequencyRatio& ratio, double r, double eta, double eps) {
  const double size = std::abs(eps);
  require_share("detuning", eps, size);
  const double law = impacts_at(size, detuning_rate(ratio, r) * size - std::log(eta));
  return std::min(law, simulated_loss(ratio.odd, slow_over_fast(ratio, r), eta, eps, law));
}

}  // namespace clackers::exact
