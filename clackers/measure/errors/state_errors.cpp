#include "clackers/measure/errors/state_errors.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clackers/measure/errors/state_errors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace clackers::measure::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t group = 8;  // states at once
using Lanes = hn::CappedTag<double, group>;
using Vector = hn::Vec<Lanes>;

// A group of states, from number `first` on, mass by mass; behind the last state that one again.
HWY_INLINE void transpose(const double* rows, std::size_t dof, std::size_t first, std::size_t count,
                          double* to) {
  const Lanes d;
  if (dof > 2 || first + group > count) {
    for (std::size_t lane = 0; lane < group; ++lane) {
      const double* row = rows + std::min(first + lane, count - 1) * dof;
      for (std::size_t j = 0; j < dof; ++j) to[j * group + lane] = row[j];
    }
    return;
  }
  for (std::size_t lane = 0; lane < group; lane += hn::Lanes(d)) {
    Vector x, y;
    if (dof == 1) {
      x = hn::LoadU(d, rows + first + lane);
    } else {
      hn::LoadInterleaved2(d, rows + 2 * (first + lane), x, y);
      hn::StoreU(y, d, to + group + lane);
    }
    hn::StoreU(x, d, to + lane);
  }
}

// x' A x.
HWY_INLINE Vector form(const MechanicalEnergy::Rows& a, const double* x) {
  const Lanes d;
  Vector sum = hn::Zero(d);
  std::size_t k = 0;
  for (std::size_t i = 0; i < a.ends.size(); ++i) {
    Vector row = hn::Zero(d);
    for (; k < a.ends[i]; ++k)
      row = hn::Add(row, hn::Mul(hn::Set(d, a.values[k]), hn::LoadU(d, x + a.columns[k] * group)));
    sum = hn::Add(sum, hn::Mul(hn::LoadU(d, x + i * group), row));
  }
  return sum;
}

HWY_INLINE Vector energy(const MechanicalEnergy& energies, const double* u, const double* v) {
  const auto half = hn::Set(Lanes(), 0.5);
  return hn::Add(hn::Mul(half, form(energies.mass(), v)),
                 hn::Mul(half, form(energies.stiffness(), u)));
}

// Dof = 0: as many as there are.
template <std::size_t Dof>
HWY_INLINE void take_sized(const MechanicalEnergy& mechanics, std::size_t count,
                           const double* const* rows, StateErrors::Totals& out) {
  const Lanes d;
  const bool has_v = rows[1] != nullptr;
  const std::size_t dof = Dof > 0 ? Dof : out.u.size();
  // A group, the reference's, the largest errors and the energies.
  double* const u = out.work.data();
  double *const v = u + dof * group, *const ru = v + dof * group, *const rv = ru + dof * group;
  double *const errors = rv + dof * group, *const energies = errors + dof * group;
  std::fill_n(errors, dof * group, 0.0);
  auto most = hn::Zero(d), finite = hn::Zero(d);
  for (std::size_t first = 0; first < count; first += group) {
    for (std::size_t part = 0; part < 4; ++part)
      if (has_v || part % 2 == 0) transpose(rows[part], dof, first, count, u + part * dof * group);
    for (std::size_t lane = 0; lane < group; lane += hn::Lanes(d)) {
      for (std::size_t j = 0; j < dof; ++j) {
        const std::size_t at = j * group + lane;
        const auto error = hn::Abs(hn::Sub(hn::LoadU(d, u + at), hn::LoadU(d, ru + at)));
        hn::StoreU(hn::Max(hn::LoadU(d, errors + at), error), d, errors + at);
        // The difference of a number that is not finite and itself is NaN.
        finite = hn::Add(finite, hn::Sub(error, error));
        if (!has_v) continue;
        const auto speed = hn::LoadU(d, v + at);
        finite = hn::Add(finite, hn::Sub(speed, speed));
        hn::StoreU(hn::Abs(hn::Sub(speed, hn::LoadU(d, rv + at))), d,
                   &out.v[j * StateErrors::v_stride + first + lane]);
      }
      if (!has_v) continue;
      const auto found = energy(mechanics, u + lane, v + lane);
      const auto expected = energy(mechanics, ru + lane, rv + lane);
      if (!mechanics.is_nonlinear()) most = hn::Max(most, hn::Abs(hn::Sub(found, expected)));
      hn::StoreU(found, d, energies + lane);
      hn::StoreU(expected, d, energies + group + lane);
    }
    if (!has_v || !mechanics.is_nonlinear()) continue;
    for (std::size_t lane = 0; lane < group; ++lane) {
      const std::size_t row = std::min(first + lane, count - 1) * dof;
      energies[lane] += mechanics.stored(rows[0] + row);
      energies[group + lane] += mechanics.stored(rows[2] + row);
      out.energy = std::max(out.energy, std::abs(energies[lane] - energies[group + lane]));
    }
  }
  for (std::size_t j = 0; j < dof; ++j)
    out.u[j] = std::max(out.u[j], *std::max_element(errors + j * group, errors + (j + 1) * group));
  out.energy = std::max(out.energy, hn::GetLane(hn::MaxOfLanes(d, most)));
  out.finite += hn::GetLane(hn::SumOfLanes(d, finite));
  if (has_v) {
    out.last = energies[(count - 1) % group];
    out.last_reference = energies[group + (count - 1) % group];
  }
}

