#include "clackers/exact/orbit/bouncing_ball.hpp"

#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using numerics::Wide;

const BallParameters& require_bouncing(const BallParameters& ball, std::string_view who) {
  if (!(ball.eta >= 0.0 && ball.eta < 1.0))
    refuse(who, "eta", ball.eta, "0 <= eta < 1",
           ball.eta == 1.0 ? "An elastic ball never comes to rest; for restitution 1 use "
                             "pressed-oscillator with k = 0."
                           : "");
  if (!(ball.h0 > 0.0 || ball.v0 > 0.0))
    refuse(who, "v0", ball.v0, "v0 > 0 where h0 = 0", "It starts on the floor.");
  return ball;
}

long long powers(const Wide& share, double eta) {
  const long double left = static_cast<long double>(share.value);
  if (eta == 0.0 || !(left > 0.0L)) return 0;
  return static_cast<long long>(
      std::floor(std::log(left) / std::log1p(static_cast<long double>(eta) - 1.0L)));
}

long long last_impact(const BallParameters& ball) {
  const BallFormulas<Wide> f(ball, 0);
  return std::max(1LL, 1 + powers(Wide(0x1p-56) * f.rest() / f.unit, ball.eta));
}

BouncingBall::BouncingBall(const BallParameters& ball, std::string_view who)
    : Bouncing(ball, BallFormulas<Wide>(ball, last_impact(require_bouncing(ball, who)))) {
  problem_.system.mass = MatrixXd::Identity(1, 1);
  problem_.system.damping = problem_.system.stiffness = MatrixXd::Zero(1, 1);
  problem_.system.add_load = model::HarmonicLoad({{0, -ball.g, 0.0, 0.0}});
  problem_.contacts = {{VectorXd::Ones(1), 0.0, ball.eta}};
  problem_.start = {0.0, VectorXd::Constant(1, ball.h0), VectorXd::Constant(1, ball.v0)};
  problem_.end = ball.end;
  constexpr long long most = 40000;
  Wide power = 1.0;
  for (long long k = 0; k <= std::min(formulas_.last_flight(), most); ++k) {
    if (k > formulas_.last) power = 0.0;
    const Wide t = k == 0 ? Wide(0.0) : formulas_.first + formulas_.unit * (Wide(ball.eta) - power);
    const auto begin = numerics::narrowed(t);
    if (begin.nearest() > end()) break;
    starts_.push_back({begin, numerics::narrowed(t - Wide(numerics::WideReal(begin.value), 0)),
                       k == 0 ? Bounded(ball.v0) : numerics::narrowed(power * formulas_.V)});
    power = power * Wide(ball.eta);
  }
}

auto BouncingBall::instant(long long k) const -> Bounded {
  return k < std::ssize(starts_) ? starts_[std::size_t(k)].t : Bouncing::instant(k);
}

auto BouncingBall::since(long long k, double t) const -> Bounded {
  if (k >= std::ssize(starts_)) return Bouncing::since(k, t);
  const auto& start = starts_[std::size_t(k)];
  return Bounded(t) - Bounded(start.t.value, 0) - start.more;
}

auto BouncingBall::state(long long k, const Bounded& s) const -> States {
  if (k >= std::ssize(starts_)) return Bouncing::state(k, s);
  const double h0 = k == 0 ? formulas_.ball.h0 : 0.0,
               a = k <= formulas_.last ? -formulas_.ball.g : 0.0;
  const auto& v = starts_[std::size_t(k)].v;
  return {{{Bounded(h0) + s * (v + Bounded(0.5 * a) * s), v + Bounded(a) * s, a}}};
}

auto BouncingBall::limits(long long k) const -> Limits {
  if (k >= std::ssize(starts_)) return Bouncing::limits(k);
  const auto& ball = formulas_.ball;
  const auto speed = k == 1 ? numerics::narrowed(formulas_.V) : starts_[std::size_t(k - 1)].v;
  Limits limit;
  limit.before[0] = {0.0, -speed, -ball.g};
  limit.after = state(formulas_.following(k), 0.0);
  limit.impulse = (Bounded(1.0) + Bounded(ball.eta)) * speed;
  return limit;
}

long long BouncingBall::near_flight(double t) const {
  const auto next = std::ranges::upper_bound(starts_, static_cast<long double>(t), {},
                                             [](const Start& start) { return start.t.value; });
  return next == starts_.end() ? Bouncing::near_flight(t) : next - starts_.begin() - 1;
}

model::Kinematics BouncingBall::envelope(double t) const {
  model::require_inside("motion", t, end());
  const double V = speed(), g = formulas_.ball.g;
  const auto size = [](double x) { return VectorXd::Constant(1, x); };
  return {size(V * V / (2.0 * g)), size(V), size(g)};
}

}  // namespace clackers::exact
