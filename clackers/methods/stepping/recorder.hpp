#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/model/run.hpp"
#include "clackers/model/system.hpp"

namespace clackers::methods {

/// Connects a step loop with a sink: states are delivered in blocks, so that a step costs no virtual
/// call; an impact goes out at once, after the states before it. A state that is not finite ends
/// the run as diverged; states up to it are delivered, it is not.
template <int Dof>
class Recorder {
 public:
  using State = model::State<Dof>;
  using Vector = model::Vector<Dof>;

  static constexpr std::size_t block = 256;  ///< states, or up to `more` more
  static constexpr std::size_t more = 8;

  /// Allocates everything the run will need.
  explicit Recorder(Eigen::Index dof)
      : dof_(static_cast<std::size_t>(dof)),
        t_(block + more),
        u_(t_.size() * dof_),
        v_(u_.size()) {}

  /// Forgets the last run; the sink must outlive the new one.
  void begin(model::Sink& sink) {
    sink_ = &sink;
    count_ = 0;
    outcome_ = {};
  }

  /// Takes the next state. False: the run ends here.
  bool append(const State& now) {
    t_[count_] = now.t;
    for (std::size_t i = 0; i < size(); ++i) {
      u_[count_ * size() + i] = now.u[static_cast<Eigen::Index>(i)];
      v_[count_ * size() + i] = now.v[static_cast<Eigen::Index>(i)];
    }
    return ++count_ < block || flush();
  }

  /// Where the next states go, row-major, of room() of them; append() takes those written there.
  std::size_t room() const { return block + more - count_; }
  double* t() { return &t_[count_]; }
  double* u() { return &u_[count_ * size()]; }
  double* v() { return &v_[count_ * size()]; }
  bool append(std::size_t states) {
    count_ += states;
    return count_ < block || flush();
  }

  /// Takes an impact at `after`, the state on its later side. False: the run ends here.
  bool impact(const State& after, int contact, const Vector& v_before, double impulse);

  /// Ends the run with a failure at t [s], "t = 3 s: what"; states taken so far are delivered. Always
  /// false, for the loop to return.
  bool fail(Code reason, double t, std::string_view what);
  bool fail_diverged(double t);
  bool fail_step(double t, Code failure);  ///< of a stepper

  /// Delivers what is left and returns how the run ended.
  model::Outcome finish(const model::Work& work) {
    flush();
    outcome_.work = work;
    return outcome_;
  }

 private:
  std::size_t size() const {
    if constexpr (Dof == model::any_dof)
      return dof_;
    else
      return static_cast<std::size_t>(Dof);
  }

  std::span<const double> span(const Vector& x) const { return {x.data(), size()}; }

  void stop() {
    outcome_.finished = false;
    outcome_.stopped_by_sink = true;
  }

  bool is_finite(std::size_t k) const;
  bool flush();

  std::size_t dof_, count_ = 0;
  std::vector<double> t_, u_, v_;
  model::Sink* sink_ = nullptr;
  model::Outcome outcome_;
};

extern template class Recorder<1>;
extern template class Recorder<2>;
extern template class Recorder<model::any_dof>;

}  // namespace clackers::methods
