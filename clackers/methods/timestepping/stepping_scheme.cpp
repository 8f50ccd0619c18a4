#include "clackers/methods/timestepping/stepping_scheme.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clackers/base/constants.hpp"

namespace clackers::methods {

template <int Dof>
SteppingScheme<Dof>::SteppingScheme(model::ImpactProblem<Dof> problem, const StepPlan& plan,
                                    int most_impact_steps)
    : problem_(std::move(problem)),
      equation_(problem_.system),
      contacts_(problem_),
      response_(contacts_.response()),
      x0_(problem_.start),
      x1_(x0_),
      before_(x0_.v),
      y_(x0_.v),
      jump_(x0_.v),
      impulses_(Eigen::VectorXd::Zero(Eigen::Index(contacts_.size()))),
      change_(impulses_),
      plan_(plan),
      most_impact_steps_(most_impact_steps),
      least_(contacts_.size(), 0.0),
      unfinished_(contacts_.size(), {0, 0.0, x0_.v, x0_}),
      q_(impulses_),
      frictions_(friction_rows(problem_)),
      response_to_friction_(frictions_.response()),
      friction_(frictions_.no_impulses()),
      last_friction_(friction_),
      slip_(friction_),
      sticks_(frictions_.size(), true),
      holds_(sticks_) {
  rows_.reserve(contacts_.size());
}

template <int Dof>
void SteppingScheme<Dof>::advance(Recorder<Dof>& out) {
  equation_.set_tally({});
  steps_ = 0;
  failure_.reset();
  for (auto& impact : unfinished_) impact.steps = 0;
  sticks_.assign(sticks_.size(), true);
  friction_.setZero();
  x0_ = problem_.start;
  start();
  if (!out.append(x0_)) return;
  for (long long k = 1; k <= plan_.total; ++k) {
    const double t1 = plan_.time(k);
    const double h = k <= plan_.whole ? plan_.h : t1 - x0_.t;
    if (k > plan_.whole) prepare(h);  // a shorter last step
    ++steps_;
    const bool goes_on = step(h, t1, out);
    x0_ = x1_;
    if (!goes_on || !out.append(x0_)) break;
  }
  if (plan_.total > plan_.whole) prepare(plan_.h);
}

template <int Dof>
model::Work SteppingScheme<Dof>::work() const {
  model::Work work;
  work.steps = steps_;
  equation_.add_work(work);
  return work;
}

template <int Dof>
void SteppingScheme<Dof>::respond(std::string_view who, double h,
                                  const typename Equation::Weights& weights) {
  equation_.drop_all();
  const auto& effective = equation_.factorized(weights);
  require_definite(who, h, equation_.failed());
  contacts_.respond(effective, response_);
  frictions_.respond(effective, response_to_friction_);
}

template <int Dof>
bool SteppingScheme<Dof>::step(double h, double t1, Recorder<Dof>& out) {
  x1_.t = t1;
  predict(h);
  if (!find_impulses(h, t1, out)) return false;
  accept();
  return report(out);
}

template <int Dof>
bool SteppingScheme<Dof>::find_impulses(double h, double t1, Recorder<Dof>& out) {
  rows_.clear();
  impulses_.setZero();
  jump_.setZero();
  if (failure_) return out.fail(failure_->code, t1, failure_->sentence);
  friction_.setZero();
  complete(h);
  for (std::size_t j = 0; j < contacts_.size(); ++j) least_[j] = least_rate(j, h);
  // A motion that is not finite is the recorder's to report.
  for (int i = 0; !equation_.failed() && y_.allFinite(); ++i) {
    take_violated();
    if (rows_.empty() && frictions_.size() == 0) return true;
    change_ = impulses_;
    if (!rows_.empty()) improve_impulses();
    if (failure_) return out.fail(failure_->code, t1, failure_->sentence);
    change_ = impulses_ - change_;
    const bool is_friction_settled = frictions_.size() == 0 || improve_friction(h);
    if (is_settled(h) && is_friction_settled) break;
    if (i == most_iterations())
      return out.fail("complementarity-failed", t1,
                      "the iteration for the impulses at the contacts does not end");
    jump_.noalias() = contacts_.response().velocity * impulses_;
    if (frictions_.size() > 0) jump_.noalias() += frictions_.response().velocity * friction_;
    complete(h);
  }
  if (equation_.failed()) return out.fail_step(t1, equation_.failure());
  for (std::size_t j = 0; j < frictions_.size(); ++j)
    sticks_[j] = holds_[j] || std::abs(friction_[to_index(j)]) < h * problem_.frictions[j].kinetic;
  return true;
}

// Projected iteration of Gauss and Seidel around the sliding speeds of y_, changed by `change_`; the
// response is symmetric and positive definite. A row that sticks and reaches its limit slides; rows of
// contacts have one limit. True where the last iterate was the solution.
template <int Dof>
bool SteppingScheme<Dof>::improve_friction(double h) {
  last_friction_ = friction_;
  const auto& w = response_to_friction_.delassus;
  slip_.noalias() = -(w * friction_);
  jump_.noalias() = response_.velocity * change_;
  jump_ += y_;
  for (std::size_t j = 0; j < frictions_.size(); ++j)
    slip_[to_index(j)] += problem_.frictions[j].sliding_speed(jump_);
  holds_ = sticks_;
  for (bool changes = true; changes;) {
    changes = false;
    double moved = 0.0;
    for (int sweep = 0; sweep < 1000; ++sweep) {
      moved = 0.0;
      for (std::size_t j = 0; j < frictions_.size(); ++j) {
        const auto i = to_index(j);
        const auto& f = problem_.frictions[j];
        const double most = f.contact ? f.limit * impulses_[to_index(*f.contact)]
                                      : h * (holds_[j] ? f.limit : f.kinetic);
        const double free = slip_[i] + w.row(i).dot(friction_) - w(i, i) * friction_[i];
        const double now = std::clamp(-free / w(i, i), -most, most);
        moved = std::max(moved, std::abs(now - friction_[i]) / std::max(most, 1e-300));
        friction_[i] = now;
      }
      if (moved <= epsilon) break;
    }
    for (std::size_t j = 0; j < frictions_.size(); ++j) {
      const auto& f = problem_.frictions[j];
      if (!holds_[j] || std::abs(friction_[to_index(j)]) < h * f.limit) continue;
      holds_[j] = false;
      changes = true;
    }
  }
  const double size =
      std::max(last_friction_.cwiseAbs().maxCoeff(), friction_.cwiseAbs().maxCoeff());
  return (friction_ - last_friction_).cwiseAbs().maxCoeff() <= 0x1p-40 * size;
}

// Adds all contacts below their least rate to rows_.
template <int Dof>
void SteppingScheme<Dof>::take_violated() {
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    const auto at = std::lower_bound(rows_.begin(), rows_.end(), j);
    if ((at == rows_.end() || *at != j) && excess(j) < 0.0) rows_.insert(at, j);
  }
}

