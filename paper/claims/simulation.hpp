#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

// The second way: motions found from m, c, k and the start, impact by impact. They share no formula
// with Eq. (26).
namespace clackers::paper {

/// A pair designed by Eq. (9), (12), (13), (15)-(17) in plain double precision. What is designed may
/// be changed.
struct Pair {
  double X, Omega, sigma, xi1, xi2;  ///< 4N + 1, ω_D1, the common rate of decay [1/s], ξ
  double m[2], c[2], k[2], u[2], v[2];
  int masses = 2;       ///< 1: above a stop at its equilibrium
  bool contact = true;  ///< false: they pass through each other

  /// `r` is −u2(0) X/u1(0), the 3 of Eq. (18).
  Pair(double N, double damping, double r = 3.0, double u1 = 1.0, double m1 = 1.0, double k1 = 1.0);
  double quarters(double count) const;  ///< times π/(2 ω_D1): impacts are at 1, 3, 5, ...
  Pair apart() const;                   ///< without contact
  Pair from(double t) const;            ///< starts in the state that it has at t
  /// Eq. (A.1), with the start Eq. (8), (20), (22) and (26); of one mass Eq. (4) and (5).
  double written(double t, int mass) const;
  model::ImpactProblem<> problem(double end) const;
  exact::PiecewiseMotion motion(double end) const { return exact::PiecewiseMotion(problem(end)); }
};

/// Displacements [m] at a time, after an impact then.
inline Eigen::VectorXd u_of(const model::Motion& motion, double t) {
  return motion.at(t, model::Side::right).u;
}

/// The worst of the impacts of a simulated pair.
struct Impacts {
  long long count = 0;
  double u = 0.0;         ///< largest |u| at an impact, of u1(0)
  double late = 0.0;      ///< largest difference from (k − 1/2) π/ω_D1 [s]
  double turned = 0.0;    ///< largest |v(+)/v(−) + 1|
  double momentum = 0.0;  ///< largest sum of momenta, of that of mass 1
  double rate = 0.0;  ///< largest difference from σ of the rates at which the speeds fall [1/s]
  double closing = std::numeric_limits<double>::infinity();  ///< least closing speed [m/s]

  Impacts(const Pair& pair, double end);
};

/// The largest of |quantity(t)| at 500 times in [from, to].
double largest(double from, double to, const std::function<double(double t)>& quantity);
/// The largest |u(t) − factor u'(t + shift)| of two motions in [from, to].
double difference(const model::Motion& first, const model::Motion& other, double from, double to,
                  double factor = 1.0, double shift = 0.0);
/// u2 of a simulated pair at 40 equal parts of each of its half turns in [from, to].
std::vector<double> mass2(const Pair& pair, double from, double to);
/// |a_n|, n = 0, 1, ..., of u2 in the flight after the first impact, undamped, by the midpoint rule,
/// over the largest with n >= 1.
std::vector<double> harmonics(const Pair& pair);

/// A run with located impacts, and its largest difference from what the paper writes for a pair.
model::Trajectory history(const model::ImpactProblem<>& problem, const std::string& method,
                          double step);
double difference(const model::Trajectory& run, const Pair& pair);

}  // namespace clackers::paper
