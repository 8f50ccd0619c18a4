#pragma once

#include <cstddef>
#include <vector>

#include "clackers/exact/assembly/flight_shape.hpp"

namespace clackers::exact {

/// One function of time and how much of it each mass has.
struct ModalColumn {
  enum class Function {
    cosine,  ///< cos(q theta), the same in each flight
    sine,    ///< sin(q theta), reversed in odd flights
  };
  Function function = Function::cosine;
  double multiple = 1.0;          ///< q: frequency / Omega; exact with few bits, such as 1/2 or 3
  std::vector<double> amplitude;  ///< of each mass, after at most two roundings [m]
};

/// Flights that are sums of few functions: p_i(theta) = sum over columns of amplitude_i times
/// function. Omega is pi over the time between impacts. Columns of the same multiple follow each
/// other.
class ModalShape : public FlightShape {
 public:
  ModalShape(std::vector<ModalColumn> columns, const numerics::DoubleDouble& omega, double sigma);

  std::size_t dof() const override { return columns_.front().amplitude.size(); }
  void sample(std::span<const FlightInstant> instants, model::SampleBuffers out) const override;
  model::Kinematics amplitude() const override;
  /// Each of m terms carries the roundings of its factor, of its amplitude (two) and of their product; m - 1
  /// sums are rounded. A factor itself, in double-double, is within 2^-60 of its amplitude. Two
  /// terms of one frequency are at most sqrt(2) times their amplitude.
  model::Kinematics error() const override;

 private:
  std::vector<ModalColumn> columns_;
  std::vector<numerics::DoubleDouble> frequencies_;  // of the columns [rad/s]
  double sigma_ = 0.0;
};

/// out[i] = factors[0] columns[0][i] + factors[1] columns[1][i] + ... for i < count, added from left
/// to right: the same bits on every processor. With `bypass_cache` for an output larger than the
/// caches. At least one column.
void combine(const double* const* columns, const double* factors, std::size_t column_count,
             std::size_t count, double* out, bool bypass_cache);

}  // namespace clackers::exact
