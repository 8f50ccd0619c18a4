#pragma once

#include "clackers/methods/recorder.hpp"
#include "clackers/methods/step_plan.hpp"
#include "clackers/model/system.hpp"

namespace clackers::methods {

/// The plain loop of treatments that look at whole steps only. `after_step(before, now,
/// is_stepped)` may change `now`; it returns false to end the run, and restarts the stepper itself
/// where it must. `is_stepped` is false for a shorter last step, which is a partial one. Returns
/// the number of steps.
template <class Stepper, int Dof, class AfterStep>
long long time_loop(Stepper& stepper, const StepPlan& plan, const model::State<Dof>& start,
                    Recorder<Dof>& out, AfterStep&& after_step) {
  model::State<Dof> now = start, before = start;
  stepper.restart(now);
  if (!out.append(now)) return 0;
  for (long long k = 1; k <= plan.total; ++k) {
    const double t1 = plan.time(k);
    before = now;
    const bool is_stepped = k <= plan.whole;
    if (is_stepped)
      stepper.step(now);
    else
      now = stepper.partial(before, t1 - before.t);
    now.t = t1;  // counted over the whole run, whatever the stepper was restarted from
    if (stepper.failed()) {
      out.fail_step(t1, stepper.failure());
      return k - 1;
    }
    if (!after_step(before, now, is_stepped) || !out.append(now)) return k;
  }
  return plan.total;
}

}  // namespace clackers::methods
