#pragma once

#include <string>

#include "clackers/base/codes.hpp"
#include "clackers/model/sink.hpp"

namespace clackers::model {

/// What a run cost, counted and not timed, so that it is the same on every machine.
struct Work {
  long long steps = 0;
  long long force_evaluations = 0;  ///< of C v + K u + p - f
  long long factorizations = 0;
  long long newton_iterations = 0;
  long long event_searches = 0;  ///< impacts located inside a step
};

/// How a run ended.
struct Outcome {
  bool finished = true;  ///< false: failed, or the sink ended it
  bool stopped_by_sink = false;
  Code reason = "run-failed";  ///< meaningful only for a failure
  std::string detail;          ///< the failure in a sentence, with its time; empty otherwise
  Work work;

  bool failed() const { return !finished && !stopped_by_sink; }
};

/// No run has more steps than this.
inline constexpr double most_steps = 1e9;

/// A method prepared for one problem and one step. Everything that depends on these two alone has
/// been done; the step loop allocates nothing.
class Run {
 public:
  virtual ~Run() = default;
  /// The whole run, states on start + n h, or where an adaptive method steps. May be repeated.
  virtual Outcome advance(Sink& sink) = 0;
};

}  // namespace clackers::model
