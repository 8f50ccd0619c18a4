// The linear map of perturbations over one period of a forced pair.
#include <algorithm>
#include <cmath>

#include "clackers/exact/orbit/forced_pair.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::exact {

// With x = (u, v) and f its rate of change, a flight maps a perturbation by F(T) of the free motion.
// Where g = b . x vanishes a perturbed impact comes b . dx/(b . f-) earlier, so that after it dx is
// R dx + (f+ - R f-) (b . dx)/(b . f-), R the impact law: the saltation matrix.
std::array<std::complex<double>, 4> ForcedPair::floquet_multipliers() const {
  using Eigen::Matrix4d, Eigen::Vector4d;
  const double T = this->T();
  Matrix4d flight = Matrix4d::Zero(), R = Matrix4d::Identity();
  Vector4d before, after;
  const auto limit = limits(1);
  const double m1 = formulas_.masses[0].m.nearest(), m2 = formulas_.masses[1].m.nearest();
  for (int i = 0; i < 2; ++i) {
    const auto& mass = formulas_.masses[std::size_t(i)];
    const double w = mass.w.nearest(), sigma = mass.sigma.nearest();
    const double e = std::exp(-sigma * T), c = std::cos(w * T), n = std::sin(w * T) / w;
    flight(i, i) = e * (c + sigma * n);
    flight(i, i + 2) = e * n;
    flight(i + 2, i) = -e * mass.square().nearest() * n;
    flight(i + 2, i + 2) = e * (c - sigma * n);
    const auto index = std::size_t(i);
    before[i] = limit.before[index].v.nearest();
    before[i + 2] = limit.before[index].a.nearest();
    after[i] = limit.after[index].v.nearest();
    after[i + 2] = limit.after[index].a.nearest();
  }
  const double impulse = (1.0 + formulas_.eta) / (1.0 / m1 + 1.0 / m2);  // of unit gap rate
  R(2, 2) -= impulse / m1;
  R(2, 3) += impulse / m1;
  R(3, 2) += impulse / m2;
  R(3, 3) -= impulse / m2;
  const Vector4d b(1.0, -1.0, 0.0, 0.0);
  const Matrix4d map = (R + (after - R * before) * b.transpose() / b.dot(before)) * flight;
  const Eigen::VectorXcd values = numerics::eigenvalues(map);
  std::array<std::complex<double>, 4> sorted{values[0], values[1], values[2], values[3]};
  std::ranges::sort(sorted, [](const auto& x, const auto& y) {
    if (std::abs(x) != std::abs(y)) return std::abs(x) > std::abs(y);
    return x.imag() > y.imag();
  });
  return sorted;
}

}  // namespace clackers::exact
