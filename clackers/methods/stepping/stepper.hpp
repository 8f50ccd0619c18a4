#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "clackers/base/check.hpp"
#include "clackers/methods/integrator.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"
#include "clackers/methods/stepping/step_change.hpp"
#include "clackers/methods/stepping/step_plan.hpp"

namespace clackers::methods {

/// The stepper of every integrator. An integrator is a value with
///
///     struct Memory<Dof>                            what survives a step; made from the size
///     prepare(equation, h)                          names the weights of its equations at h
///     start(equation, state, memory)                fills the memory; not needed where it is that
///                                                   of AccelerationMemory
///     advance(equation, h, state, memory)           moves state and memory by h
///     partial(equation, h, s, state, memory)        only where advance() by s < h is impossible,
///                                                   because the memory holds steps of length h
///
/// none of which allocates. Time, blocks, going back, factorizations, failure and work are here.
template <class Integrator, int Dof>
class Stepper final : public AnyStepper<Dof> {
 public:
  using State = model::State<Dof>;
  using Memory = typename Integrator::template Memory<Dof>;

  /// The system must outlive the stepper. Throws InputError unless 0 < h < infinity, and for a
  /// system whose effective mass at h is not positive definite; `who` opens its message.
  Stepper(const Integrator& integrator, std::string_view who,
          const model::SmoothSystem<Dof>& system, const StepPlan& plan)
      : integrator_(integrator),
        who_(who),
        plan_(plan),
        equation_(system),
        memory_(system.dof()),
        first_memory_(memory_),
        part_memory_(memory_) {
    require_step(who_, plan_.h);
    part_.u = part_.v = model::Vector<Dof>::Zero(system.dof());
    prepare();
    if constexpr (has_powers)
      if (equation_.is_free()) make_powers();
  }

  void rebuild() override {
    equation_.rebuild();
    prepare();
  }

  void restart(const State& from) override {
    if constexpr (requires { integrator_.start(equation_, from, memory_); })
      integrator_.start(equation_, from, memory_);
    else
      AccelerationMemory().start(equation_, from, memory_);
  }

  std::size_t advance(long long first, std::span<State> states) override {
    first_memory_ = memory_;
    first_tally_ = equation_.tally();
    if constexpr (Dof == model::any_dof) {
      for (std::size_t i = 1; i < states.size(); ++i) {
        states[i] = states[i - 1];
        step(first + static_cast<long long>(i), states[i], memory_);
        if (equation_.failed()) return i;
      }
      return states.size() - 1;
    } else {
      return advance_in_registers(first, states);
    }
  }

  std::size_t fly(State& now, const Gaps& gaps, std::size_t most, double* u, double* v) override {
    if constexpr (has_powers) {
      if (!powers_.exists() || !equation_.is_free()) return 0;
      if constexpr (remembers_steps)
        if (!integrator_.is_full(memory_)) return 0;
      pack(now, memory_);
      const std::size_t made = powers_.advance(unknowns_, gaps, plan_.h, most, u, v);
      if (made == 0) return 0;
      unpack(now, memory_);
      if constexpr (remembers_steps) {
        const auto tally = equation_.tally();
        integrator_.find_acceleration(equation_, now, memory_);
        equation_.set_tally(tally);
      }
      equation_.add_evaluations(static_cast<long long>(made) * evaluations_);
      return made;
    }
    return AnyStepper<Dof>::fly(now, gaps, most, u, v);
  }

  void rewind(long long first, std::span<const State> states, std::size_t steps) override {
    memory_ = first_memory_;
    equation_.set_tally(first_tally_);
    part_ = states[0];
    for (std::size_t i = 1; i <= steps; ++i)
      step(first + static_cast<long long>(i), part_, memory_);
    part_memory_ = memory_;
    step(first + static_cast<long long>(steps) + 1, part_, part_memory_);
  }

  const State& partial(const State& from, double s) override {
    part_ = from;
    part_memory_ = memory_;
    equation_.drop_parts();
    if constexpr (requires { integrator_.partial(equation_, plan_.h, s, part_, part_memory_); })
      integrator_.partial(equation_, plan_.h, s, part_, part_memory_);
    else
      integrator_.advance(equation_, s, part_, part_memory_);
    return part_;
  }

  void go_on(const State& from, double s, const State& now) override {
    if constexpr (requires { Integrator::keeps_acceleration; }) {
      if (s > 0.0) {
        partial(from, s);
        memory_ = part_memory_;
        return;
      }
    }
    AnyStepper<Dof>::go_on(from, s, now);
  }

