// A piecewise motion goes from impact to impact.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/event_driven/piecewise_motion.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/lcp.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using numerics::FirstRoot;

namespace {

constexpr int most_search_steps = 1000000;
constexpr std::size_t most_flights = 100000;
constexpr double most_bytes = 2e9;
/// Speeds below this share of their sizes are those of masses that stay together.
constexpr double touching_share = 1e-12;

}  // namespace

class PiecewiseMotion::Builder {
 public:
  Builder(const model::ImpactProblem<>& problem, PiecewiseMotion& motion)
      : problem_(problem), m_(motion), lcp_(problem.contacts.size()) {}

  void build() {
    for (const auto& contact : problem_.contacts) {
      Row row{MatrixXd(2 * m_.dof(), 4), modes().impulse(contact.direction)};
      for (int order = 0; order < 4; ++order)
        row.by_state.col(order) = modes().derivative(order).transpose() * contact.direction;
      rows_.push_back(std::move(row));
    }
    begin(0.0, modes().state(problem_.start.u, problem_.start.v),
          MatrixXd::Zero(2 * m_.dof(), 2 * m_.dof()));
    // The start itself is given; what the change to modes rounds is that of a flight of no length.
    m_.flights_.back().covariance = m_.covariance_after(m_.flights_.back(), 0.0);
    while (const auto t = next_contact()) collide(*t);
  }

 private:
  // Of a contact: its gap and three derivatives by z, and the change of z by a unit impulse.
  struct Row {
    MatrixXd by_state;  // a column each
    VectorXd impulse;
    auto gap() const { return by_state.col(0); }
    auto rate() const { return by_state.col(1); }
  };

  const Flight& flight() const { return m_.flights_.back(); }
  const ForcedModes& modes() const { return m_.modes_; }
  double gap(std::size_t i, const VectorXd& z) const {
    return rows_[i].gap().dot(z) - problem_.contacts[i].gap;
  }

  void begin(double t, const VectorXd& z, MatrixXd covariance) {
    const double bytes = 8.0 * double(covariance.size()) * double(m_.flights_.size() + 1);
    if (m_.flights_.size() >= most_flights || bytes > most_bytes)
      throw InputError(
          fmt::format(
              "{}: {} impacts up to t = {:.6g} s, and {:.2g} GB for their errors; allowed: 1e5 "
              "impacts and 2 GB. Impacts may accumulate there; end the run earlier.",
              m_.who_, m_.flights_.size(), t, bytes * 1e-9),
          "out-of-memory");
    m_.flights_.push_back({t, z - modes().steady(t), std::move(covariance)});
  }

  // The gap of contact i, s seconds into the flight; the energy of no mode grows.
  numerics::LocalBound gap_ahead(std::size_t i, double s) const {
    const auto now = modes().advanced(flight().free, s);
    const auto size = modes().sizes(now, m_.end_);
    const Eigen::Vector4d of_modes = rows_[i].by_state.transpose() * now;
    numerics::LocalBound bound;
    bound.value = of_modes[0] - problem_.contacts[i].gap;
    bound.slope = of_modes[1];
    bound.second = of_modes[2];
    bound.third = of_modes[3];
    bound.curvature = modes().bound(rows_[i].by_state.col(2), size);
    bound.third_bound = modes().bound(rows_[i].by_state.col(3), size);
    for (const auto& force : modes().forces()) {
      const std::complex<double> y = rows_[i].gap().cast<std::complex<double>>().dot(force.steady);
      const auto turned = y * std::polar(1.0, force.frequency * (flight().t + s));
      const double square = force.frequency * force.frequency;
      bound.value += turned.real();
      bound.slope -= force.frequency * turned.imag();
      bound.second -= square * turned.real();
      bound.curvature += square * std::abs(y);
      bound.third += square * force.frequency * turned.imag();
      bound.third_bound += square * force.frequency * std::abs(y);
    }
    bound.reach = m_.end_ + 1.0;  // a gap that rests has no other
    return bound;
  }

  double gap_error(std::size_t i, const MatrixXd& covariance, const ForcedModes::Sizes& size,
                   double t, double rate) const {
    const double amplitude =
        std::abs(problem_.contacts[i].gap) + modes().bound(rows_[i].gap(), size);
    return m_.factor(m_.flights_.size() - 1) *
               std::sqrt(rows_[i].gap().dot(covariance * rows_[i].gap())) +
           epsilon * (double(m_.dof() + 4) * amplitude + 4.0 * t * std::abs(rate));
  }

