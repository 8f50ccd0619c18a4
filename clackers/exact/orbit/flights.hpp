#pragma once

#include <utility>

#include "clackers/exact/orbit/formulas.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/numerics/bounded.hpp"

namespace clackers::exact {

/// One or two masses, free between impacts, in closed form: flight k lasts from impact k to impact k + 1,
/// flight 0 from an instant at or before t = 0. Without impacts, from one change of stick and slip to the
/// next. Every formula is evaluated with its running error, from
/// the binary64 parameters on, so that error_bound() needs no derivation of its own.
/// Const, safe to share between threads.
class Flights : public model::Motion {
 public:
  int dof() const override { return int(problem_.dof()); }
  double end() const override { return problem_.end; }
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override;
  /// The accumulated error of the evaluation and half a unit of the result; at the double nearest to
  /// an impact that of the worse side.
  model::Kinematics error_bound(double t) const override;
  /// Impacts with t_k <= t.
  long long impact_count(double t) const override;
  model::MotionImpact impact(long long index) const override;

  /// What a method is given, each number the nearest double.
  const model::ImpactProblem<>& problem() const { return problem_; }
  /// Of motions whose formulas are written for numbers of any kind.
  const FlightsParameters& parameters() const { return parameters_; }
  long long flight_at(double t, model::Side side) const;

 protected:
  using Bounded = numerics::Bounded;
  using MassState = MassStateOf<Bounded>;
  using States = StatesOf<Bounded>;  // of the first dof() masses
  using Limits = LimitsOf<Bounded>;

  Flights() = default;
  explicit Flights(const FlightsParameters& parameters) : parameters_(parameters) {}

  /// The instant of impact k = 1, 2, ...; of k = 0 the beginning of the first flight.
  virtual Bounded instant(long long k) const = 0;
  /// Flight k, s seconds after its beginning.
  virtual States state(long long k, const Bounded& s) const = 0;
  /// The flight that holds at t, give or take one.
  virtual long long near_flight(double t) const = 0;
  virtual Limits limits(long long k) const = 0;
  /// From the beginning of flight k to t [s].
  virtual Bounded since(long long k, double t) const { return Bounded(t) - instant(k); }

  States at_time(double t, model::Side side) const;

  FlightsParameters parameters_;
  model::ImpactProblem<> problem_;
};

/// Of that kind of flights, by formulas.
template <class Kind, template <class> class FormulasOf>
class FlightsBy : public Kind {
 protected:
  using Bounded = numerics::Bounded;
  template <class... Rest>
  explicit FlightsBy(FormulasOf<Bounded> formulas, const Rest&... rest)
      : Kind(rest...), formulas_(std::move(formulas)) {}

  Bounded instant(long long k) const override { return formulas_.instant(k); }
  StatesOf<Bounded> state(long long k, const Bounded& s) const override {
    return formulas_.state(k, s);
  }
  LimitsOf<Bounded> limits(long long k) const override { return formulas_.limits(k); }

  FormulasOf<Bounded> formulas_;
};

}  // namespace clackers::exact
