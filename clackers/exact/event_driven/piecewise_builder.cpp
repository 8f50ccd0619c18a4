// A piecewise motion goes from impact to impact.
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/exact/event_driven/piecewise_motion.hpp"
#include "clackers/numerics/lcp.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using numerics::FirstRoot;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_root_steps = 1000000;
constexpr std::size_t most_flights = 100000;
constexpr double most_bytes = 2e9;
/// Speeds below this share of their sizes are those of masses that stay together.
constexpr double rounding_share = 1e-12;

// Symmetric; a product such as S' K S leaves 1e-12 of the largest eigenvalue.
void require_no_negative_eigenvalue(std::string_view who, const char* name, const MatrixXd& x,
                                    const char* reason) {
  const VectorXd values =
      Eigen::SelfAdjointEigenSolver<MatrixXd>(x, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(values.minCoeff() >= -1e-12 * values.cwiseAbs().maxCoeff()))
    throw InputError(fmt::format("{}: {} has the eigenvalue {:.6g}; allowed: none below 0. {}", who,
                                 name, values.minCoeff(), reason),
                     "not-positive-definite");
}

}  // namespace

class PiecewiseMotion::Builder {
 public:
  Builder(const model::ImpactProblem<>& problem, PiecewiseMotion& motion)
      : problem_(problem), m_(motion), lcp_(problem.contacts.size()) {}

  void build() {
    for (const auto& contact : problem_.contacts)
      rows_.push_back(m_.system_.shapes().transpose() * contact.direction);
    const auto n = std::size_t(m_.dof());
    Modal state(n);
    const auto& start = problem_.start;
    m_.system_.to_modes({start.u.data(), n}, {start.v.data(), n}, state);
    begin(0.0, state, MatrixXd::Zero(2 * m_.dof(), 2 * m_.dof()));
    // The start itself is given; what the change to modes rounds is that of a flight of no length.
    m_.flights_.back().covariance = m_.covariance_after(m_.flights_.back(), 0.0);
    while (const auto t = next_contact()) collide(*t);
  }

 private:
  const Flight& flight() const { return m_.flights_.back(); }
  double amplitude(std::size_t i, const Sizes& size) const {
    return std::abs(problem_.contacts[i].gap) + rows_[i].cwiseAbs().dot(size.y);
  }
  static VectorXd displacement(const Modal& state) {
    VectorXd y(Index(state.size()));
    for (std::size_t j = 0; j < state.size(); ++j) y[Index(j)] = state[j].y;
    return y;
  }
  static VectorXd velocity(const Modal& state) {
    VectorXd rate(Index(state.size()));
    for (std::size_t j = 0; j < state.size(); ++j) rate[Index(j)] = state[j].rate;
    return rate;
  }
  double gap(std::size_t i, const Modal& state) const {
    return rows_[i].dot(displacement(state)) - problem_.contacts[i].gap;
  }

  void begin(double t, const Modal& state, MatrixXd covariance) {
    const double bytes = 8.0 * double(covariance.size()) * double(m_.flights_.size() + 1);
    if (m_.flights_.size() >= most_flights || bytes > most_bytes)
      throw InputError(
          fmt::format(
              "{}: {} impacts up to t = {:.6g} s, and {:.2g} GB for their errors; allowed: 1e5 "
              "impacts and 2 GB. Impacts may accumulate there; end the run earlier.",
              m_.who_, m_.flights_.size(), t, bytes * 1e-9),
          "out-of-memory");
    Flight next{t, state, std::move(covariance)};
    const auto steady = m_.steady(t);
    for (std::size_t j = 0; j < state.size(); ++j) {
      next.free[j].y -= steady[j].y;
      next.free[j].rate -= steady[j].rate;
    }
    m_.flights_.push_back(std::move(next));
  }