  std::optional<double> next_contact() {
    const double span = m_.end_ - flight().t;
    if (rests_ || !(span > 0.0)) return std::nullopt;
    std::optional<double> first;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      // The smallest gap after the flight has begun to return to the contact.
      double least = std::numeric_limits<double>::infinity(), where = 0.0;
      const auto watched = [&](double s) {
        const auto now = gap_ahead(i, s);
        if (s > 0.0 && now.slope >= 0.0 && now.value >= 0.0 && now.value < least && returned_) {
          least = now.value;
          where = s;
        }
        if (now.slope < 0.0) returned_ = true;
        return now;
      };
      returned_ = false;
      const double fastest = std::max({modes().system().fastest(), highest_force(), 1e-3 / span});
      const double until = first ? std::min(span, *first * (1.0 + 4.0 * epsilon)) : span;
      const auto root =
          numerics::first_root(watched, 0.0, until, 1e-7 / fastest, most_search_steps);
      if (root.status == FirstRoot::Status::undecided)
        throw InputError(
            fmt::format("{}: the flight from t = {:.6g} s is too long to be searched for "
                        "impacts: more than 1e6 steps. End the run earlier.",
                        m_.who_, flight().t),
            "out-of-range");
      const double seen = root.status == FirstRoot::Status::found ? root.s : until;
      if (where <= seen) require_no_graze(i, where, least);
      if (root.status == FirstRoot::Status::found) first = std::min(root.s, first.value_or(root.s));
    }
    return first;
  }
  double highest_force() const {
    double most = 0.0;
    for (const auto& force : modes().forces()) most = std::max(most, force.frequency);
    return most;
  }

  void require_no_graze(std::size_t i, double s, double gap) const {
    if (!std::isfinite(gap)) return;
    const auto size = modes().sizes(flight().free, s);
    const double error = gap_error(i, m_.covariance_after(flight(), s), size, flight().t + s, 0.0);
    if (gap <= error) refuse_graze(i, flight().t + s, gap, error);
  }
  [[noreturn]] void refuse_graze(std::size_t i, double t, double gap, double error) const {
    throw InputError(
        fmt::format(
            "{}: contact {} comes within {:.3g} m near t = {:.9g} s without a certain impact, "
            "and the error there is {:.3g} m; allowed: motions whose impacts are certain. "
            "Change the gap by more, or end the run earlier.",
            m_.who_, i + 1, gap, t, error),
        "not-admissible");
  }

  [[noreturn]] void refuse_rest(std::size_t contact, double t) const {
    throw InputError(
        fmt::format("{}: contact {} stays closed from t = {:.9g} s on; allowed: contacts that open "
                    "again at once, since sliding and resting contact are not supported. Give "
                    "restitutions above 0, or end the run earlier.",
                    m_.who_, contact + 1, t),
        "not-admissible");
  }

  // Newton's law for the contacts that are closed at the end of the flight, s seconds long.
  void collide(double s) {
    const double t = flight().t + s;
    const auto size = modes().sizes(flight().free, s);
    MatrixXd covariance = m_.covariance_after(flight(), s);
    VectorXd z = m_.total(flight(), t);
    const VectorXd v_before = modes().derivative(1) * z, a_before = modes().acceleration(z, t);
    std::vector<std::size_t> closed;
    std::vector<double> time_errors(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double rate = rows_[i].rate().dot(z);
      const double error = gap_error(i, covariance, size, t, rate);
      if (!(gap(i, z) <= error) || !(rate <= no_rate(i, v_before))) continue;
      // It would go beyond by rate^2 / (2 curvature) at least: more than the error, or nothing is certain.
      const double depth = rate * rate / (2.0 * gap_ahead(i, s).curvature);
      if (!(rate < 0.0 && depth > error)) refuse_graze(i, t, std::abs(gap(i, z)), error);
      time_errors[i] = error / -rate + 4.0 * epsilon * t;
      closed.push_back(i);
    }
    if (closed.empty())
      throw InputError(
          fmt::format("{}: the contact that closes at t = {:.9g} s has no speed there; "
                      "allowed: impacts. Change its gap, or end the run earlier.",
                      m_.who_, t),
          "not-admissible");
    const auto impulses = solve(closed, z, t);

    const auto n = m_.dof();
    MatrixXd saltation = MatrixXd::Identity(2 * n, 2 * n);
    VectorXd time_error = VectorXd::Zero(2 * n);
    add_saltation(closed, impulses, z, a_before, saltation, time_error);
    time_error *= 4.0 * epsilon * std::max(t, s);
    covariance = saltation * covariance * saltation.transpose();
    covariance.diagonal() += time_error.cwiseAbs2();

    for (const auto i : closed)
      m_.hits_.push_back({t, time_errors[i], impulses[Index(i)], int(i), m_.flights_.size() - 1});
    for (const auto i : closed) z += rows_[i].impulse * impulses[Index(i)];
    begin(t, z, std::move(covariance));
    const VectorXd v_after = modes().derivative(1) * z, a_after = modes().acceleration(z, t);
    if (at_rest(v_after, v_before, z)) {
      m_.flights_.back().free.setZero();
      rests_ = true;
      return;
    }
    for (const auto i : closed)
      if (rows_[i].rate().dot(z) <= no_rate(i, v_before) &&
          problem_.contacts[i].direction.dot(a_after) <= no_rate(i, a_before) + no_rate(i, a_after))
        refuse_rest(i, t);
    // Flights shorter than the rounding of time cannot be told apart.
    if (s <= 64.0 * epsilon * t)
      throw InputError(fmt::format("{}: impacts accumulate at t = {:.9g} s; allowed: impacts that "
                                   "rounding of the time can separate. End the run earlier.",
                                   m_.who_, t),
                       "not-admissible");
  }

  // A gap rate that is rounding of velocities of this size.
  double no_rate(std::size_t i, const VectorXd& velocities) const {
    return touching_share * problem_.contacts[i].direction.norm() * velocities.norm();
  }

  // Nothing but rounding of the speed before the impact is left: a plastic impact at equilibrium.
  bool at_rest(const VectorXd& after, const VectorXd& before, const VectorXd& z) const {
    const double small = touching_share * before.cwiseAbs().maxCoeff();
    const VectorXd u = modes().derivative(0) * z;
    return modes().forces().empty() && after.cwiseAbs().maxCoeff() <= small &&
           u.cwiseAbs().maxCoeff() * modes().system().fastest() <= small;
  }

  VectorXd solve(const std::vector<std::size_t>& closed, const VectorXd& z, double t) {
    const auto count = Index(rows_.size());
    MatrixXd w = MatrixXd::Zero(count, count);
    VectorXd q = VectorXd::Zero(count), impulses = VectorXd::Zero(count);
    for (const auto i : closed) {
      q[Index(i)] = (1.0 + problem_.contacts[i].restitution) * rows_[i].rate().dot(z);
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
      throw InputError(
          fmt::format("{}: the impulses of {} contacts at t = {:.9g} s were not found.", m_.who_,
                      closed.size(), t),
          "complementarity-failed");
    return impulses;
  }

  // S = R + sum over contacts of g_c n_c'/(n_c . f-): contact c, whose gap a perturbation changes by
  // n_c . dx, comes that over its gap rate earlier, and g_c is its part of f+ - R f-. Of contacts
  // that close together this holds while they stay together, or do not act on each other.
  void add_saltation(const std::vector<std::size_t>& closed, const VectorXd& impulses,
                     const VectorXd& z, const VectorXd& a_before, MatrixXd& saltation,
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
      rates.row(c) = rows_[i].rate().transpose();
      pressed[c] = problem_.contacts[i].direction.dot(a_before);
    }
    law = numerics::inverse(law);
    for (Index c = 0; c < count; ++c)
      law.col(c) *= 1.0 + problem_.contacts[active[std::size_t(c)]].restitution;
    rates = law * rates;  // -impulses by z
    pressed = law * pressed;
    for (Index c = 0; c < count; ++c) {
      const auto& row = rows_[active[std::size_t(c)]];
      saltation -= row.impulse * rates.row(c);
      const VectorXd jump = impulses[Index(active[std::size_t(c)])] * modes().rate(row.impulse) +
                            pressed[c] * row.impulse;
      saltation += jump * (row.gap().transpose() / row.rate().dot(z));
      time_error += jump.cwiseAbs();
    }
  }

  double delassus(std::size_t i, std::size_t j) const {
    return rows_[i].rate().dot(rows_[j].impulse);
  }

  const model::ImpactProblem<>& problem_;
  PiecewiseMotion& m_;
  numerics::LcpSolver lcp_;
  std::vector<Row> rows_;
  bool returned_ = false, rests_ = false;
};

PiecewiseMotion::PiecewiseMotion(const model::ImpactProblem<>& problem, std::string_view who)
    : who_(who), end_(problem.end), modes_(problem, who) {
  if (problem.start.t != 0.0) refuse(who, "start", problem.start.t, "t = 0");
  const auto& contacts = problem.contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &b = contacts[i].direction, &c = contacts[j].direction;
      if (b.dot(c) >= (1.0 - 4.0 * epsilon) * b.norm() * c.norm())
        throw InputError(
            fmt::format("{}: contacts {} and {} have the same direction; allowed: contacts "
                        "of which none makes another redundant. Leave one out.",
                        who, j + 1, i + 1),
            "redundant-contacts");
    }
  Builder(problem, *this).build();
}

}  // namespace clackers::exact
