#include "clackers/paper/free_flight.hpp"

#include <cmath>

namespace clackers::paper {

FreeFlight::FreeFlight(const cases::Case& which, int mass) {
  const auto i = mass - 1;
  const auto& system = which.problem.system;
  const double m = system.mass(i, i);
  sigma_ = system.damping(i, i) / (2.0 * m);
  omega_ = std::sqrt(system.stiffness(i, i) / m - sigma_ * sigma_);
  a_ = which.problem.start.u[i];
  b_ = (which.problem.start.v[i] + sigma_ * a_) / omega_;
}

double FreeFlight::u(double t) const {
  const double angle = omega_ * t;
  return std::exp(-sigma_ * t) * (a_ * std::cos(angle) + b_ * std::sin(angle));
}

double FreeFlight::v(double t) const {
  const double angle = omega_ * t;
  return std::exp(-sigma_ * t) * ((b_ * omega_ - sigma_ * a_) * std::cos(angle) -
                                  (a_ * omega_ + sigma_ * b_) * std::sin(angle));
}

}  // namespace clackers::paper
