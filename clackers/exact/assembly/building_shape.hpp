#pragma once

#include <vector>

#include "clackers/exact/assembly/flight_shape.hpp"

namespace clackers::exact {

/// The largest number of storeys: then no coefficient leaves the normal doubles.
inline constexpr double most_storeys = 500.0;

/// A shear building of n storeys, roof first, whose natural frequencies are 1, 3, ..., 2n-1 times
/// `frequency`, undamped: m_(i+1)/m_i and k_i/m_i, i = 1, ..., n.
struct Building {
  int storeys = 1;
  double roof_mass = 1.0;  ///< [kg]
  double frequency = 1.0;  ///< [rad/s]

  /// Of each storey [kg], roof first.
  std::vector<double> masses() const;
  /// Between storey i and the next one below, the last between it and the ground [N/m].
  std::vector<double> stiffnesses() const;
};

/// Buildings, one above the other in the order of their masses, each struck at its roof at rest; its
/// frequency is `multiple` (odd) times Omega, and `velocity` [m/s] is that of its roof just after
/// an impact with E = 1. With x = multiple (theta + pi/2), N = 2n - 1 and storey i
///
///     velocity     W_i cos^(N-2i+2)(x) sin^(2i-2)(x),    W_1 = velocity,          W_(i+1)/W_i = 2(n-i)/(2i-1)
///     storey drift D_i cos^(N-2i+1)(x) sin^(2i-1)(x),    D_1 = velocity/frequency, D_(i+1)/D_i = 2(n-i)/(2i+1)
///
/// A displacement is the sum of the drifts from its storey down: all of one sign, nothing cancels.
class BuildingShape : public FlightShape {
 public:
  struct Part {
    int storeys = 1;
    double multiple = 1.0;
    double velocity = 1.0;
  };
  BuildingShape(const std::vector<Part>& parts, double omega, double sigma);

  std::size_t dof() const override { return dof_; }
  void sample(const FlightBlock& block, std::size_t count, model::SampleBuffers out) const override;
  model::Kinematics amplitude() const override;
  /// The square of a cosine or sine is rounded once, its power j then at most 2j - 1 times; a product
  /// of powers, a coefficient and a sum of at most n drifts follow. Errors of cosine and sine near
  /// their zeros, 2^-63, add less than one. An acceleration is the difference of two such products.
  model::Kinematics error() const override;

  struct Coefficients {
    int storeys = 1;
    double multiple = 1.0, frequency = 1.0;
    bool reverses = false;     ///< sin(multiple pi/2) < 0
    std::vector<double> v, u;  ///< W and D
  };
  const std::vector<Coefficients>& parts() const { return parts_; }
  double sigma() const { return sigma_; }

 private:
  struct Peaks {
    double u = 0.0, v = 0.0, a = 0.0;
    double terms = 0.0;  // largest sum of the sizes of the two terms of a
  };
  // Of storey i = 1, 2, ... without decay, for E = 1.
  static Peaks peaks(const Coefficients& c, int i);

  std::vector<Coefficients> parts_;
  std::size_t dof_ = 0;
  double sigma_ = 0.0;
};

}  // namespace clackers::exact
