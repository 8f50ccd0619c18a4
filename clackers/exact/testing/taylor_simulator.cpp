#include "clackers/exact/testing/taylor_simulator.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clackers::exact::testing_oracle {

TaylorSimulator::TaylorSimulator(const model::ImpactProblem<>& problem)
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

RealVector TaylorSimulator::forces_at(const Real& t) const {
  RealVector sum = multipliers_.back();
  for (auto k = multipliers_.size() - 1; k-- > 0;) sum = sum * (t - start_) + multipliers_[k];
  return sum;
}

TaylorSimulator::State TaylorSimulator::at(const Real& t) const {
  const Real s = t - start_;
  State x{series_.back(), RealVector::Zero(dof()), RealVector::Zero(dof())};
  for (auto k = series_.size() - 1; k-- > 0;) {
    x.a = x.a * s + 2 * x.v;
    x.v = x.v * s + x.u;
    x.u = x.u * s + series_[k];
  }
  return x;
}

std::optional<TaylorSimulator::Impact> TaylorSimulator::next(const Real& until) {
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

void TaylorSimulator::expand(const Real& t, const RealVector& u, const RealVector& v) {
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

bool TaylorSimulator::begins_positive(const std::vector<Real>& series, std::size_t from) {
  for (auto k = from; k < series.size() / 2; ++k)
    if (abs(series[k]) > Real(1e-40)) return series[k] > 0;
  return true;
}

void TaylorSimulator::rest(const Real& t, const RealVector& u, const RealVector& v,
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

Real TaylorSimulator::longest_step(const RealMatrix& squares) {
  const double fastest = std::sqrt(double(squares.cwiseAbs().rowwise().sum().maxCoeff()));
  return std::min(0.25, 8.0 / std::max(fastest, 1.0));
}

std::vector<Real> TaylorSimulator::gap_terms(std::size_t i) const {
  std::vector<Real> gaps;
  const auto b = row(i);
  for (const auto& coefficient : series_) gaps.push_back(b.dot(coefficient));
  gaps[0] -= Real(problem_.contacts[i].gap);
  return gaps;
}

std::vector<Real> TaylorSimulator::force_terms(Eigen::Index i) const {
  std::vector<Real> forces;
  for (const auto& coefficient : multipliers_) forces.push_back(coefficient[i]);
  return forces;
}

std::optional<Real> TaylorSimulator::first_zero(const std::vector<Real>& gaps,
                                                const Real& end) const {
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

RealVector TaylorSimulator::stopped(const RealVector& v,
                                    const std::vector<std::size_t>& contacts) const {
  if (contacts.empty()) return v;
  RealMatrix rows(contacts.size(), dof());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    rows.row(Eigen::Index(i)) = row(contacts[i]).transpose();
  const RealMatrix responses = inverse_mass_ * rows.transpose();
  return v - responses * (RealMatrix((rows * responses).inverse()) * (rows * v));
}

TaylorSimulator::Impact TaylorSimulator::impact(const Real& t, int contact) {
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

}  // namespace clackers::exact::testing_oracle
