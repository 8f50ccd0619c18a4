#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/flights/piecewise_builder.hpp"
#include "clackers/exact/flights/simultaneity.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

auto PiecewiseMotion::Builder::closing_first(const std::vector<Closing>& closings) const
    -> std::vector<Closing> {
  std::vector<Closing> together{closings.front()};
  const Closing& first = closings.front();
  for (const Closing& next : std::span(closings).subspan(1)) {
    if (next.first() > first.last()) continue;
    const auto acts = std::ranges::find_if(
        together, [&](const Closing& other) { return act_on_each_other(other, next); });
    const bool is_same = next.s - first.s <= 4.0 * epsilon * (flight().t + first.s);
    if (acts != together.end() && !close_together(problem_, acts->contact, next.contact))
      throw InputError(
          fmt::format("{}: contacts {} and {} close {:.3g} s apart near t = {:.9g} s, the error of "
                      "that is {:.3g} s, and the first impact changes the second; allowed: impacts "
                      "whose order is certain, or that are simultaneous by a symmetry of the "
                      "problem. Change a gap by more, or end the run earlier.",
                      m_.who_, std::min(acts->contact, next.contact) + 1,
                      std::max(acts->contact, next.contact) + 1, next.s - acts->s,
                      flight().t + first.s, acts->time_error + next.time_error),
          "not-admissible");
    if (acts != together.end() || is_same) together.push_back(next);
  }
  std::ranges::sort(together, {}, &Closing::contact);
  return together;
}

bool PiecewiseMotion::Builder::act_on_each_other(const Closing& a, const Closing& b) const {
  const double coupling = std::abs(delassus(a.contact, b.contact));
  return coupling > 8.0 * double(m_.dof()) * epsilon *
                        std::sqrt(delassus(a.contact, a.contact) * delassus(b.contact, b.contact));
}

void PiecewiseMotion::Builder::collide(const std::vector<Closing>& closings) {
  const double s = closings.front().s, t = flight().t + s;
  MatrixXd covariance = m_.covariance_after(flight(), s);
  VectorXd z = m_.total(flight(), t);
  const VectorXd v_before = modes().derivative(1) * z, a_before = modes().acceleration(z, t);
  std::vector<std::size_t> closed;
  // Terms of second order over those of first order.
  double nonlinear = 0.0;
  for (const auto& closing : closings) {
    closed.push_back(closing.contact);
    const auto gap = gap_ahead(closing.contact, s);
    const double delay = closing.gap_error / gap.slope;
    nonlinear +=
        std::abs(delay / gap.slope) * (std::abs(gap.second) + gap.third_bound * std::abs(delay));
  }
  const auto impulses = solve(closed, z, t);

  const auto n = m_.dof();
  MatrixXd saltation = MatrixXd::Identity(2 * n, 2 * n);
  VectorXd time_error = VectorXd::Zero(2 * n);
  add_saltation(closed, impulses, z, a_before, saltation, time_error);
  time_error *= 4.0 * epsilon * std::max(t, s);
  covariance = saltation * covariance * saltation.transpose();
  covariance *= std::pow(1.0 + 4.0 * nonlinear, 2);
  covariance.diagonal() += time_error.cwiseAbs2();

  for (const auto& closing : closings)
    m_.hits_.push_back({t, closing.time_error, impulses[Index(closing.contact)],
                        int(closing.contact), m_.flights_.size() - 1});
  for (const auto i : closed) z += row(i).impulse * impulses[Index(i)];
  begin(flight().regime, t, z, std::move(covariance));
  is_closed_.assign(springs(), false);
  for (const auto i : closed) is_closed_[i] = true;
  if (at_rest(modes().derivative(1) * z, v_before, z)) {
    m_.flights_.back().free.setZero();
    rests_ = true;
  }
}

bool PiecewiseMotion::Builder::at_rest(const VectorXd& after, const VectorXd& before,
                                       const VectorXd& z) const {
  const double small = touching_share * before.cwiseAbs().maxCoeff();
  const VectorXd u = modes().derivative(0) * z;
  return modes().forces().empty() && stiffnesses_.empty() && after.cwiseAbs().maxCoeff() <= small &&
         u.cwiseAbs().maxCoeff() * modes().system().fastest() <= small;
}

VectorXd PiecewiseMotion::Builder::solve(const std::vector<std::size_t>& closed, const VectorXd& z,
                                         double t) {
  const auto count = Index(springs());
  MatrixXd w = MatrixXd::Zero(count, count);
  VectorXd q = VectorXd::Zero(count), impulses = VectorXd::Zero(count);
  for (const auto i : closed) {
    q[Index(i)] = (1.0 + problem_.contacts[i].restitution) * row(i).rate().dot(z);
    for (const auto j : closed) w(Index(i), Index(j)) = delassus(i, j);
  }
  numerics::PrincipalCholesky factors(closed.size());
  const auto independent = factors.compute(w, closed);
  if (independent < closed.size())
    throw InputError(
        fmt::format("{}: contact {} and others close together at t = {:.9g} s, and its direction "
                    "depends linearly on theirs; allowed: contacts whose impulses are unique. "
                    "Leave one out.",
                    m_.who_, closed[independent] + 1, t),
        "redundant-contacts");
  if (!lcp_.solve(w, q, closed, impulses))
    throw InputError(fmt::format("{}: the impulses of {} contacts at t = {:.9g} s were not found.",
                                 m_.who_, closed.size(), t),
                     "complementarity-failed");
  return impulses;
}

void PiecewiseMotion::Builder::add_saltation(const std::vector<std::size_t>& closed,
                                             const VectorXd& impulses, const VectorXd& z,
                                             const VectorXd& a_before, MatrixXd& saltation,
                                             VectorXd& time_error) const {
  std::vector<std::size_t> active;
  for (const auto i : closed)
    if (impulses[Index(i)] > 0.0) active.push_back(i);
  const auto count = Index(active.size());
  MatrixXd law(count, count), rates(count, z.size());
  VectorXd pressed(count);
  for (Index c = 0; c < count; ++c) {
    const auto i = active[std::size_t(c)];
    for (Index d = 0; d < count; ++d) law(c, d) = delassus(i, active[std::size_t(d)]);
    rates.row(c) = row(i).rate().transpose();
    pressed[c] = problem_.contacts[i].direction.dot(a_before);
  }
  law = numerics::inverse(law);
  for (Index c = 0; c < count; ++c)
    law.col(c) *= 1.0 + problem_.contacts[active[std::size_t(c)]].restitution;
  rates = law * rates;  // -impulses by z
  pressed = law * pressed;
  for (Index c = 0; c < count; ++c) {
    const auto& of_contact = row(active[std::size_t(c)]);
    saltation -= of_contact.impulse * rates.row(c);
    const VectorXd jump =
        impulses[Index(active[std::size_t(c)])] * modes().rate(of_contact.impulse) +
        pressed[c] * of_contact.impulse;
    saltation += jump * (of_contact.gap().transpose() / of_contact.rate().dot(z));
    time_error += jump.cwiseAbs();
  }
}

}  // namespace clackers::exact
