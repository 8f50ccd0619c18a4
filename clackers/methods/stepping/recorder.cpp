#include "clackers/methods/stepping/recorder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace clackers::methods {

template <int Dof>
bool Recorder<Dof>::impact(const State& after, int contact, const Vector& v_before,
                           double impulse) {
  if (!flush()) return false;
  if (sink_->take(model::ReportedImpact{after.t, contact, span(after.u), span(v_before),
                                        span(after.v), impulse}))
    return true;
  stop();
  return false;
}

template <int Dof>
bool Recorder<Dof>::fail(Code reason, double t, std::string_view what) {
  if (!flush()) return false;
  outcome_.finished = false;
  outcome_.reason = reason;
  outcome_.detail = fmt::format("t = {} s: {}", t, what);
  return false;
}

template <int Dof>
bool Recorder<Dof>::fail_diverged(double t) {
  return fail("diverged", t, "the motion is no longer finite");
}

template <int Dof>
bool Recorder<Dof>::fail_step(double t, Code failure) {
  if (failure == Code("newton-failed"))
    return fail(failure, t, "Newton's iteration found no solution of the step");
  if (failure == Code("step-too-small"))
    return fail(failure, t, "the tolerance asks for steps that rounding of the time hides");
  return fail(failure, t,
              "the effective mass matrix of a part of the step is not positive definite");
}

template <int Dof>
bool Recorder<Dof>::is_finite(std::size_t k) const {
  for (std::size_t i = k * size(); i < (k + 1) * size(); ++i)
    if (!std::isfinite(u_[i]) || !std::isfinite(v_[i])) return false;
  return true;
}

template <int Dof>
bool Recorder<Dof>::flush() {
  if (!outcome_.finished) return false;
  if (count_ == 0) return true;
  std::size_t good = count_;
  // A state that is not finite is never followed by a finite one, so the last one is enough.
  if (!is_finite(count_ - 1))
    for (good = 0; is_finite(good);) ++good;
  const double bad_time = good < count_ ? t_[good] : 0.0;
  const bool diverged = good < count_;
  count_ = 0;
  const std::size_t entries = good * size();
  if (good > 0 && !sink_->take(model::SampleBlock{static_cast<int>(size()),
                                                  {t_.data(), good},
                                                  {u_.data(), entries},
                                                  {v_.data(), entries}})) {
    stop();
    return false;
  }
  return !diverged || fail_diverged(bad_time);
}

template class Recorder<1>;
template class Recorder<2>;
template class Recorder<model::any_dof>;

}  // namespace clackers::methods
