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
  void sample(const FlightBlock& block, std::size_t count, model::SampleBuffers out) const override;
  model::Kinematics amplitude() const override;
  /// Each of m terms carries the roundings of its factor, of its amplitude (two) and of their product; m - 1
  /// sums are rounded. A factor itself, in double-double, is within 2^-60 of its amplitude. Two
  /// terms of one frequency are at most sqrt(2) times their amplitude.
  model::Kinematics error() const override;

  const std::vector<ModalColumn>& columns() const { return columns_; }
  const std::vector<numerics::DoubleDouble>& frequencies() const { return frequencies_; }
  double sigma() const { return sigma_; }

 private:
  std::vector<ModalColumn> columns_;
  std::vector<numerics::DoubleDouble> frequencies_;  // of the columns [rad/s]
  double sigma_ = 0.0;
};

}  // namespace clackers::exact