  // The gap of contact i, s seconds into the flight. With E^2 = y'^2 + omega^2 y^2, which does not
  // grow, |y''| <= h E and |y'''| <= (2 sigma h + omega^2) E, h^2 = 4 sigma^2 + omega^2.
  numerics::LocalBound gap_ahead(std::size_t i, double s) const {
    numerics::LocalBound bound;
    bound.value = -problem_.contacts[i].gap;
    for (Index j = 0; j < rows_[i].size(); ++j) {
      const auto& mode = m_.system_.modes()[std::size_t(j)];
      const auto now = numerics::advance(mode, flight().free[std::size_t(j)], s);
      const double row = rows_[i][j], h = std::hypot(2.0 * mode.sigma, mode.omega);
      const double size = std::abs(row) * std::hypot(now.rate, mode.omega * now.y);
      bound.value += row * now.y;
      bound.slope += row * now.rate;
      const double a = mode.acceleration(now.y, now.rate);
      bound.second += row * a;
      bound.third += row * (-2.0 * mode.sigma * a - mode.omega_square * now.rate);
      bound.curvature += size * h;
      bound.third_bound += size * (2.0 * mode.sigma * h + mode.omega_square);
    }
    for (const auto& force : m_.forces_) {
      std::complex<double> y = 0.0;
      for (Index j = 0; j < rows_[i].size(); ++j) y += rows_[i][j] * force.steady[j];
      const auto now = y * std::polar(1.0, force.frequency * (flight().t + s));
      const double square = force.frequency * force.frequency;
      bound.value += now.real();
      bound.slope -= force.frequency * now.imag();
      bound.second -= square * now.real();
      bound.curvature += square * std::abs(y);
      bound.third += square * force.frequency * now.imag();
      bound.third_bound += square * force.frequency * std::abs(y);
    }
    bound.reach = m_.end_ + 1.0;  // a gap that rests has no other
    return bound;
  }

  double gap_error(std::size_t i, const MatrixXd& covariance, const Sizes& size, double t,
                   double rate) const {
    VectorXd row = VectorXd::Zero(2 * m_.dof());
    for (Index j = 0; j < m_.dof(); ++j) row[2 * j] = rows_[i][j];
    return m_.factor(m_.flights_.size() - 1) * std::sqrt(row.dot(covariance * row)) +
           epsilon * (double(m_.dof() + 4) * amplitude(i, size) + 4.0 * t * std::abs(rate));
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
      const double fastest = std::max({m_.system_.fastest(), highest_force(), 1e-3 / span});
      const double until = first ? std::min(span, *first * (1.0 + 4.0 * epsilon)) : span;
      const auto root = numerics::first_root(watched, 0.0, until, 1e-7 / fastest, most_root_steps);
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
    for (const auto& force : m_.forces_) most = std::max(most, force.frequency);
    return most;
  }

  void require_no_graze(std::size_t i, double s, double gap) const {
    if (!std::isfinite(gap)) return;
    const auto size = m_.sizes(flight(), s);
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
    const auto size = m_.sizes(flight(), s);
    MatrixXd covariance = m_.covariance_after(flight(), s);
    auto state = m_.total(flight(), t);
    const VectorXd before = velocity(state);
    const VectorXd a_before = m_.acceleration(state, t);
    std::vector<std::size_t> closed;
    std::vector<double> time_errors(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double rate = rows_[i].dot(before);
      const double error = gap_error(i, covariance, size, t, rate);
      if (!(gap(i, state) <= error) || !(rate <= no_rate(i, before))) continue;
      // It would go beyond by rate^2 / (2 curvature) at least: more than the error, or nothing is certain.
      const double depth = rate * rate / (2.0 * gap_ahead(i, s).curvature);
      if (!(rate < 0.0 && depth > error)) refuse_graze(i, t, std::abs(gap(i, state)), error);
      time_errors[i] = error / -rate + 4.0 * epsilon * t;
      closed.push_back(i);
    }
    if (closed.empty())
      throw InputError(
          fmt::format("{}: the contact that closes at t = {:.9g} s has no speed there; "
                      "allowed: impacts. Change its gap, or end the run earlier.",
                      m_.who_, t),
          "not-admissible");
    const auto impulses = solve(closed, before, t);

    const auto n = m_.dof();
    MatrixXd saltation = MatrixXd::Identity(2 * n, 2 * n);
    VectorXd time_error = VectorXd::Zero(2 * n);
    VectorXd after = before;
    for (const auto i : closed) after += rows_[i] * impulses[Index(i)];
    add_saltation(closed, impulses, before, a_before, saltation, time_error);
    time_error *= 4.0 * epsilon * std::max(t, s);
    covariance = saltation * covariance * saltation.transpose();
    covariance.diagonal() += time_error.cwiseAbs2();

    for (const auto i : closed)
      m_.hits_.push_back({t, time_errors[i], impulses[Index(i)], int(i), m_.flights_.size() - 1});
    for (Index j = 0; j < n; ++j) state[std::size_t(j)].rate = after[j];
    begin(t, state, std::move(covariance));
    if (at_rest(after, before, state)) {
      for (auto& mode : m_.flights_.back().free) mode = {};
      rests_ = true;
      return;
    }
    const VectorXd a_after = m_.acceleration(state, t);
    for (const auto i : closed)
      if (rows_[i].dot(after) <= no_rate(i, before) &&
          rows_[i].dot(a_after) <= no_rate(i, a_before) + no_rate(i, a_after))
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
    return rounding_share * rows_[i].norm() * velocities.norm();
  }

