// A piecewise motion goes from impact to impact.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/flights/first_crossing.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/flights/simultaneity.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/lcp.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
      : problem_(problem), m_(motion), lcp_(problem.contacts.size()), contacts_(problem.contacts) {
    if (const auto* springs = model::one_sided_springs(problem)) {
      contacts_.insert(contacts_.end(), springs->contacts().begin(), springs->contacts().end());
      stiffnesses_ = springs->stiffnesses();
    }
  }

  void build() {
    std::vector<bool> compressed(stiffnesses_.size());
    regime(compressed);  // is checked first
    for (std::size_t j = 0; j < stiffnesses_.size(); ++j) {
      const auto& contact = contacts_[springs() + j];
      compressed[j] = contact.gap_at(problem_.start.u) < 0.0;
      const VectorXd response =
          m_.regimes_[0].derivative(1) * m_.regimes_[0].impulse(contact.direction);
      stiffest_ = std::max(stiffest_, std::sqrt(stiffnesses_[j] * contact.direction.dot(response)));
    }
    const auto n = m_.dof();
    const auto first = regime(compressed);
    begin(first, 0.0, m_.regimes_[first].state(problem_.start.u, problem_.start.v),
          MatrixXd::Zero(2 * n, 2 * n));
    // The start itself is given; what the change to modes rounds is that of a flight of no length.
    m_.flights_.back().covariance = m_.covariance_after(m_.flights_.back(), 0.0);
    is_closed_.assign(springs(), false);
    for (std::size_t i = 0; i < springs(); ++i) {
      const auto& contact = contacts_[i];
      const double size = contact.direction.cwiseAbs().dot(problem_.start.u.cwiseAbs());
      is_closed_[i] = std::abs(contact.gap_at(problem_.start.u)) <=
                      epsilon * double(n) * (size + std::abs(contact.gap));
    }
    for (;;) {
      const auto closings = next_contacts();
      if (switching_)
        change_regime();
      else if (!closings.empty())
        collide(closing_first(closings));
      else
        return;
    }
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
  const ForcedModes& modes() const { return m_.modes(flight()); }
  const Row& row(std::size_t i) const { return rows_[flight().regime][i]; }
  /// Contacts from here on are springs.
  std::size_t springs() const { return problem_.contacts.size(); }

  // The structure with these springs closed.
  std::size_t regime(const std::vector<bool>& closed) {
    const auto known = std::ranges::find(closed_springs_, closed);
    if (known != closed_springs_.end()) return std::size_t(known - closed_springs_.begin());
    auto structure = problem_;
    if (!stiffnesses_.empty()) structure.system.nonlinear = {};
    std::vector<model::HarmonicForce> forces;
    if (const auto* load = problem_.system.add_load.target<model::HarmonicLoad>())
      forces = load->forces();
    for (std::size_t j = 0; j < closed.size(); ++j) {
      if (!closed[j]) continue;
      const auto& [b, gap, restitution] = contacts_[springs() + j];
      structure.system.stiffness += stiffnesses_[j] * b * b.transpose();
      for (Index i = 0; i < b.size(); ++i)
        if (const double force = stiffnesses_[j] * gap * b[i]; force != 0.0)
          forces.push_back({int(i), force, 0.0, 0.0});
    }
    if (std::ranges::count(closed, true) > 0 && !forces.empty())
      structure.system.add_load = model::HarmonicLoad(std::move(forces));
    const auto& modes = m_.regimes_.emplace_back(structure, m_.who_);
    std::vector<Row> rows;
    for (const auto& contact : contacts_) {
      Row row{MatrixXd(2 * modes.dof(), 4), modes.impulse(contact.direction)};
      for (int order = 0; order < 4; ++order)
        row.by_state.col(order) = modes.derivative(order).transpose() * contact.direction;
      rows.push_back(std::move(row));
    }
    rows_.push_back(std::move(rows));
    closed_springs_.push_back(closed);
    return closed_springs_.size() - 1;
  }

  // A spring closes or opens. Displacements, velocities and forces are continuous.
  void change_regime() {
    const auto [contact, s] = *std::exchange(switching_, std::nullopt);
    auto closed = closed_springs_[flight().regime];
    closed[contact - springs()].flip();
    const auto next = regime(closed);
    const auto &before = modes(), &after = m_.regimes_[next];
    const double t = flight().t + s;
    const auto changed = [&](const VectorXd& z) {
      return after.state(before.derivative(0) * z, before.derivative(1) * z);
    };
    const Index n = before.dof();
    MatrixXd map(2 * n, 2 * n);
    for (Index i = 0; i < 2 * n; ++i) map.col(i) = changed(VectorXd::Unit(2 * n, i));
    const VectorXd z = changed(m_.total(flight(), t));
    begin(next, t, z, map * m_.covariance_after(flight(), s) * map.transpose());
    m_.flights_.back().covariance = m_.covariance_after(m_.flights_.back(), 0.0);
    is_closed_.assign(springs(), false);
    if (closed[contact - springs()]) m_.spring_contacts_.push_back(t);
  }

  void begin(std::size_t regime, double t, const VectorXd& z, MatrixXd covariance) {
    const double bytes = 8.0 * double(covariance.size()) * double(m_.flights_.size() + 1);
    if (m_.flights_.size() >= most_flights || bytes > most_bytes)
      throw InputError(
          fmt::format(
              "{}: {} impacts up to t = {:.6g} s, and {:.2g} GB for their errors; allowed: 1e5 "
              "impacts and 2 GB. Impacts may accumulate there; end the run earlier.",
              m_.who_, m_.flights_.size(), t, bytes * 1e-9),
          "out-of-memory");
    m_.flights_.push_back({t, regime, z - m_.regimes_[regime].steady(t), std::move(covariance)});
  }

  // The gap of contact i, s seconds into the flight; the energy of no mode grows.
  numerics::LocalBound gap_ahead(std::size_t i, double s) const {
    const auto now = modes().advanced(flight().free, s);
    const auto size = modes().sizes(now, m_.end_);
    const Eigen::Vector4d of_modes = row(i).by_state.transpose() * now;
    const Eigen::Vector3d pushed = row(i).by_state.leftCols(3).transpose() * modes().push();
    numerics::LocalBound bound;
    bound.value = of_modes[0] - contacts_[i].gap;
    bound.slope = of_modes[1] + pushed[0];
    bound.second = of_modes[2] + pushed[1];
    bound.third = of_modes[3] + pushed[2];
    bound.curvature = modes().bound(row(i).by_state.col(2), size) + std::abs(pushed[1]);
    bound.third_bound = modes().bound(row(i).by_state.col(3), size) + std::abs(pushed[2]);
    for (const auto& force : modes().forces()) {
      const std::complex<double> y = row(i).gap().cast<std::complex<double>>().dot(force.steady);
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

  double gap_error(std::size_t i, const MatrixXd& covariance, double s) const {
    const auto size = modes().sizes(flight().free, s);
    return factor() * std::sqrt(row(i).gap().dot(covariance * row(i).gap())) +
           gap_rounding(i, size);
  }
  double gap_rounding(std::size_t i, const ForcedModes::Sizes& size) const {
    return epsilon * double(m_.dof() + 4) *
           (std::abs(contacts_[i].gap) + modes().bound(row(i).gap(), size));
  }
  double factor() const { return m_.factor(m_.flights_.size() - 1); }

  // A contact that closes s seconds into the flight.
  struct Closing {
    std::size_t contact = 0;
    double s = 0.0, gap_error = 0.0, time_error = 0.0;
    double first() const { return s - time_error; }
    double last() const { return s + time_error; }
  };

  // The flight is searched in windows, each twice as long as the one before, so that the error of
  // gaps is bounded by about what it is.
  std::vector<Closing> next_contacts() {
    const double span = m_.end_ - flight().t;
    if (rests_ || !(span > 0.0)) return {};
    const double fastest =
        std::max({modes().system().fastest(), highest_force(), stiffest_, 1e-3 / span});
    std::vector<double> from(springs());
    for (double to = std::min(span, 16.0 / fastest), begin = 0.0;;
         begin = to, to = std::min(span, 2.0 * to)) {
      const auto level = levels(to);
      if (begin == 0.0) {
        for (std::size_t i = 0; i < springs(); ++i) from[i] = opening(i, level[i]);
      }
      switching_ = next_switching(begin, to, fastest);
      auto closings = search(level, from, switching_ ? switching_->second : to);
      if (switching_ && closings.empty()) return {};
      switching_.reset();
      if (!closings.empty() || to >= span) return closings;
      for (auto& s : from) s = std::max(s, to);
    }
  }

  // The spring that closes or opens first, and when.
  std::optional<std::pair<std::size_t, double>> next_switching(double from, double until,
                                                               double fastest) const {
    std::optional<std::pair<std::size_t, double>> first;
    for (std::size_t i = springs(); i < contacts_.size(); ++i) {
      const double sign = closed_springs_[flight().regime][i - springs()] ? -1.0 : 1.0;
      const auto signed_gap = [&](double s) {
        auto gap = gap_ahead(i, s);
        for (double* x : {&gap.value, &gap.slope, &gap.second, &gap.third}) *x *= sign;
        return gap;
      };
      const auto root =
          numerics::first_root(signed_gap, from, until, 1e-7 / fastest, most_search_steps);
      if (root.status == numerics::FirstRoot::Status::undecided) refuse_length();
      if (root.status != numerics::FirstRoot::Status::found) continue;
      first = {i, root.s};
      until = root.s;
    }
    return first;
  }

  [[noreturn]] void refuse_length() const {
    throw InputError(fmt::format("{}: the flight from t = {:.6g} s is too long to be searched for "
                                 "impacts: more than 1e6 steps. End the run earlier.",
                                 m_.who_, flight().t),
                     "out-of-range");
  }

  // certain_gap times a bound on the error of each gap up to s seconds into the flight.
  std::vector<double> levels(double s) const {
    if (springs() == 0) return {};
    const VectorXd deviation = flight().covariance.diagonal().cwiseSqrt();
    const auto carried = modes().sizes(deviation, s, 0.0), size = modes().sizes(flight().free, s);
    const VectorXd local = modes().local_errors(flight().free, flight().t, s);
    std::vector<double> level;
    for (std::size_t i = 0; i < springs(); ++i) {
      const double error =
          modes().bound(row(i).gap(), carried) + row(i).gap().cwiseProduct(local).norm();
      level.push_back(certain_gap * (factor() * error + gap_rounding(i, size)));
    }
    return level;
  }

  // From where on contact i is open for certain.
  double opening(std::size_t i, double level) const {
    auto gap = gap_ahead(i, 0.0);
    if (is_closed_[i]) {
      gap.value = 0.0;
    } else if (gap.value > level || gap.slope < 0.0) {
      return 0.0;
    }
    if (const auto s = departure(gap, level)) return *s;
    refuse_closed(i, gap, level);
  }

  std::vector<Closing> search(const std::vector<double>& level, const std::vector<double>& from,
                              double to) const {
    std::vector<Closing> closings;
    double until = to;
    for (std::size_t i = 0; i < springs(); ++i) {
      const auto gap = [&](double s) { return gap_ahead(i, s); };
      const auto error = [&](double s) {
        return gap_error(i, m_.covariance_after(flight(), s), s);
      };
      const auto found = first_crossing(gap, error, level[i], from[i], until, most_search_steps);
      const double t = flight().t + found.s;
      switch (found.status) {
        case Crossing::Status::none:
          break;
        case Crossing::Status::undecided:
          refuse_length();
        case Crossing::Status::uncertain:
          refuse_graze(i, t, found.gap, found.error);
        case Crossing::Status::certain: {
          const double rate = std::abs(gap(found.s).slope);
          closings.push_back({i, found.s, found.error, found.error / rate + 4.0 * epsilon * t});
          until = std::min(until, closings.back().last());
        }
      }
    }
    // Those up to `to` at most; the window that follows has the others.
    std::erase_if(closings, [&](const Closing& c) { return c.s > to; });
    std::ranges::stable_sort(closings, {}, &Closing::s);
    if (closings.size() > 1)
      for (Closing& closing : closings) {
        const double before = closing.gap_error;
        closing.gap_error =
            gap_error(closing.contact, m_.covariance_after(flight(), closing.s), closing.s);
        closing.time_error *= closing.gap_error / before;
        closing.time_error += 4.0 * epsilon * (flight().t + closing.s);
      }
    return closings;
  }

  double highest_force() const {
    double most = 0.0;
    for (const auto& force : modes().forces()) most = std::max(most, force.frequency);
    return most;
  }

  // The contacts that close first. Those that act on each other and whose order the errors do not
  // show belong to them only if they close together for certain; the others come in flights of
  // their own.
  std::vector<Closing> closing_first(const std::vector<Closing>& closings) const {
    std::vector<Closing> together{closings.front()};
    const Closing& first = closings.front();
    for (const Closing& next : std::span(closings).subspan(1)) {
      if (next.first() > first.last()) continue;
      const auto acts = std::ranges::find_if(
          together, [&](const Closing& other) { return act_on_each_other(other, next); });
      const bool is_same = next.s - first.s <= 4.0 * epsilon * (flight().t + first.s);
      if (acts != together.end() && !close_together(problem_, acts->contact, next.contact))
        throw InputError(
            fmt::format(
                "{}: contacts {} and {} close {:.3g} s apart near t = {:.9g} s, the error of "
                "that is {:.3g} s, and the first impact changes the second; allowed: impacts "
                "whose order is certain, or that are simultaneous by a symmetry of the "
                "problem. Change a gap by more, or end the run earlier.",
                m_.who_, std::min(acts->contact, next.contact) + 1,
                std::max(acts->contact, next.contact) + 1, next.s - acts->s, flight().t + first.s,
                acts->time_error + next.time_error),
            "not-admissible");
      if (acts != together.end() || is_same) together.push_back(next);
    }
    std::ranges::sort(together, {}, &Closing::contact);
    return together;
  }
  // Whether an impulse of one changes the gap rate of the other.
  bool act_on_each_other(const Closing& a, const Closing& b) const {
    const double coupling = std::abs(delassus(a.contact, b.contact));
    return coupling >
           8.0 * double(m_.dof()) * epsilon *
               std::sqrt(delassus(a.contact, a.contact) * delassus(b.contact, b.contact));
  }

  [[noreturn]] void refuse_graze(std::size_t i, double t, double gap, double error) const {
    throw InputError(
        fmt::format(
            "{}: contact {} comes within {:.3g} m near t = {:.9g} s without a certain impact, "
            "and the error there is {:.3g} m; allowed: motions whose impacts are certain. "
            "Change the gap by more, or end the run earlier.",
            m_.who_, i + 1, std::abs(gap), t, error),
        "not-admissible");
  }

  // A closed contact that does not open, or by less than the error.
  [[noreturn]] void refuse_closed(std::size_t i, const numerics::LocalBound& gap,
                                  double level) const {
    const double t = flight().t, eta = problem_.contacts[i].restitution;
    const double speed_size = modes().bound(row(i).rate(), modes().sizes(flight().free, 0.0));
    const bool is_pressed = gap.second < -touching_share * gap.curvature;
    if (!(gap.slope > touching_share * speed_size))
      throw InputError(
          fmt::format(
              "{}: contact {} {} from t = {:.9g} s on; allowed: contacts that open again at "
              "once, since sliding and resting contact are not supported. {}.",
              m_.who_, i + 1, is_pressed ? "stays closed" : "touches at rest", t,
              t == 0.0 ? "Start with the contact open"
                       : "Give restitutions above 0, or end the run earlier"),
          "not-admissible");
    if (is_pressed && eta < 1.0)
      throw InputError(
          fmt::format(
              "{}: impacts of contact {} accumulate at t = {:.9g} s, where it comes to rest; "
              "allowed: impacts that rounding can separate. End the run earlier.",
              m_.who_, i + 1, t + 2.0 * gap.slope / (-gap.second * (1.0 - eta))),
          "not-admissible");
    refuse_graze(i, t, is_pressed ? -0.5 * gap.slope * gap.slope / gap.second : gap.value, level);
  }

  // Newton's law for contacts that close together.
  void collide(const std::vector<Closing>& closings) {
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

  // Nothing but rounding of the speed before the impact is left: a plastic impact at equilibrium.
  bool at_rest(const VectorXd& after, const VectorXd& before, const VectorXd& z) const {
    const double small = touching_share * before.cwiseAbs().maxCoeff();
    const VectorXd u = modes().derivative(0) * z;
    return modes().forces().empty() && stiffnesses_.empty() &&
           after.cwiseAbs().maxCoeff() <= small &&
           u.cwiseAbs().maxCoeff() * modes().system().fastest() <= small;
  }

  VectorXd solve(const std::vector<std::size_t>& closed, const VectorXd& z, double t) {
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
      throw InputError(
          fmt::format("{}: the impulses of {} contacts at t = {:.9g} s were not found.", m_.who_,
                      closed.size(), t),
          "complementarity-failed");
    return impulses;
  }

  // S = R + sum over contacts of g_c n_c'/(n_c . f-): contact c, whose gap a perturbation changes
  // by n_c . dx, comes that over its gap rate earlier, and g_c is its part of f+ - R f-. Of
  // contacts that close together this holds while they stay together, or do not act on each other.
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

  double delassus(std::size_t i, std::size_t j) const { return row(i).rate().dot(row(j).impulse); }

  const model::ImpactProblem<>& problem_;
  PiecewiseMotion& m_;
  numerics::LcpSolver lcp_;
  std::vector<model::Contact<>> contacts_;         // those of the problem, then springs
  std::vector<double> stiffnesses_;                // of the springs
  std::vector<std::vector<bool>> closed_springs_;  // of each regime
  std::vector<std::vector<Row>> rows_;             // of each regime
  std::optional<std::pair<std::size_t, double>> switching_;
  double stiffest_ = 0.0;  // frequency of a spring and the masses that it joins
  std::vector<bool> is_closed_;
  bool rests_ = false;
};

PiecewiseMotion::PiecewiseMotion(const model::ImpactProblem<>& problem, std::string_view who)
    : who_(who), end_(problem.end) {
  validate(problem);
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

model::ImpactProblem<> with_springs(model::ImpactProblem<> problem, double stiffness) {
  constexpr auto who = "penalized motion";
  require_positive(who, "stiffness", stiffness);
  for (const auto& contact : problem.contacts)
    if (contact.restitution != 1.0)
      refuse(who, "restitution", contact.restitution, "1, since a linear spring is elastic", {},
             "penalty-needs-elastic");
  std::vector<double> stiffnesses(problem.contacts.size(), stiffness);
  problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
      std::exchange(problem.contacts, {}), std::move(stiffnesses));
  return problem;
}

}  // namespace clackers::exact
