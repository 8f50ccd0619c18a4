#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "clackers/methods/integrator.hpp"
#include "clackers/methods/stepping/recorder.hpp"
#include "clackers/methods/stepping/step_plan.hpp"

namespace clackers::methods {

/// What a contact treatment has done with a step.
enum class Handled {
  ended,      ///< the run
  changed,    ///< the end of the step; the stepper has been started there
  unchanged,  ///< the step is made again; the stepper is at its beginning
  shortened,  ///< as changed, and the step ends earlier, at an event: `now` is no state of output
};

/// The work of a run with these steppers.
inline model::Work work_of(long long steps, long long searches, const auto&... steppers) {
  model::Work work;
  work.steps = steps;
  work.event_searches = searches;
  (steppers.add_work(work), ...);
  return work;
}

/// The loop over the steps of a run, in blocks. A contact treatment has
///
///     stepper()                  the stepper in use
///     is_open()                  whether a step is quiet where the cubics of all gaps stay open
///     is_quiet(before, now)      whether nothing happens between the two ends of a step
///     handle(before, now, out)   otherwise, what happens: a Handled; `now` may be changed
///
/// and may have pass(count, at), which is called after `count` quiet steps with a function of the
/// states at(0), at(1), ... before each. When handle() is called the stepper is at `before`.
template <int Dof>
class TimeLoop {
 public:
  using State = model::State<Dof>;

  TimeLoop(const StepPlan& plan, const model::ImpactProblem<Dof>& problem)
      : plan_(plan), gaps_(problem.contacts), states_(AnyStepper<Dof>::most_steps + 1) {
    for (auto& state : states_) state.u = state.v = model::Vector<Dof>::Zero(problem.dof());
    now_ = before_ = states_[0];
  }

  /// From `start`, where the stepper has been started. Returns the number of steps.
  long long run(auto& treatment, const State& start, Recorder<Dof>& out) {
    states_[0] = start;
    if (!out.append(start)) return 0;
    std::size_t length = shortest;
    long long k = 0;
    while (states_[0].t != plan_.end) {
      if (treatment.is_open()) {
        const long long last = k;
        if (!fly(treatment, k, out)) return k;
        if (k > last) length = 1;
        if (states_[0].t == plan_.end) break;
      }
      if (k == plan_.whole) return k + (last_step(treatment, out) ? 1 : 0);
      length = std::min(
          {length, AnyStepper<Dof>::most_steps, static_cast<std::size_t>(plan_.whole - k)});
      const std::span<State> block{states_.data(), length + 1};
      auto& stepper = treatment.stepper();
      const std::size_t made = stepper.advance(k, block);
      const std::size_t sound = made - (stepper.failed() ? 1 : 0);
      std::size_t i = 0;
      bool goes_on = true;
      while (i < sound && goes_on && treatment.is_quiet(states_[i], states_[i + 1]))
        goes_on = out.append(states_[++i]);
      k += static_cast<long long>(i);
      if (!goes_on) {
        if (i < made) stepper.rewind(k - static_cast<long long>(i), block, i - 1);
        return k;
      }
      if (i == made) {
        states_[0] = states_[made];
        length = 2 * made;
        continue;
      }
      stepper.rewind(k - static_cast<long long>(i), block, i);
      now_ = states_[i + 1];
      if (stepper.failed()) {
        out.fail_step(now_.t, stepper.failure());
        return k;
      }
      const Handled handled = treatment.handle(states_[i], now_, out);
      if (handled == Handled::ended) return k;
      if (handled == Handled::unchanged) {
        states_[0] = states_[i];
        stepper.advance(k, {states_.data(), 2});
        now_ = states_[1];
        if (stepper.failed()) {
          out.fail_step(now_.t, stepper.failure());
          return k;
        }
      }
      ++k;
      const bool is_output = handled != Handled::shortened || now_.t == plan_.end;
      if (is_output && !out.append(now_)) return k;
      states_[0] = now_;
      length = shortest;
    }
    return k;
  }

 private:
  // After an event: what is made beyond the next one is lost.
  static constexpr std::size_t shortest = 8;

  // Steps by powers of the step matrix, from states_[0] at step k up to where a gap comes near to 0.
  // False: the run ends.
  bool fly(auto& treatment, long long& k, Recorder<Dof>& out) {
    while (true) {
      before_ = states_[0];
      const auto most = std::min(static_cast<long long>(out.room()), plan_.whole - k);
      const std::size_t made = treatment.stepper().fly(
          states_[0], gaps_, static_cast<std::size_t>(most), out.u(), out.v());
      if (made == 0) return true;
      for (std::size_t i = 0; i < made; ++i)
        out.t()[i] = plan_.start + double(k + 1 + static_cast<long long>(i)) * plan_.h;
      k += static_cast<long long>(made);
      states_[0].t = out.t()[made - 1] = plan_.time(k);
      if constexpr (requires { treatment.pass(made, [&](std::size_t) { return before_; }); })
        treatment.pass(made, [&](std::size_t i) -> const State& {
          if (i == 0) return before_;
          const auto n = before_.u.size();
          using Rows = Eigen::Map<const model::Vector<Dof>>;
          now_.t = out.t()[i - 1];
          now_.u = Rows(out.u() + (Eigen::Index(i) - 1) * n, n);
          now_.v = Rows(out.v() + (Eigen::Index(i) - 1) * n, n);
          return now_;
        });
      if (!out.append(made)) return false;
    }
  }

  bool last_step(auto& treatment, Recorder<Dof>& out) {
    const State& before = states_[0];
    if (!make_last_step(treatment.stepper(), out)) return false;
    if (!treatment.is_quiet(before, now_)) {
      const Handled handled = treatment.handle(before, now_, out);
      if (handled == Handled::ended) return false;
      if (handled == Handled::unchanged && !make_last_step(treatment.stepper(), out)) return false;
    }
    out.append(now_);
    return true;
  }

  bool make_last_step(AnyStepper<Dof>& stepper, Recorder<Dof>& out) {
    now_ = stepper.partial(states_[0], plan_.end - states_[0].t);
    now_.t = plan_.end;
    return !stepper.failed() || out.fail_step(plan_.end, stepper.failure());
  }

  StepPlan plan_;
  Gaps gaps_;
  std::vector<State> states_;
  State now_, before_;
};

}  // namespace clackers::methods
