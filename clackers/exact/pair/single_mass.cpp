#include "clackers/exact/pair/single_mass.hpp"

#include "clackers/exact/pair/parameter_ranges.hpp"
#include "clackers/exact/pair/wide_motion.hpp"

namespace clackers::exact {
namespace {

WideMotion unit_mass(std::string_view who, double xi1, double eta, double end, bool collides) {
  require_damping_ratio(who, xi1);
  require_restitution(who, eta);
  WideMotion motion;
  motion.omega = sqrt(1 - Wide(xi1) * xi1);
  motion.sigma = xi1;
  motion.eta = eta;
  motion.end = end;
  motion.collides = collides;
  motion.masses = {{1, 1, 1.0}};
  require_end(who, motion);
  return motion;
}

}  // namespace

FreeMass::FreeMass(const FreeMassParameters& p, std::string_view who)
    : ClosedForm(unit_mass(who, p.xi1, 1.0, p.t_end, false)), parameters_(p) {}

RigidStop::RigidStop(const RigidStopParameters& p, std::string_view who)
    : ClosedForm(unit_mass(who, p.xi1, p.eta, p.t_end, true)), parameters_(p) {}

}  // namespace clackers::exact