void take(const MechanicalEnergy& mechanics, std::size_t count, const double* const* rows,
          StateErrors::Totals& out) {
  if (out.u.size() == 1) return take_sized<1>(mechanics, count, rows, out);
  if (out.u.size() == 2) return take_sized<2>(mechanics, count, rows, out);
  take_sized<0>(mechanics, count, rows, out);
}

void integrate(std::size_t count, const double* half, const double* e, double* sums) {
  const Lanes d;
  double parts[2][group] = {};
  for (std::size_t i = 0; i < count; i += group)
    for (std::size_t lane = 0; lane < group; lane += hn::Lanes(d)) {
      const auto weight = hn::LoadU(d, half + i + lane), left = hn::LoadU(d, e + i + lane),
                 right = hn::LoadU(d, e + i + lane + 1);
      const auto add = [&](double* to, Vector x) HWY_ATTR {
        hn::StoreU(hn::Add(hn::LoadU(d, to + lane), hn::Mul(weight, x)), d, to + lane);
      };
      add(parts[0], hn::Add(left, right));
      add(parts[1], hn::Add(hn::Mul(left, left), hn::Mul(right, right)));
    }
  for (std::size_t k = 0; k < 2; ++k)
    for (const double part : parts[k]) sums[k] += part;
}

}  // namespace clackers::measure::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace clackers::measure {

HWY_EXPORT(take);
HWY_EXPORT(integrate);

StateErrors::StateErrors(std::size_t dof, const model::SmoothSystem<>& system)
    : dof_(dof), energies_(system) {
  totals_.u.resize(dof);
  totals_.v.resize(dof * v_stride);
  totals_.work.resize((5 * dof + 2) * 8);
}

void StateErrors::take(std::size_t count, const double* u, const double* v,
                       const double* u_reference, const double* v_reference) {
  const double* const rows[] = {u, v, u_reference, v_reference};
  HWY_DYNAMIC_DISPATCH(take)(energies_, count, rows, totals_);
}

void StateErrors::take_displacements(const double* found, const double* reference) {
  for (std::size_t j = 0; j < dof_; ++j)
    totals_.u[j] = std::max(totals_.u[j], std::abs(found[j] - reference[j]));
}

double StateErrors::energy_ratio() const {
  return totals_.last_reference > 0.0 ? totals_.last / totals_.last_reference
                                      : std::numeric_limits<double>::quiet_NaN();
}

void add_trapezoids(std::size_t count, const double* half, const double* e, double* sums) {
  HWY_DYNAMIC_DISPATCH(integrate)(count, half, e, sums);
}

}  // namespace clackers::measure
#endif