  // Nothing but rounding of the speed before the impact is left: a plastic impact at equilibrium.
  bool at_rest(const VectorXd& after, const VectorXd& before, const Modal& state) const {
    const double small = rounding_share * before.cwiseAbs().maxCoeff();
    return m_.forces_.empty() && after.cwiseAbs().maxCoeff() <= small &&
           displacement(state).cwiseAbs().maxCoeff() * m_.system_.fastest() <= small;
  }

  VectorXd solve(const std::vector<std::size_t>& closed, const VectorXd& before, double t) {
    const auto count = Index(rows_.size());
    MatrixXd w = MatrixXd::Zero(count, count);
    VectorXd q = VectorXd::Zero(count), impulses = VectorXd::Zero(count);
    for (const auto i : closed) {
      q[Index(i)] = (1.0 + problem_.contacts[i].restitution) * rows_[i].dot(before);
      for (const auto j : closed) w(Index(i), Index(j)) = rows_[i].dot(rows_[j]);
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
                     const VectorXd& before, const VectorXd& a_before, MatrixXd& saltation,
                     VectorXd& time_error) const {
    const auto n = m_.dof();
    std::vector<std::size_t> active;
    for (const auto i : closed)
      if (impulses[Index(i)] > 0.0) active.push_back(i);
    const auto count = Index(active.size());
    MatrixXd b(count, n), law(count, count);
    for (Index c = 0; c < count; ++c) b.row(c) = rows_[active[std::size_t(c)]].transpose();
    law = (b * b.transpose()).inverse();
    for (Index c = 0; c < count; ++c)
      law.col(c) *= 1.0 + problem_.contacts[active[std::size_t(c)]].restitution;
    const MatrixXd impulse_of = law * b;  // -impulse for unit velocities
    const VectorXd pressed = impulse_of * a_before;
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k)
        saltation(2 * j + 1, 2 * k + 1) -= b.col(j).dot(impulse_of.col(k));
    for (Index c = 0; c < count; ++c) {
      const double p = impulses[Index(active[std::size_t(c)])], rate = b.row(c).dot(before);
      VectorXd jump(2 * n);
      for (Index j = 0; j < n; ++j) {
        const double sigma = m_.system_.modes()[std::size_t(j)].sigma;
        jump[2 * j] = b(c, j) * p;
        jump[2 * j + 1] = b(c, j) * (pressed[c] - 2.0 * sigma * p);
      }
      for (Index k = 0; k < n; ++k) saltation.col(2 * k) += jump * (b(c, k) / rate);
      time_error += jump.cwiseAbs();
    }
  }

