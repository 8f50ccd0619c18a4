#include "clackers/exact/pair/pair_constants.hpp"

#include <boost/math/constants/constants.hpp>

#include "clackers/exact/pair/admissibility.hpp"
#include "clackers/exact/pair/flight_constants.hpp"
#include "clackers/exact/pair/wide_motion.hpp"

namespace clackers::exact {

PairConstants pair_constants(const WideMotion& motion, const FrequencyRatio& ratio) {
  const auto problem = impact_problem(motion);
  const auto& [mass, damping, stiffness, load, nonlinear] = problem.system;
  const auto frequency = [&](std::size_t i) {
    return Wide(sqrt(motion.masses[i].stiffness_over_mass(motion)));
  };
  const Wide period = boost::math::constants::pi<Wide>() / motion.omega;
  PairConstants c;
  c.ratio = ratio;
  c.m1 = mass(0, 0);
  c.m2 = mass(1, 1);
  c.c1 = damping(0, 0);
  c.c2 = damping(1, 1);
  c.k1 = stiffness(0, 0);
  c.k2 = stiffness(1, 1);
  c.omega1 = to_double(frequency(0));
  c.omega2 = to_double(frequency(1));
  c.omega_D1 = to_double(motion.masses[0].multiple * motion.omega);
  c.omega_D2 = to_double(motion.masses[1].multiple * motion.omega);
  c.xi1 = to_double(motion.sigma / frequency(0));
  c.xi2 = to_double(motion.sigma / frequency(1));
  c.sigma = to_double(motion.sigma);
  c.u1 = problem.start.u[0];
  c.u2 = problem.start.u[1];
  c.v1 = problem.start.v[0];
  c.v2 = problem.start.v[1];
  c.period = to_double(period);
  c.first_collision = to_double(period / 2);
  c.r_star = r_star(ratio.odd);
  c.margin = admissibility_margin(ratio, to_double(motion.masses[0].mass / motion.masses[1].mass));
  return c;
}

}  // namespace clackers::exact