template <int Dof>
void SteppingScheme<Dof>::improve_impulses() {
  q_.noalias() = -(response_.delassus * impulses_);
  for (const auto j : rows_) q_[Eigen::Index(j)] += excess(j);
  failure_ = contacts_.solve(response_, rows_, q_, impulses_);
}

// Rates are sums of a few products of the velocities and the responses, each with an error of some
// units in the last place; 2^-40 leaves room for a matrix of condition 1e3.
template <int Dof>
bool SteppingScheme<Dof>::is_settled(double) const {
  return std::ranges::all_of(rows_, [this](std::size_t j) {
    const auto i = Eigen::Index(j);
    const double own = response_.delassus(i, i);
    const double rate = contacts_.row(j).cwiseAbs().dot(y_.cwiseAbs() + before_.cwiseAbs()) +
                        std::abs(least_[j]) + own * impulses_[i];
    return own * std::abs(change_[i]) <= 0x1p-40 * rate;
  });
}

template <int Dof>
bool SteppingScheme<Dof>::report(Recorder<Dof>& out) {
  const auto give = [&](std::size_t j) {
    auto& impact = unfinished_[j];
    impact.steps = 0;
    return out.impact(impact.after, static_cast<int>(j), impact.before, impact.impulse);
  };
  // Those that ended with the step before are the earlier ones.
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    if (unfinished_[j].steps == 2 && !(impulses_[Eigen::Index(j)] > 0.0) && !give(j)) return false;
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    const double impulse = impulses_[Eigen::Index(j)];
    auto& impact = unfinished_[j];
    if (impact.steps == 0) {
      if (!(impulse > 0.0)) continue;
      impact.before = before_;
      impact.impulse = 0.0;
    }
    ++impact.steps;
    impact.impulse += impulse;
    impact.after = x1_;
    impact.after.v = y_;
    const bool may_go_on =
        impact.steps < most_impact_steps_ && (impact.steps == 1 || impulse > 0.0);
    if (!(may_go_on && x1_.t < plan_.end) && !give(j)) return false;
  }
  return true;
}

template class SteppingScheme<1>;
template class SteppingScheme<2>;
template class SteppingScheme<model::any_dof>;

}  // namespace clackers::methods
