#include "clackers/exact/flights/piecewise_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "clackers/base/check.hpp"
#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/spd_solver.hpp"

#ifdef CLACKERS_HAS_ARB
#include "clackers/exact/certified/flights_enclosure.hpp"
#endif

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double most_bytes = 2e9;
constexpr Index most_kept = 64;      // columns of errors of a flight that is over
constexpr double most_error = 0.01;  // of displacements, over the largest

// Symmetric; a product such as S' K S leaves 1e-12 of the largest eigenvalue.
void require_no_negative_eigenvalue(std::string_view who, const char* name, const MatrixXd& x,
                                    const char* reason) {
  if (x.isZero(0.0)) return;
  MatrixXd raised = x;
  raised.diagonal().array() += 1e-12 * x.diagonal().maxCoeff();
  if (numerics::SpdSolver<Eigen::Dynamic>().compute(raised)) return;
  const VectorXd values = numerics::symmetric_eigenvalues(x);
  if (!(values.minCoeff() >= -1e-12 * values.cwiseAbs().maxCoeff()))
    throw InputError(fmt::format("{}: {} has the eigenvalue {:.6g}; allowed: none below 0. {}", who,
                                 name, values.minCoeff(), reason),
                     "not-positive-definite");
}

// Of each contact the number of the part that its masses belong to: those that matrices or contacts join.
std::vector<std::size_t> parts(const model::ImpactProblem<>& problem,
                               const std::vector<model::Contact<>>& contacts) {
  const auto n = problem.dof();
  MatrixXd joined = problem.system.mass.cwiseAbs() + problem.system.damping.cwiseAbs() +
                    problem.system.stiffness.cwiseAbs();
  for (const auto& c : contacts) joined += (c.direction * c.direction.transpose()).cwiseAbs();
  std::vector<std::size_t> of_mass(static_cast<std::size_t>(n), std::size_t(n)), found;
  std::vector<Index> open;
  for (Index first = 0; first < n; ++first)
    for (open.assign(1, first); !open.empty();) {
      const Index i = open.back();
      open.pop_back();
      if (of_mass[std::size_t(i)] < std::size_t(n)) continue;
      of_mass[std::size_t(i)] = std::size_t(first);
      for (Index j = 0; j < n; ++j)
        if (joined(i, j) != 0.0) open.push_back(j);
    }
  for (const auto& c : contacts) {
    Index mass = 0;
    c.direction.cwiseAbs().maxCoeff(&mass);
    found.push_back(of_mass[std::size_t(mass)]);
  }
  return found;
}

}  // namespace

PiecewiseMotion::Builder::Builder(const model::ImpactProblem<>& problem, const ImpactLaw& law,
                                  std::size_t most_flights, PiecewiseMotion& motion)
    : problem_(problem),
      law_(law),
      most_flights_(most_flights),
      m_(motion),
      lcp_(problem.contacts.size()),
      contacts_(problem.contacts),
      opens_(problem.contacts.size(), Begin::open) {
  if (const auto* springs = model::one_sided_springs(problem)) {
    contacts_.insert(contacts_.end(), springs->contacts().begin(), springs->contacts().end());
    stiffnesses_ = springs->stiffnesses();
  }
  part_ = parts(problem, contacts_);
  passed_.resize(springs());
  ahead_.resize(contacts_.size());
}

void PiecewiseMotion::Builder::build() {
  start();
  for (;;) {
    const auto closings = sharp_closings();
    if (switching_)
      change_regime();
    else if (!closings.empty())
      happen(closings);
    else
      return;
  }
}

auto PiecewiseMotion::Builder::sharp_closings() -> std::vector<Closing> {
  try {
    const auto closings = next_contacts();
    return closings.empty() ? closings : closing_first(closings);
  } catch (const InputError& error) {
    if (error.code() != Code("not-admissible") || !sharpen()) throw;
    return sharp_closings();
  }
}

