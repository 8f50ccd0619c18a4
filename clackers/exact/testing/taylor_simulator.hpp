#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include "clackers/exact/testing/mass_simulator.hpp"
#include "clackers/model/harmonic_load.hpp"

// For tests: any linear structure that collides, by Taylor series with 90 digits. It knows M, C, K,
// the forces and the contacts, and nothing of modes. Of contacts that touch without speed those stay closed
// whose set it finds by trial: the first terms of their forces, and of the gaps of the others, are
// positive. Rebounds slower than 1e-15 of the speeds are rest.
namespace clackers::exact::testing_oracle {

class TaylorSimulator {
 public:
  struct Impact {
    Real t, impulse;
    int contact = 0;
  };
  struct State {
    RealVector u, v, a;
  };

  explicit TaylorSimulator(const model::ImpactProblem<>& problem)
      : problem_(problem),
        damping_(problem.system.damping.cast<Real>()),
        stiffness_(problem.system.stiffness.cast<Real>()),
        inverse_mass_(RealMatrix(problem.system.mass.cast<Real>()).inverse()),
        step_(longest_step(inverse_mass_ * stiffness_)) {
    if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>())
      forces_ = load->forces();
    std::vector<std::size_t> touching;
    const RealVector u = problem.start.u.cast<Real>(), v = problem.start.v.cast<Real>();
    for (std::size_t i = 0; i < problem.contacts.size(); ++i)
      if (is_zero(row(i).dot(u) - Real(problem.contacts[i].gap)) && is_zero(row(i).dot(v)))
        touching.push_back(i);
    rest(0, u, v, touching);
  }
  /// Contacts that are closed now.
  const std::vector<std::size_t>& held() const { return held_; }
  /// The force of each of them.
  RealVector forces_at(const Real& t) const {
    RealVector sum = multipliers_.back();
    for (auto k = multipliers_.size() - 1; k-- > 0;) sum = sum * (t - start_) + multipliers_[k];
    return sum;
  }

  /// Within the present series.
  State at(const Real& t) const {
    const Real s = t - start_;
    State x{series_.back(), RealVector::Zero(dof()), RealVector::Zero(dof())};
    for (auto k = series_.size() - 1; k-- > 0;) {
      x.a = x.a * s + 2 * x.v;
      x.v = x.v * s + x.u;
      x.u = x.u * s + series_[k];
    }
    return x;
  }

  /// Goes to `until`, or through the next impact if that comes earlier.
  std::optional<Impact> next(const Real& until) {
    for (;;) {
      const Real end = std::min(Real(start_ + step_), until);
      std::optional<Real> first;
      int contact_index = 0;
      bool is_release = false;
      for (std::size_t i = 0; i < problem_.contacts.size(); ++i) {
        const auto closed = std::ranges::find(held_, i);
        const bool is_held = closed != held_.end();
        const auto series = is_held ? force_terms(closed - held_.begin()) : gap_terms(i);
        if (const auto t = first_zero(series, first ? *first : end)) {
          first = t;
          contact_index = int(i);
          is_release = is_held;
        }
      }
      if (first && is_release) {
        const auto x = at(*first);
        rest(*first, x.u, x.v, std::vector<std::size_t>(held_));
        continue;
      }
      if (first) return impact(*first, contact_index);
      const auto x = at(end);
      expand(end, x.u, x.v);
      if (end == until) return std::nullopt;
    }
  }

 private:
  Eigen::Index dof() const { return stiffness_.rows(); }
  RealVector row(std::size_t i) const { return problem_.contacts[i].direction.cast<Real>(); }

  static bool is_zero(const Real& x) { return abs(x) < Real(1e-60); }

