#include "clackers/exact/elliptic/stopped_oscillator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/model/nonlinear_springs.hpp"

namespace clackers::exact {

using Law = model::NonlinearSprings::Law;

namespace {

Eigen::VectorXd scalar(double x) { return Eigen::VectorXd::Constant(1, x); }

std::shared_ptr<const model::NonlinearSprings> one_spring(Law law, double stiffness,
                                                          double length) {
  return std::make_shared<model::NonlinearSprings>(
      std::vector<model::NonlinearSprings::Row>{{scalar(1.0), law, stiffness, length}});
}

const DuffingParameters& checked(const DuffingParameters& p, std::string_view who) {
  if (!secant_stiffness<numerics::Wide>(p).is_positive())
    refuse(who, "b", p.b, fmt::format("b > -k/u0^2 = {}", -p.k / (p.u0 * p.u0)),
           "At the start the spring would pull away from the stop.", "not-admissible");
  return p;
}

}  // namespace

template <template <class> class FormulasOf>
template <class Parameters>
StoppedOscillator<FormulasOf>::StoppedOscillator(const Parameters& p, std::string_view who)
    : FlightsBy<Flights, FormulasOf>(FormulasOf<Bounded>(p), p) {
  const auto most = FormulasOf<Bounded>::most_flights;
  if (formulas_.flights.size() > most && formulas_.flights.back().start.value <= p.end)
    throw InputError(fmt::format("{}: more than {} impacts up to t_end = {}; allowed: at most so "
                                 "many. End the run earlier.",
                                 who, most, p.end),
                     "out-of-range");
  problem_.system.mass = scalar(formulas_.m);
  problem_.system.damping = problem_.system.stiffness = scalar(0.0);
  problem_.contacts = {{scalar(1.0), 0.0, p.eta}};
  problem_.start = {0.0, scalar(formulas_.flights[0].size.nearest()), scalar(0.0)};
  problem_.end = p.end;
}

template <template <class> class FormulasOf>
long long StoppedOscillator<FormulasOf>::near_flight(double t) const {
  const auto& flights = formulas_.flights;
  const auto after = std::ranges::upper_bound(flights, static_cast<long double>(t), {},
                                              [](const auto& f) { return f.start.value; });
  return std::max<std::ptrdiff_t>(0, after - flights.begin() - 1);
}

template <template <class> class FormulasOf>
model::Kinematics StoppedOscillator<FormulasOf>::envelope(double t) const {
  const auto k = this->flight_at(t, model::Side::left);
  const auto& now = formulas_.flights[std::size_t(k)];
  const double size = now.size.nearest(),
               strongest = std::min(size, formulas_.strongest().nearest());
  return {scalar(size), scalar(now.speed.nearest()),
          scalar(std::abs(formulas_.acceleration(strongest).nearest()))};
}

template class StoppedOscillator<PendulumFormulas>;
template class StoppedOscillator<DuffingFormulas>;

Pendulum::Pendulum(const PendulumParameters& p, std::string_view who) : StoppedOscillator(p, who) {
  problem_.system.nonlinear = one_spring(Law::sine, (formulas_.g / formulas_.l).nearest(), p.l);
}

Duffing::Duffing(const DuffingParameters& p, std::string_view who)
    : StoppedOscillator(checked(p, who), who) {
  problem_.system.stiffness(0, 0) = p.k;
  problem_.system.nonlinear = one_spring(Law::cubic, p.b, 0.0);
}

}  // namespace clackers::exact