  bool failed() const override { return equation_.failed(); }
  Code failure() const override { return equation_.failure(); }
  void reset() override { equation_.set_tally({}); }
  void add_work(model::Work& work) const override { equation_.add_work(work); }

 private:
  static constexpr bool remembers_acceleration =
      std::is_same_v<Memory, AccelerationMemory::Memory<Dof>>;
  static constexpr bool remembers_steps = requires(Memory memory) { memory.count; };
  static constexpr bool has_powers =
      remembers_acceleration || remembers_steps || std::is_empty_v<Memory>;

  void prepare() {
    powers_.clear();
    equation_.drop_all();
    integrator_.prepare(equation_, plan_.h);
    equation_.keep();
    require_definite(who_, plan_.h, equation_.failed());
  }

  // Of a size that the compiler knows. All is to be inlined, however much else the source holds.
  [[gnu::flatten]] std::size_t advance_in_registers(long long first, std::span<State> states) {
    const Integrator integrator = integrator_;
    Memory memory = memory_;
    State now = states[0];
    for (std::size_t i = 1; i < states.size(); ++i) {
      integrator.advance(equation_, plan_.h, now, memory);
      now.t = plan_.time(first + static_cast<long long>(i));
      states[i] = now;
      if (equation_.failed()) return i;
    }
    memory_ = memory;
    return states.size() - 1;
  }

  // Memory and state as the unknowns of the step, and back.
  void pack(const State& x, const Memory& memory) {
    const auto n = std::size_t(x.u.size());
    std::copy_n(x.u.data(), n, &unknowns_[0]);
    std::copy_n(x.v.data(), n, &unknowns_[n]);
    if constexpr (remembers_acceleration) std::copy_n(memory.a.data(), n, &unknowns_[2 * n]);
    if constexpr (remembers_steps) integrator_.pack(x, memory, &unknowns_[0] + 2 * n);
  }
  void unpack(State& x, Memory& memory) const {
    const auto n = std::size_t(x.u.size());
    std::copy_n(&unknowns_[0], n, x.u.data());
    std::copy_n(&unknowns_[n], n, x.v.data());
    if constexpr (remembers_acceleration) std::copy_n(&unknowns_[2 * n], n, memory.a.data());
    if constexpr (remembers_steps) integrator_.unpack(&unknowns_[0] + 2 * n, x, memory);
  }

  // Where they save more than they take.
  void make_powers() {
    const auto n = std::size_t(part_.u.size()), made = (remembers_acceleration ? 3 : 2) * n;
    auto size = made;
    if constexpr (remembers_steps) size *= integrator_.steps;
    constexpr auto steps = StepPowers::steps;
    if (size > StepPowers::most_unknowns || plan_.whole < static_cast<long long>(4 * steps * size))
      return;
    unknowns_.resize(size);
    powers_.assign(n, made, added(part_.u.size()));
  }

  // What a step adds to u and v, and what it makes of all for a; see StepPowers.
  Eigen::MatrixXd added(Eigen::Index dof) {
    const auto tally = equation_.tally();
    const auto step = [&](MotionEquation<Dof>& equation) {
      return UnknownsStep{unknowns_, dof, plan_.h, [this, &equation] {
                            unpack(part_, part_memory_);
                            part_.t = 0.0;
                            integrator_.advance(equation, plan_.h, part_, part_memory_);
                            pack(part_, part_memory_);
                          }};
    };
    Eigen::MatrixXd change = step_change(step(equation_));
    evaluations_ = (equation_.tally().evaluations - tally.evaluations) / change.rows();
    equation_.set_tally(tally);
    if constexpr (requires { integrator_.change(equation_, plan_.h); }) {
      change = integrator_.change(equation_, plan_.h);
    } else {
      Eigen::Index column = 0;
      const auto system = with_column_as_load(equation_.system(), column);
      MotionEquation<Dof> loaded(system);
      integrator_.prepare(loaded, plan_.h);
      improve_step_change(step(loaded), column, change);
    }
    return change;
  }

  void step(long long k, State& now, Memory& memory) {
    integrator_.advance(equation_, plan_.h, now, memory);
    now.t = plan_.time(k);
  }

  Integrator integrator_;
  std::string who_;
  StepPlan plan_;
  MotionEquation<Dof> equation_;
  Memory memory_, first_memory_, part_memory_;
  typename MotionEquation<Dof>::Tally first_tally_;
  State part_;
  StepPowers powers_;
  std::vector<double> unknowns_;
  long long evaluations_ = 0;  // a step
};

}  // namespace clackers::methods
