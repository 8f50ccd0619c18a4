#include "clackers/exact/pair/wide_motion.hpp"

#include <fmt/format.h>

#include <cmath>

#include <boost/math/constants/constants.hpp>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/pair/flight_constants.hpp"
#include "clackers/exact/pair/frequency_ratio.hpp"

namespace clackers::exact {
namespace {

Wide pi() { return boost::math::constants::pi<Wide>(); }

}  // namespace

Wide WideMotion::Mass::stiffness_over_mass(const WideMotion& motion) const {
  const Wide own = multiple * motion.omega;
  return own * own + motion.sigma * motion.sigma;
}

void require_end(std::string_view who, const WideMotion& motion) {
  require_positive(who, "t_end", motion.end);
  const Wide half_periods = motion.omega * motion.end / pi();
  if (half_periods > most_half_periods)
    refuse(who, "t_end", motion.end,
           fmt::format("0 < t_end <= {} s, which is 2^50 half periods",
                       std::nextafter(to_double(most_half_periods * pi() / motion.omega), 0.0)),
           "Beyond, collisions lie closer together than double precision can tell their times.");
}

FlightConstants flight_constants(const WideMotion& motion) {
  const Wide log_2 = log(Wide(2));
  FlightConstants c;
  c.collides = motion.collides;
  c.eta = motion.eta;
  c.end = motion.end;
  c.turns = to_triple_double(motion.omega / pi());
  c.period = to_triple_double(pi() / motion.omega);
  c.decay = to_double_double(motion.sigma / log_2);
  c.period_decay = to_double_double(motion.sigma * pi() / (motion.omega * log_2));
  if (motion.eta > 0.0) c.log2_eta = to_double_double(log(Wide(motion.eta)) / log_2);

  Wide energy = 0;
  for (const auto& mass : motion.masses) {
    const Wide &b = mass.start, &sigma = motion.sigma;
    const Wide own = mass.multiple * motion.omega;
    const Wide v_hit = -quarter_sine(mass.multiple) * b * own;
    const Wide square = mass.stiffness_over_mass(motion);
    MassConstants m;
    m.multiple = mass.multiple;
    m.b = to_double_double(b);
    m.v_cos = to_double_double(-b * sigma);
    m.v_sin = to_double_double(-b * own);
    m.a_cos = to_double_double(b * (sigma * sigma - own * own));
    m.a_sin = to_double_double(2 * b * sigma * own);
    m.v_hit = to_double_double(v_hit);
    m.a_hit = to_double_double(-2 * sigma * v_hit);
    m.u_envelope = to_double(abs(b));
    m.v_envelope = to_double(abs(b) * sqrt(square));
    m.a_envelope = to_double(abs(b) * square);
    c.masses.push_back(m);
    energy += mass.mass * v_hit * v_hit / 2;
    // The momenta of two masses are opposite, so either tells the impulse.
    c.impulse = to_double_double((1 + Wide(motion.eta)) * mass.mass * abs(v_hit));
  }
  c.energy = to_double_double(energy);
  return c;
}

model::ImpactProblem<> impact_problem(const WideMotion& motion) {
  const auto n = static_cast<Eigen::Index>(motion.masses.size());
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = system.damping = system.stiffness = Eigen::MatrixXd::Zero(n, n);
  problem.start = {0.0, Eigen::VectorXd(n), Eigen::VectorXd(n)};
  problem.end = motion.end;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& mass = motion.masses[static_cast<std::size_t>(i)];
    system.mass(i, i) = to_double(mass.mass);
    system.damping(i, i) = to_double(2 * mass.mass * motion.sigma);
    system.stiffness(i, i) = to_double(mass.mass * mass.stiffness_over_mass(motion));
    problem.start.u[i] = to_double(mass.start);
    // Not -sigma u when sigma is 0: that is -0, which prints as such.
    problem.start.v[i] = motion.sigma == 0 ? 0.0 : to_double(-motion.sigma * mass.start);
  }
  if (motion.collides) {
    model::Contact<> contact;
    contact.direction = Eigen::VectorXd::Ones(n);
    if (n == 2) contact.direction[1] = -1.0;
    contact.restitution = motion.eta;
    problem.contacts.push_back(contact);
  }
  return problem;
}

}  // namespace clackers::exact
