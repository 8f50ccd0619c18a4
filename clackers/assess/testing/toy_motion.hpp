#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

// A motion simple enough to check by hand, for tests.
namespace clackers::assess {

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
    const Eigen::Vector2d one(1.0, 0.5);
    return {one, one, one};
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

}  // namespace clackers::assess