  // (k + 1)(k + 2) M u_(k+2) = f_k + B' p_k - (k + 1) C u_(k+1) - K u_k, with B u_(k+2) = 0 for the
  // held contacts.
  void expand(const Real& t, const RealVector& u, const RealVector& v) {
    start_ = t;
    series_ = {u, v};
    multipliers_.clear();
    const auto count = std::ssize(held_);
    RealMatrix rows(count, dof());
    for (Eigen::Index i = 0; i < count; ++i) rows.row(i) = row(held_[std::size_t(i)]).transpose();
    const RealMatrix responses = inverse_mass_ * rows.transpose();
    const RealMatrix inverse = count > 0 ? RealMatrix((rows * responses).inverse()) : RealMatrix();
    std::vector<Real> forces(forces_.size());
    for (int k = 0; k + 2 < terms; ++k) {
      RealVector f = -(stiffness_ * series_[std::size_t(k)] +
                       Real(k + 1) * (damping_ * series_[std::size_t(k) + 1]));
      for (std::size_t i = 0; i < forces_.size(); ++i) {
        // The k-th derivative turns the phase by k quarters.
        const auto& force = forces_[i];
        const Real phase = Real(force.frequency) * t + Real(force.phase);
        const Real quarter = k % 2 == 0 ? cos(phase) : sin(phase);
        const int sign = (k + 1) / 2 % 2 == 0 ? 1 : -1;
        forces[i] = k == 0 ? Real(1) : Real(forces[i] * Real(force.frequency) / k);
        f[force.dof] += Real(force.amplitude) * forces[i] * sign * quarter;
      }
      RealVector a = inverse_mass_ * f;
      multipliers_.push_back(RealVector::Zero(count));
      if (count > 0) {
        multipliers_.back() = -inverse * (rows * a);
        a += responses * multipliers_.back();
      }
      series_.push_back(a / Real((k + 1) * (k + 2)));
    }
  }

  static bool begins_positive(const std::vector<Real>& series, std::size_t from) {
    for (auto k = from; k < series.size() / 2; ++k)
      if (abs(series[k]) > Real(1e-40)) return series[k] > 0;
    return true;
  }

  // Of these contacts, which touch without speed, some stay closed.
  void rest(const Real& t, const RealVector& u, const RealVector& v,
            const std::vector<std::size_t>& touching) {
    for (unsigned set = 0; set < 1u << touching.size(); ++set) {
      held_.clear();
      for (std::size_t i = 0; i < touching.size(); ++i)
        if (set >> i & 1u) held_.push_back(touching[i]);
      expand(t, u, v);
      bool fits = true;
      for (std::size_t i = 0; i < held_.size(); ++i)
        fits = fits && begins_positive(force_terms(Eigen::Index(i)), 0);
      for (const auto i : touching)
        if (std::ranges::find(held_, i) == held_.end())
          fits = fits && begins_positive(gap_terms(i), 2);
      if (fits) return;
    }
    throw std::logic_error("no set of closed contacts");
  }

  // No more than 8 radians of any mode, so that the terms fall to 1e-28 and below.
  static Real longest_step(const RealMatrix& squares) {
    const double fastest =
        std::sqrt(squares.cwiseAbs().rowwise().sum().maxCoeff().convert_to<double>());
    return std::min(0.25, 8.0 / std::max(fastest, 1.0));
  }
  std::vector<Real> gap_terms(std::size_t i) const {
    std::vector<Real> gaps;
    const auto b = row(i);
    for (const auto& coefficient : series_) gaps.push_back(b.dot(coefficient));
    gaps[0] -= Real(problem_.contacts[i].gap);
    return gaps;
  }
  std::vector<Real> force_terms(Eigen::Index i) const {
    std::vector<Real> forces;
    for (const auto& coefficient : multipliers_) forces.push_back(coefficient[i]);
    return forces;
  }

