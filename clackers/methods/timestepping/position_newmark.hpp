#pragma once

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "clackers/methods/timestepping/stepping_scheme.hpp"

namespace clackers::methods {

/// How contact forces at the end of the step enter it: averaged with those of its start, as all other
/// forces are, or alone (Newmark's beta and gamma of the contact 1/2 and 1).
enum class ContactForce { averaged, at_the_end };

/// What schemes with a gap kept at the end of the step claim of impacts.
inline Facts position_newmark_facts(std::string name, Claim through_impacts) {
  return {.name = std::move(name),
          .smooth_order = 2.0,
          .stability_limit = std::numeric_limits<double>::infinity(),
          .radius_at_infinity = 1.0,
          .through_impacts = std::move(through_impacts)};
}

inline std::optional<Objection> position_newmark_objection(const std::string& who,
                                                           const model::ImpactProblem<>& problem) {
  for (const auto& contact : problem.contacts)
    if (contact.restitution != 1.0)
      return Objection{
          fmt::format("{} with eta = {}: it has no law of restitution, and is run with "
                      "eta = 1 only, which it misses. Use moreau-jean.",
                      who, contact.restitution),
          "law-needs-restitution"};
  return std::nullopt;
}

/// Newmark's average acceleration with contact forces L at the end of the step that keep the gap there:
///
///     M a1 + C v1 + K u1 + p(u1, v1) = f(t1) + B^T L,   0 <= g(u1) _|_ L >= 0
///     u1 = u0 + h/2 (v0 + v1),   v1 = v0 + h/2 (a0 + a1)
///
/// or, at the end alone, M a1 + C v1 + K u1 + p(u1, v1) = f(t1) and v1 = v0 + h/2 (a0 + a1) + h M^-1 B^T L.
/// In both g(u1) >= 0 is b.v1 >= -b.v0 - 2 g(u0) / h.
template <int Dof>
class PositionNewmark : public SteppingScheme<Dof> {
 protected:
  using Base = SteppingScheme<Dof>;
  using Base::before_, Base::contacts_, Base::equation_, Base::jump_, Base::response_;
  using Base::x0_, Base::x1_, Base::y_;

  PositionNewmark(std::string_view who, model::ImpactProblem<Dof> problem, const StepPlan& plan,
                  ContactForce force = ContactForce::averaged)
      : Base(std::move(problem), plan),
        who_(who),
        is_averaged_(force == ContactForce::averaged),
        a0_(x0_.v),
        a1_(a0_),
        u_(a0_),
        v_(a0_),
        shift_(model::Vector<Dof>::Zero(a0_.size())) {
    prepare(plan.h);
  }

 private:
  static constexpr auto weights(double h) {
    return typename MotionEquation<Dof>::Weights{1.0, 0.5 * h, 0.25 * h * h};
  }

  void prepare(double h) final {
    this->respond(who_, h, weights(h));
    if (!is_averaged_) return;
    response_.velocity *= 0.5;
    response_.delassus *= 0.5;
  }

  void start() final { equation_.accelerate(x0_.t, x0_.u, x0_.v, a0_); }

  void predict(double h) final {
    before_ = x0_.v;
    u_ = x0_.u + h * x0_.v + 0.25 * h * h * a0_;
    v_ = x0_.v + 0.5 * h * a0_;
  }

  void complete(double h) final {
    x1_.u = u_;
    x1_.v = v_;
    if (is_averaged_) {
      shift_ = jump_ / -h;
    } else {
      x1_.u += 0.5 * h * jump_;
      x1_.v += jump_;
    }
    a1_ = a0_;
    equation_.solve({x1_.t}, weights(h), x1_.u, x1_.v, a1_, &shift_);
    x1_.u += 0.25 * h * h * a1_;
    x1_.v += 0.5 * h * a1_;
    y_ = x1_.v;
  }

  double least_rate(std::size_t j, double h) const final {
    return -contacts_.gap_rate(j, x0_.v) - 2.0 * contacts_.gap(j, x0_.u) / h;
  }

  void accept() final { a0_ = a1_; }

  std::string who_;
  bool is_averaged_;
  model::Vector<Dof> a0_, a1_, u_, v_, shift_;
};

}  // namespace clackers::methods
