#include "clackers/study/check_curves.hpp"

#include <cmath>

#include "clackers/study/reduced_curve.hpp"

namespace clackers::study {
namespace {

template <class Value>
Curve curve_of(const assess::Comparison& comparison, const Value& value) {
  Curve curve;
  curve.y.resize(comparison.dof());
  for (const auto row : kept_points(comparison.rows(), comparison.dof(), value)) {
    curve.t.push_back(comparison.history().t[row]);
    for (std::size_t mass = 0; mass < curve.y.size(); ++mass)
      curve.y[mass].push_back(value(mass, row));
  }
  return curve;
}

}  // namespace

Curve displacement_curve(const assess::Comparison& comparison) {
  return curve_of(comparison, [&](std::size_t mass, std::size_t row) {
    return comparison.history().u[row * comparison.dof() + mass];
  });
}

Curve error_curve(const assess::Comparison& comparison) {
  return curve_of(comparison, [&](std::size_t mass, std::size_t row) {
    const auto at = row * comparison.dof() + mass;
    return std::abs(comparison.history().u[at] - comparison.reference_u()[at]) /
           comparison.u_envelope()[mass];
  });
}

}  // namespace clackers::study
