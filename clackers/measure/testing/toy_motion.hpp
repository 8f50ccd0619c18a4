#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

// A motion simple enough to check by hand, and its histories, for tests.
namespace clackers::measure {

/// Two masses that strike each other at equilibrium for ever, undamped and elastic:
/// u1 = |cos t|, u2 = -u1 / 2, masses and stiffnesses 1 and 2, impacts at (k - 1/2) pi with
/// v1 = -1 before and +1 after. Energy (1 + 1/2) / 2 = 3/4. Impacts at other times may be given;
/// then only they are asked for, and the states mean nothing.
class ToyMotion : public model::Motion {
 public:
  explicit ToyMotion(double end = 20.0, std::vector<double> impacts = {})
      : end_(end), impacts_(std::move(impacts)) {
    if (impacts_.empty())
      for (double t = 0.5 * std::numbers::pi; t <= end; t += std::numbers::pi)
        impacts_.push_back(t);
  }

  int dof() const override { return 2; }
  double end() const override { return end_; }
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override {
    ++samples;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double t = times[i];
      if (!(t >= 0.0 && t <= end_)) throw InputError("toy: outside", "time-outside");
      long long k = 0;  // impacts passed
      for (const double impact : impacts_)
        k += impact < t || (impact == t && side == model::Side::right);
      const double sign = k % 2 == 0 ? 1.0 : -1.0;
      out.u[2 * i] = sign * std::cos(t);
      out.v[2 * i] = -sign * std::sin(t);
      if (!out.a.empty()) out.a[2 * i] = -out.u[2 * i];
      for (const auto& row : {out.u, out.v, out.a})
        if (!row.empty()) row[2 * i + 1] = -0.5 * row[2 * i];
    }
  }
  model::Kinematics envelope(double) const override {
    const Eigen::Vector2d size(1.0, 0.5);
    return {size, size, size};
  }
  model::Kinematics error_bound(double) const override {
    const Eigen::Vector2d bound(1e-16, 1e-16);
    return {bound, bound, bound};
  }
  long long impact_count(double t) const override {
    long long k = 0;
    for (const double impact : impacts_) k += impact <= t;
    return k;
  }
  model::MotionImpact impact(long long index) const override {
    if (index < 1 || index > std::ssize(impacts_))
      throw InputError("toy: no such impact", "beyond-last-impact");
    const double t = impacts_[std::size_t(index - 1)];
    model::MotionImpact found;
    found.index = index;
    found.t = t;
    found.when = {t, t};
    found.before = at(t, model::Side::left);
    found.after = at(t, model::Side::right);
    found.impulse = 2.0;  // what turns the velocity of mass 1 from -1 to +1
    found.energy_before = found.energy_after = 0.75;
    return found;
  }

  mutable int samples = 0;  ///< how often sample() was called

 private:
  double end_;
  std::vector<double> impacts_;
};

/// The problem whose motion that is.
inline model::ImpactProblem<> toy_problem(double end = 20.0) {
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector2d(1.0, 2.0).asDiagonal();
  problem.system.stiffness = problem.system.mass;
  problem.system.damping = Eigen::Matrix2d::Zero();
  problem.contacts.push_back({Eigen::Vector2d(1.0, -1.0), 0.0, 1.0});
  problem.start = {0.0, Eigen::Vector2d(1.0, -0.5), Eigen::Vector2d(0.0, 0.0)};
  problem.end = end;
  return problem;
}

/// The motion itself at these times, accelerations and an empty list of impacts included; of two
/// equal times the first is the left limit.
inline model::Trajectory history_of(const model::Motion& reference, std::vector<double> times) {
  model::Trajectory history;
  history.dof = reference.dof();
  history.t = std::move(times);
  history.impacts.emplace();
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    const bool left = i + 1 < history.t.size() && history.t[i + 1] == history.t[i];
    const auto now = reference.at(history.t[i], left ? model::Side::left : model::Side::right);
    history.u.insert(history.u.end(), now.u.begin(), now.u.end());
    history.v.insert(history.v.end(), now.v.begin(), now.v.end());
    history.a.insert(history.a.end(), now.a.begin(), now.a.end());
  }
  return history;
}

/// What is wrong with a history of ToyMotion.
struct ToyFlaws {
  double end = 10.0;         ///< [s]
  double h = 0.01;           ///< between rows [s]
  double delay = 0.0;        ///< of every impact: each flight goes on through it [s]
  double smear = 0.0;        ///< time that a velocity takes from one limit to the other [s]
  double stretch = 1.0;      ///< of time: periods are this much longer
  bool reports = true;       ///< impacts are reported, with both limits
  bool knows_limits = true;  ///< false: reported with their times alone
};

/// Flight k of ToyMotion at phase x, for any x.
inline double toy_u(int k, double x) { return (k % 2 == 0 ? 1.0 : -1.0) * std::cos(x); }
inline double toy_v(int k, double x) { return (k % 2 == 0 ? -1.0 : 1.0) * std::sin(x); }

inline model::Trajectory toy_history(const ToyFlaws& flaws) {
  model::Trajectory made;
  made.dof = 2;
  if (flaws.reports) made.impacts.emplace();
  const double pi = std::numbers::pi;
  const auto instant = [&](int k) { return (k + 0.5) * pi * flaws.stretch + flaws.delay; };
  int flight = 0;
  const auto steps = std::lround(flaws.end / flaws.h);
  for (long i = 0; i <= steps; ++i) {
    const double t = i == steps ? flaws.end : double(i) * flaws.h;
    for (; instant(flight) <= t; ++flight) {
      const double at = instant(flight), x = at / flaws.stretch;
      if (!flaws.reports) continue;
      model::Impact impact{
          .t = at, .contact = 0, .u = {}, .v_before = {}, .v_after = {}, .impulse = 2.0};
      if (flaws.knows_limits) {
        impact.u = {toy_u(flight, x), -0.5 * toy_u(flight, x)};
        impact.v_before = {toy_v(flight, x), -0.5 * toy_v(flight, x)};
        impact.v_after = {toy_v(flight + 1, x), -0.5 * toy_v(flight + 1, x)};
      }
      made.impacts->push_back(impact);
    }
    const double x = t / flaws.stretch;
    double u = toy_u(flight, x), v = toy_v(flight, x) / flaws.stretch;
    const double late = flight > 0 ? t - instant(flight - 1) : flaws.smear;
    if (late < flaws.smear) v *= 2.0 * late / flaws.smear - 1.0;
    made.t.push_back(t);
    made.u.insert(made.u.end(), {u, -0.5 * u});
    made.v.insert(made.v.end(), {v, -0.5 * v});
  }
  return made;
}

}  // namespace clackers::measure