  // By the sign at sixteen places of a step and at the turning points between them, then by halving
  // and Newton's method.
  std::optional<Real> first_zero(const std::vector<Real>& gaps, const Real& end) const {
    Real slope;
    const auto gap = [&](const Real& s) {
      Real value = gaps.back();
      slope = 0;
      for (auto k = gaps.size() - 1; k-- > 0;) {
        slope = slope * s + value;
        value = value * s + gaps[k];
      }
      return value;
    };
    constexpr int places = 16;
    Real low = 0;
    gap(low);
    bool falls = slope < 0;
    for (int n = 1; n <= places; ++n) {
      Real high = (end - start_) * n / places;
      if (gap(high) >= 0) {
        const bool fell = falls;
        falls = slope < 0;
        const Real place = high;
        if (fell && !falls) {
          Real before = low;
          for (int halving = 0; halving < 80; ++halving) {
            const Real middle = (before + high) / 2, value = gap(middle);
            // Convex near its least value, which is above 0 then.
            if (value > abs(slope) * (high - before)) break;
            (slope < 0 ? before : high) = middle;
          }
        }
        if (gap(high) >= 0) {
          low = place;
          continue;
        }
      }
      for (int halving = 0; halving < 60 || (low == 0 && halving < 200); ++halving) {
        const Real middle = (low + high) / 2;
        (gap(middle) >= 0 ? low : high) = middle;
      }
      for (int improved = 0; improved < 8; ++improved) {
        const Real value = gap(low);
        if (slope != 0) low -= value / slope;
      }
      return start_ + low;
    }
    return std::nullopt;
  }

  RealVector stopped(const RealVector& v, const std::vector<std::size_t>& contacts) const {
    if (contacts.empty()) return v;
    RealMatrix rows(contacts.size(), dof());
    for (std::size_t i = 0; i < contacts.size(); ++i)
      rows.row(Eigen::Index(i)) = row(contacts[i]).transpose();
    const RealMatrix responses = inverse_mass_ * rows.transpose();
    return v - responses * (RealMatrix((rows * responses).inverse()) * (rows * v));
  }

  // Impulses of this contact and those that are closed, by trial of all sets.
  Impact impact(const Real& t, int contact) {
    auto x = at(t);
    auto closed = held_;
    closed.push_back(std::size_t(contact));
    const auto restitution = [&](std::size_t i) {
      return int(i) == contact ? Real(problem_.contacts[i].restitution) : Real(0);
    };
    for (unsigned set = 1; set < 1u << closed.size(); ++set) {
      std::vector<std::size_t> active;
      for (std::size_t i = 0; i < closed.size(); ++i)
        if (set >> i & 1u) active.push_back(closed[i]);
      RealMatrix rows(active.size(), dof());
      RealVector wanted(active.size());
      for (std::size_t i = 0; i < active.size(); ++i) {
        rows.row(Eigen::Index(i)) = row(active[i]).transpose();
        wanted[Eigen::Index(i)] = -(1 + restitution(active[i])) * row(active[i]).dot(x.v);
      }
      const RealMatrix responses = inverse_mass_ * rows.transpose();
      const RealVector impulses = RealMatrix((rows * responses).inverse()) * wanted;
      const RealVector v = x.v + responses * impulses;
      bool fits = true;
      for (const auto& impulse : impulses) fits = fits && (impulse > 0 || is_zero(impulse));
      std::vector<std::size_t> touching;
      Real of_contact = 0;
      for (const auto i : closed) {
        const Real after = row(i).dot(v) + restitution(i) * row(i).dot(x.v);
        fits = fits && (after > 0 || is_zero(after));
        // Slower than this it does not rebound.
        if (row(i).dot(v) < Real(1e-15)) touching.push_back(i);
      }
      if (!fits) continue;
      for (std::size_t i = 0; i < active.size(); ++i)
        if (int(active[i]) == contact) of_contact = impulses[Eigen::Index(i)];
      rest(t, x.u, stopped(v, touching), touching);
      return {t, of_contact, contact};
    }
    throw std::logic_error("no impulses");
  }

  static constexpr int terms = 60;
  const model::ImpactProblem<>& problem_;
  RealMatrix damping_, stiffness_, inverse_mass_;
  Real step_;
  std::vector<model::HarmonicForce> forces_;
  Real start_;
  std::vector<RealVector> series_, multipliers_;
  std::vector<std::size_t> held_;
};

}  // namespace clackers::exact::testing_oracle
