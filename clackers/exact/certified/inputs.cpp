#include "clackers/exact/certified/inputs.hpp"

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::certified {

Inputs::Inputs(const exact::PairParameters& p)
    : kind(Kind::pair),
      dof(2),
      odd(p.X < 1.0 ? std::round(1.0 / p.X) : p.X),
      exchanged(p.X < 1.0),
      mass(p.m1),
      r(p.r),
      stiffness(p.k1),
      damping(p.xi1),
      amplitude(p.A),
      eta(p.eta) {}

Inputs::Inputs(const exact::ExactDataParameters& p)
    : kind(Kind::exact_data),
      dof(2),
      odd(p.X),
      mass(p.m2),
      r(p.r),
      damping(p.sigma),
      frequency(p.Omega),
      amplitude(p.A_over_X),
      eta(p.eta) {}

Inputs::Inputs(const exact::RigidStopParameters& p) : damping(p.xi1), eta(p.eta) {}

Inputs::Inputs(const exact::FreeMassParameters& p) : collides(false), damping(p.xi1) {}

Inputs::Inputs(const model::Motion& motion) {
  const auto* known = exact::as_closed_form(motion);
  if (known == nullptr)
    throw InputError(
        "digits: this motion is known to double precision only; allowed: those of cases, and of problem files with "
        "linear springs.",
        "no-enclosure");
  *this =
      std::visit([](const auto& parameters) { return Inputs(parameters); }, known->parameters());
}

}  // namespace clackers::certified
