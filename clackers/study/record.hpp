#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clackers/assess/convergence/assessment.hpp"
#include "clackers/assess/errors/score.hpp"
#include "clackers/methods/method.hpp"
#include "clackers/study/metric_result.hpp"
#include "clackers/study/profile.hpp"
#include "clackers/study/self_result.hpp"

namespace clackers::study {

/// A number with the words a reader needs beside it.
struct Quantity {
  std::string name;  ///< "omega_D1"
  double value = 0.0;
  std::string unit;  ///< "rad/s", empty when dimensionless
  std::string meaning;
};

/// What was run, where and by what: enough to run it again.
struct Provenance {
  std::string command;                             ///< as typed
  std::string version;                             ///< of clackers
  std::string compiler, machine, processor, date;  ///< date in UTC, ISO 8601
};

/// The problem of a study.
struct CaseSummary {
  std::string name, summary, equations;
  std::vector<Quantity> parameters, constants;
  double end = 0.0;                  ///< [s]
  double fast_period = 0.0;          ///< shortest damped period of the free masses [s]
  std::vector<double> impact_times;  ///< at most the first 1000 [s]
  long long impact_count = 0;
};

/// Steps of a study.
struct LadderPlan {
  double coarsest = 0.05;  ///< [s]
  int levels = 8;          ///< each half the one before
  int neighbours = 8;      ///< steps a level, ratio 2^(1/8)
};

/// A curve for a figure.
struct Curve {
  std::vector<double> t;               ///< [s]
  std::vector<std::vector<double>> y;  ///< one row a mass
};

/// The longest run that metrics are measured on; a stored row takes some 50 bytes.
inline constexpr long long most_metric_rows = 262144;

/// One method of a study.
struct MethodResult {
  std::string name;
  Claim claim;
  double contact_time = 0.0;          ///< [s], 0 for rigid contact
  std::string refusal, refusal_code;  ///< why the method cannot take the case; empty when it can
  bool complete = true;               ///< false: interrupted before its last level
  assess::Ladder ladder;
  assess::Assessment assessment;
  Curve error_history;        ///< |error in u| / initial envelope against time, at `history_step`
  double history_step = 0.0;  ///< [s]
  /// Without the true motion; nothing where no level was finished, or where the method claims no
  /// order that differences could be held to.
  std::optional<SelfResult> self_convergence;
  /// All metrics of the run with step `metrics_step`: the first of the finest level whose first run
  /// has fewer than `most_metric_rows` steps. Empty where that run failed or there is none.
  std::vector<MetricResult> metrics;
  double metrics_step = 0.0;  ///< [s], 0 without metrics
};

/// A study whole: what json holds, what reports show, what --baseline will read.
struct Record {
  static constexpr auto schema = "clackers/verify/1";
  Provenance provenance;
  CaseSummary problem;
  LadderPlan plan;
  Curve response;  ///< exact displacements, one row a mass [m]
  std::vector<MethodResult> methods;
  bool interrupted = false;
  std::vector<Profile> profiles = {};  ///< over the errors to reach on this case; profiles_of
};

}  // namespace clackers::study