bool PiecewiseMotion::Builder::sharpen() {
#ifdef CLACKERS_HAS_ARB
  const auto now = m_.flights_.size() - 1;
  if (!m_.has_bounds_ || now == 0 || sharp_ == now || m_.dof() > most_masses_of_balls) return false;
  if (!balls_) balls_ = std::make_shared<certified::FlightsEnclosure>(m_);
  const auto exact = balls_->doubles(now, flight().t);
  if (!exact) return false;
  sharp_ = now;
  switching_.reset();
  State state{flight().regime, flight().t, modes().state(exact->first, exact->second),
              FlightErrors(modes(), m_.end_)};
  // What is 0 in truth is a number of that size at most.
  const double unknown =
      0x1p-96 * std::max(exact->first.cwiseAbs().maxCoeff(), exact->second.cwiseAbs().maxCoeff());
  const MatrixXd each = unknown * MatrixXd::Identity(m_.dof(), m_.dof()), none = 0.0 * each;
  state.errors.add(modes(), modes().change(each, none).cwiseAbs().rowwise().sum() +
                                modes().change(none, each).cwiseAbs().rowwise().sum());
  m_.flights_.pop_back();
  opens_ = begins_;
  begin(std::move(state));
  m_.flights_.back().errors = m_.errors_after(flight(), 0.0);
  return true;
#else
  return false;
#endif
}

void PiecewiseMotion::Builder::start() {
  std::vector<bool> closed(contacts_.size() + 1);
  regime(closed);  // is checked first
  for (std::size_t i = springs(); i < contacts_.size(); ++i) {
    const auto& contact = contacts_[i];
    closed[i] = contact.gap_at(problem_.start.u) < 0.0;
    const VectorXd response = m_.regimes_[0].velocity(m_.regimes_[0].impulse(contact.direction));
    stiffest_ = std::max(stiffest_,
                         std::sqrt(stiffnesses_[i - springs()] * contact.direction.dot(response)));
  }
  const auto n = m_.dof();
  fastest_ = problem_.start.v.cwiseAbs().maxCoeff();
  State state{regime(closed), problem_.start.t, {}, {}};
  const auto& modes = m_.regimes_[state.regime];
  state.errors = FlightErrors(modes, m_.end_);
  state.z = modes.state(problem_.start.u, problem_.start.v);
  if (modes.is_precise()) {
    ForcedModes::Numbers u, v;
    for (const double x : problem_.start.u) u.push_back({x, 0.0});
    for (const double x : problem_.start.v) v.push_back({x, 0.0});
    state.precise = modes.precise_state(u, v);
    state.errors.add(modes, modes.precise_change_errors(state.z));
  }
  begin(state);
  // The start itself is given; what the change to modes rounds is that of a flight of no length.
  m_.flights_.back().errors = state.errors = m_.errors_after(flight(), 0.0);
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < springs(); ++i) {
    const auto& contact = contacts_[i];
    const double size = contact.direction.cwiseAbs().dot(problem_.start.u.cwiseAbs());
    if (std::abs(contact.gap_at(problem_.start.u)) >
        epsilon * double(n) * (size + std::abs(contact.gap)))
      continue;
    const double speed = contact.direction.cwiseAbs().dot(problem_.start.v.cwiseAbs());
    opens_[i] = Begin::by_speed;
    if (contact.gap_rate(problem_.start.v) <= epsilon * double(n) * speed) touching.push_back(i);
  }
  const auto next = resting(state, touching);
  m_.flights_.clear();
  auto first = seen_in(next, state);
  first.z = m_.regimes_[next].state(problem_.start.u, problem_.start.v);
  begin(std::move(first));
}

