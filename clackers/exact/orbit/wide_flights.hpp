#pragma once

#include <utility>

#include "clackers/exact/orbit/flights.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// Flights whose formulas are evaluated in 256 bits, so that sums and powers of many flights lose nothing.
template <template <class> class FormulasOf>
class WideFlights : public Flights {
 protected:
  using Wide = numerics::Wide;
  WideFlights(const FlightsParameters& parameters, FormulasOf<Wide> formulas)
      : Flights(parameters), formulas_(std::move(formulas)) {}

  Bounded instant(long long k) const override { return numerics::narrowed(formulas_.instant(k)); }
  Bounded since(long long k, double t) const override {
    return numerics::narrowed(Wide(t) - formulas_.instant(k));
  }
  States state(long long k, const Bounded& s) const override {
    return narrow(
        formulas_.state(k, Wide(numerics::WideReal(s.value), numerics::WideReal(s.error))));
  }
  Limits limits(long long k) const override {
    const auto limit = formulas_.limits(k);
    return {narrow(limit.before), narrow(limit.after), numerics::narrowed(limit.impulse)};
  }

  const FormulasOf<Wide> formulas_;

 private:
  static States narrow(const StatesOf<Wide>& wide) {
    States states;
    for (std::size_t i = 0; i < states.size(); ++i)
      states[i] = {numerics::narrowed(wide[i].u), numerics::narrowed(wide[i].v),
                   numerics::narrowed(wide[i].a)};
    return states;
  }
};

}  // namespace clackers::exact
