#include "clackers/exact/testing/mass_simulator.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

namespace clackers::exact::testing_oracle {

MassSimulator::MassSimulator(RawSystem system) : s_(std::move(system)) {
  // u = L^-T modes * coordinates, with M = L L^T.
  const Eigen::LLT<RealMatrix> factor(s_.mass);
  const RealMatrix lower = factor.matrixL();
  const RealMatrix half = lower.triangularView<Eigen::Lower>().solve(s_.stiffness);
  RealMatrix reduced = lower.triangularView<Eigen::Lower>().solve(RealMatrix(half.transpose()));
  reduced = (reduced + RealMatrix(reduced.transpose())) / Real(2);
  const Eigen::SelfAdjointEigenSolver<RealMatrix> modes(reduced);
  shapes_ = lower.transpose().triangularView<Eigen::Upper>().solve(modes.eigenvectors());
  to_modes_ = shapes_.transpose() * s_.mass;
  rows_ = s_.contacts * shapes_;
  delassus_ = rows_ * rows_.transpose();
  for (Eigen::Index i = 0; i < s_.mass.rows(); ++i)
    modes_.emplace_back(Real(1), Real(2 * s_.sigma), Real(modes.eigenvalues()[i]));
  fly_from(0, s_.u, s_.v);
}

MassSimulator::State MassSimulator::at(const Real& t) const {
  const auto x = modal(t);
  return {shapes_ * x.u, shapes_ * x.v, shapes_ * x.a};
}

std::optional<RawImpact> MassSimulator::next(const Real& until) {
  std::optional<Real> first;
  for (Eigen::Index j = 0; j < rows_.rows(); ++j)
    if (const auto t = first_contact(j, first ? *first : until); t && (!first || *t < *first))
      first = t;
  if (!first) return std::nullopt;
  const auto x = modal(*first);
  RawImpact hit{*first, {}, shapes_ * x.v, {}, {}};
  // Instants of contacts that truly close together differ by rounding alone.
  for (Eigen::Index j = 0; j < rows_.rows(); ++j)
    if (abs(Real(rows_.row(j).dot(x.u))) < tiny(j) && Real(rows_.row(j).dot(x.v)) < 0)
      hit.contacts.push_back(static_cast<int>(j));
  const auto count = static_cast<Eigen::Index>(hit.contacts.size());
  RealMatrix w(count, count);
  RealVector closing(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto row = hit.contacts[static_cast<std::size_t>(i)];
    closing[i] = Real(rows_.row(row).dot(x.v));
    for (Eigen::Index j = 0; j < count; ++j)
      w(i, j) = delassus_(row, hit.contacts[static_cast<std::size_t>(j)]);
  }
  hit.impulses = w.llt().solve(RealVector(-(1 + s_.eta) * closing));
  RealVector v = x.v;
  for (Eigen::Index i = 0; i < count; ++i)
    v += hit.impulses[i] *
         RealVector(rows_.row(hit.contacts[static_cast<std::size_t>(i)]).transpose());
  hit.after = shapes_ * v;
  fly_from(*first, shapes_ * x.u, hit.after);
  return hit;
}

MassSimulator::Modal MassSimulator::modal(const Real& t) const {
  const auto n = static_cast<Eigen::Index>(modes_.size());
  Modal x{RealVector(n), RealVector(n), RealVector(n)};
  RawState state;
  for (Eigen::Index i = 0; i < n; ++i) {
    modes_[static_cast<std::size_t>(i)].put(t - start_, state, 0);
    x.u[i] = state.u[0];
    x.v[i] = state.v[0];
    x.a[i] = state.a[0];
  }
  return x;
}

void MassSimulator::fly_from(const Real& t, const RealVector& u, const RealVector& v) {
  start_ = t;
  const RealVector p = to_modes_ * u, q = to_modes_ * v;
  for (Eigen::Index i = 0; i < p.size(); ++i)
    modes_[static_cast<std::size_t>(i)].start(0, p[i], q[i]);
  // |G''| of e^(sigma s) times each gap.
  bounds_ = sizes_ = RealVector::Zero(rows_.rows());
  for (Eigen::Index j = 0; j < rows_.rows(); ++j)
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      const auto& mode = modes_[static_cast<std::size_t>(i)];
      const Real rate = mode.rate(s_.sigma), size = abs(Real(rows_(j, i))) * mode.amplitude();
      sizes_[j] += size;
      bounds_[j] += size * rate * rate;
    }
}

Real MassSimulator::tiny(Eigen::Index j) const {
  static const Real tolerance("1e-70");
  return sizes_[j] * tolerance;
}

std::optional<Real> MassSimulator::first_contact(Eigen::Index j, const Real& until) const {
  const auto row = rows_.row(j);
  auto x = modal(start_);
  Real s = 0, value = row.dot(x.u), slope = Real(row.dot(x.v)) + s_.sigma * value;
  const bool touching = value < tiny(j);
  if (touching) value = 0;
  const Real span = until - start_, bound = bounds_[j];
  if (bound == 0) return std::nullopt;
  for (int steps = 0;; ++steps) {
    if (steps > 100000 || !isfinite(value)) throw std::domain_error("simulator: undecided");
    if ((steps > 0 || (touching && slope <= 0)) && value < tiny(j)) {
      if (!(slope < 0 && slope * slope > 4 * bound * tiny(j)))
        throw std::domain_error("simulator: the masses graze");
      s += value / -slope;
      return s <= span ? std::optional<Real>(start_ + s) : std::nullopt;
    }
    const Real root = sqrt(slope * slope + 2 * bound * value);
    s += slope > 0 ? (slope + root) / bound : 2 * value / (root - slope);
    if (s > span) return std::nullopt;
    x = modal(start_ + s);
    const Real scale = exp(s_.sigma * s), g = row.dot(x.u);
    value = scale * g;
    slope = scale * (Real(row.dot(x.v)) + s_.sigma * g);
  }
}

}  // namespace clackers::exact::testing_oracle
