#include "clackers/exact/assembly/modal_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/numerics/sincospi.hpp"

namespace clackers::exact {

using numerics::DoubleDouble;

namespace {

// What multiplies the amplitudes of a column in displacement, velocity and acceleration.
struct Factors {
  double u = 0.0, v = 0.0, a = 0.0;
};

Factors factors_of(const ModalColumn& column, const DoubleDouble& w, double sigma,
                   const FlightInstant& now) {
  const auto [sine, cosine] = numerics::sincospi(now.theta_over_pi * column.multiple);
  const bool is_cosine = column.function == ModalColumn::Function::cosine;
  const auto [e, exponent] = now.decay;
  const auto signed_e = !is_cosine && now.is_odd ? -e : e;
  const auto p = is_cosine ? cosine : sine;
  const auto slope = (is_cosine ? -sine : cosine) * w;
  const auto velocity = slope - p * sigma;
  const auto acceleration = p * (DoubleDouble{sigma, 0.0} * sigma - w * w) - slope * (2.0 * sigma);
  const auto rounded = [&, binary = exponent](const DoubleDouble& x) {
    return numerics::scale((signed_e * x).hi, binary) + 0.0;  // never -0, which is printed as such
  };
  return {rounded(p), rounded(velocity), rounded(acceleration)};
}

}  // namespace

ModalShape::ModalShape(std::vector<ModalColumn> columns, const DoubleDouble& omega, double sigma)
    : columns_(std::move(columns)), sigma_(sigma) {
  for (const auto& column : columns_) frequencies_.push_back(omega * column.multiple);
}

void ModalShape::sample(std::span<const FlightInstant> instants, model::SampleBuffers out) const {
  const auto n = dof(), m = columns_.size(), rows = instants.size();
  std::vector<double> factors(3 * rows * m);  // quantity, instant, column
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t j = 0; j < m; ++j) {
      const auto f = factors_of(columns_[j], frequencies_[j], sigma_, instants[row]);
      factors[row * m + j] = f.u;
      factors[(rows + row) * m + j] = f.v;
      factors[(2 * rows + row) * m + j] = f.a;
    }
  // So many masses at a time that their amplitudes stay in the nearest cache for all instants.
  const std::size_t chunk = 4096 / m + 1;
  constexpr std::size_t larger_than_caches = 1 << 20;
  const bool bypass_cache = n * rows > larger_than_caches;
  std::vector<const double*> columns(m);
  for (std::size_t first = 0; first < n; first += chunk) {
    const auto count = std::min(chunk, n - first);
    for (std::size_t j = 0; j < m; ++j) columns[j] = columns_[j].amplitude.data() + first;
    std::size_t quantity = 0;
    for (const auto& values : {out.u, out.v, out.a}) {
      for (std::size_t row = 0; row < rows && !values.empty(); ++row)
        combine(columns.data(), &factors[(quantity * rows + row) * m], m, count,
                &values[row * n + first], bypass_cache);
      ++quantity;
    }
  }
}

model::Kinematics ModalShape::amplitude() const {
  const auto n = static_cast<Eigen::Index>(dof());
  model::Kinematics sum{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n),
                        Eigen::VectorXd::Zero(n)};
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const bool has_partner =
        j + 1 < columns_.size() && columns_[j + 1].multiple == columns_[j].multiple;
    const double w = std::hypot(frequencies_[j].hi, sigma_);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto mass = static_cast<std::size_t>(i);
      const double other = has_partner ? columns_[j + 1].amplitude[mass] : 0.0;
      const double size = std::hypot(columns_[j].amplitude[mass], other);
      sum.u[i] += size;
      sum.v[i] += size * w;
      sum.a[i] += size * w * w;
    }
    if (has_partner) ++j;
  }
  return sum;
}

model::Kinematics ModalShape::error() const {
  const double units = std::numbers::sqrt2 * (static_cast<double>(columns_.size()) + 3.0) + 0.1;
  auto bound = amplitude();
  for (auto* x : {&bound.u, &bound.v, &bound.a}) *x *= units * 0x1p-53;
  return bound;
}

}  // namespace clackers::exact