  const model::ImpactProblem<>& problem_;
  PiecewiseMotion& m_;
  numerics::LcpSolver lcp_;
  std::vector<VectorXd> rows_;  // of the contacts, in modes
  bool returned_ = false, rests_ = false;
};

void PiecewiseMotion::add_forces(std::string_view who, const model::HarmonicLoad& load) {
  for (const auto& f : load.forces()) {
    Force force;
    force.frequency = f.frequency;
    const std::complex<double> phase = std::polar(f.amplitude, f.phase);
    force.modal = system_.shapes().row(f.dof).transpose().cast<std::complex<double>>() * phase;
    force.steady.resize(dof());
    for (Index j = 0; j < dof(); ++j) {
      const auto& mode = system_.modes()[std::size_t(j)];
      const std::complex<double> dynamic((mode.omega - f.frequency) * (mode.omega + f.frequency),
                                         2.0 * mode.sigma * f.frequency);
      const double size = mode.omega_square + f.frequency * f.frequency;
      if (std::abs(force.modal[j]) > 0.0 && !(std::abs(dynamic) > 1e-8 * size))
        throw InputError(
            fmt::format(
                "{}: the load on degree of freedom {} has {:.6g} rad/s, the frequency of an "
                "undamped mode; allowed: 1e-8 of it away. The response would grow without a "
                "bound; change the frequency, or add damping.",
                who, f.dof + 1, f.frequency),
            "out-of-range");
      force.steady[j] = std::abs(force.modal[j]) > 0.0 ? force.modal[j] / dynamic : 0.0;
    }
    forces_.push_back(std::move(force));
  }
}

// What the mode shapes leave of M, C and K beside a diagonal, and the rounding of that.
void PiecewiseMotion::find_residuals() {
  const auto& shapes = system_.shapes();
  const auto residual = [&](const MatrixXd& x, const auto& diagonal) {
    MatrixXd rest = shapes.transpose() * x * shapes;
    for (Index j = 0; j < dof(); ++j) rest(j, j) -= diagonal(system_.modes()[std::size_t(j)]);
    const MatrixXd size = shapes.cwiseAbs().transpose() * x.cwiseAbs() * shapes.cwiseAbs();
    return MatrixXd(rest.cwiseAbs() + 2.0 * double(dof()) * epsilon * size);
  };
  using numerics::Mode;
  mass_residual_ = residual(mass_, [](const Mode&) { return 1.0; });
  damping_residual_ = residual(damping_, [](const Mode& mode) { return 2.0 * mode.sigma; });
  stiffness_residual_ = residual(stiffness_, [](const Mode& mode) { return mode.omega_square; });
}

PiecewiseMotion::PiecewiseMotion(const model::ImpactProblem<>& problem, std::string_view who)
    : who_(who),
      mass_(problem.system.mass),
      stiffness_(problem.system.stiffness),
      damping_(problem.system.damping),
      end_(problem.end) {
  validate(problem);
  if (problem.start.t != 0.0) refuse(who, "start", problem.start.t, "t = 0");
  const auto* load = problem.system.add_load.target<model::HarmonicLoad>();
  if (problem.system.nonlinear || (problem.system.add_load && load == nullptr))
    refuse(who, "system", "with a nonlinear force or any load", "linear, with harmonic loads", {},
           "linear-only");
  require_no_negative_eigenvalue(who, "the stiffness matrix", stiffness_,
                                 "The structure would not return to its rest.");
  require_no_negative_eigenvalue(who, "the damping matrix", damping_,
                                 "The damping would feed energy in.");
  auto system = numerics::ModalSystem::make(mass_, damping_, stiffness_);
  if (!system || !system->rate_shapes().isZero(0.0))
    throw InputError(
        fmt::format(
            "{}: the damping matrix couples the modes of mass and stiffness; allowed: modal "
            "damping, as a combination of M and K, or matrices that are all diagonal.",
            who),
        "out-of-range");
  system_ = std::move(*system);
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
  if (load != nullptr) add_forces(who, *load);
  find_residuals();
  Builder(problem, *this).build();
}

}  // namespace clackers::exact
