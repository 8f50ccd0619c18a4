#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::tables {

/// For tests: masses i = 1, 2, ... with u_i = i t, velocity +i in flights of even number and -i in
/// odd ones (no physics), and impacts at given times. An impact counts as passed only where its
/// time is strictly exceeded if `late`, so that both manners of counting can be tried.
class CountedMotion : public model::Motion {
 public:
  CountedMotion(int dof, double end, std::vector<double> impacts, bool late = false)
      : dof_(dof), end_(end), impacts_(std::move(impacts)), late_(late) {}

  int dof() const override { return dof_; }
  double end() const override { return end_; }

  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override {
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!(times[k] >= 0.0 && times[k] <= end_)) throw InputError("toy: outside", "time-outside");
      const auto flight = side == model::Side::left
                              ? std::ranges::lower_bound(impacts_, times[k]) - impacts_.begin()
                              : std::ranges::upper_bound(impacts_, times[k]) - impacts_.begin();
      for (int i = 0; i < dof_; ++i) {
        const auto at = k * static_cast<std::size_t>(dof_) + static_cast<std::size_t>(i);
        out.u[at] = (i + 1) * times[k];
        out.v[at] = flight % 2 == 0 ? i + 1 : -(i + 1);
        if (!out.a.empty()) out.a[at] = 100.0 * (i + 1) + times[k];
      }
    }
  }
  model::Kinematics envelope(double) const override {
    model::Kinematics values{Eigen::VectorXd(dof_), Eigen::VectorXd(dof_), Eigen::VectorXd(dof_)};
    for (int i = 0; i < dof_; ++i) values.u[i] = values.v[i] = values.a[i] = 4.0 * (i + 1);
    return values;
  }
  model::Kinematics error_bound(double t) const override { return envelope(t); }
  long long impact_count(double t) const override {
    const bool strict = late_ && t < end_;
    return (strict ? std::ranges::lower_bound(impacts_, t)
                   : std::ranges::upper_bound(impacts_, t)) -
           impacts_.begin();
  }
  model::MotionImpact impact(long long index) const override {
    ++asked_;
    const double t = impacts_.at(static_cast<std::size_t>(index - 1));
    model::MotionImpact now;
    now.index = index;
    now.t = t;
    now.when = {t, t};
    now.before = at(t, model::Side::left);
    now.after = at(t, model::Side::right);
    now.impulse = 0.5 * double(index);
    now.energy_before = 3.0 * double(index);
    now.energy_after = 2.0 * double(index);
    return now;
  }
  long long asked() const { return asked_; }  ///< how often impact() was called

 private:
  int dof_;
  double end_;
  std::vector<double> impacts_;
  bool late_;
  mutable long long asked_ = 0;
};

}  // namespace clackers::tables