void PiecewiseMotion::Builder::begin(State state) {
  auto& [regime, t, z, errors, time_error, precise, late] = state;
  if (!m_.flights_.empty() && flight().is_precise && flight().errors.columns() > most_kept) {
    auto& before = m_.flights_.back().errors;
    bytes_ -= before.bytes();
    before.collapse(modes());
  }
  bytes_ += errors.bytes();
  if (m_.flights_.size() >= most_flights_ || bytes_ > most_bytes)
    throw InputError(
        fmt::format(
            "{}: {} impacts up to t = {:.6g} s, and {:.2g} GB for their errors; allowed: {:g} "
            "impacts and 2 GB. Impacts may accumulate there; end the run earlier.",
            m_.who_, m_.flights_.size(), t, bytes_ * 1e-9, double(most_flights_)),
        "out-of-memory");
  for (std::size_t i = 0; i < springs(); ++i) {
    const auto now = std::ranges::find_if(
        m_.closed_, [&](const auto& c) { return c.contact == int(i) && !c.opens; });
    if (closed_[regime][i] && now == m_.closed_.end()) {
      m_.closed_.push_back({int(i), t, m_.end_, {t - time_error, t + time_error}});
    } else if (!closed_[regime][i] && now != m_.closed_.end()) {
      now->until = t;
      now->opens = true;
    }
  }
  VectorXd free = m_.regimes_[regime].steady(t);
  precise_ = std::move(precise);
  if (late != 0.0) precise_ = m_.regimes_[regime].precise_advanced(precise_, {-late, 0.0});
  for (Index j = 0; j < free.size(); ++j)
    free[j] = precise_.empty()
                  ? z[j] - free[j]
                  : (precise_[std::size_t(j)] - numerics::DoubleDouble{free[j], 0.0}).hi;
  m_.flights_.push_back({t, regime, std::move(free), std::move(errors), {}, !precise_.empty()});
  begins_ = std::exchange(opens_, std::vector<Begin>(springs(), Begin::open));
  for (std::size_t i = 0; i < springs(); ++i)
    if (is_held(i) && begins_[i] != Begin::idle) begins_[i] = Begin::open;
  const auto states = ForcedModes::states(flight().free);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const bool is_behind = is_spring(i) ? closed_[flight().regime][i] : passed_[i];
    modes().look_ahead(ahead_[i], watched(i), states, t, is_behind ? -1.0 : 1.0);
  }
}

PiecewiseMotion::PiecewiseMotion(const model::ImpactProblem<>& problem, std::string_view who)
    : who_(who), problem_(problem), end_(problem.end) {
  validate(problem);
  if (!problem.frictions.empty())
    throw InputError(
        fmt::format("{}: the problem has dry friction, whose motion is not followed flight "
                    "by flight; allowed: contacts. Take the cases slider, belt or "
                    "forced-slider.",
                    who),
        "linear-only");
  if (problem.start.t != 0.0) refuse(who, "start", problem.start.t, "t = 0");
  require_no_negative_eigenvalue(who, "the stiffness matrix", problem.system.stiffness,
                                 "The structure would not return to its rest.");
  require_no_negative_eigenvalue(who, "the damping matrix", problem.system.damping,
                                 "The damping would feed energy in.");
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
  Builder(problem, {}, 100000, *this).build();
  // Envelopes add up parts that may cancel; loads push free masses no farther than this.
  VectorXd pushed = VectorXd::Zero(dof());
  for (const auto& force : regimes_[0].forces()) pushed += force.acceleration.cwiseAbs();
  const double bound = error_bound(end_).u.maxCoeff(),
               reach =
                   problem.start.u.cwiseAbs().maxCoeff() +
                   end_ * (problem.start.v.cwiseAbs().maxCoeff() + 0.5 * end_ * pushed.maxCoeff()),
               size = std::min(reach,
                               std::max(envelope(0.0).u.maxCoeff(), envelope(end_).u.maxCoeff()));
  if (!(bound <= most_error * size))
    throw InputError(
        fmt::format(
            "{}: displacements at the end, t = {:.6g} s, are known to {:.3g} m, and are {:.3g} m "
            "at most; allowed: motions known to 1 % of that. End the run earlier, or change a "
            "number of the problem.",
            who_, end_, bound, size),
        "not-admissible");
}

PiecewiseMotion::PiecewiseMotion(const model::ImpactProblem<>& problem, const ImpactLaw& law,
                                 double until, int most_impacts)
    : who_("event-driven motion"), problem_(problem), end_(until), has_bounds_(false) {
  for (const auto& contact : problem.contacts) {
    const double gap = contact.gap_at(problem.start.u);
    const double size = contact.direction.cwiseAbs().dot(problem.start.u.cwiseAbs());
    if (!(gap >= -1e-12 * (size + std::abs(contact.gap))))
      refuse(who_, "gap", gap, "no contact violated at the start");
  }
  Builder(problem, law, std::size_t(most_impacts) + 1, *this).build();
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
