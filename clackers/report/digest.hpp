#pragma once

#include <optional>
#include <string>

#include "clackers/study/record.hpp"

namespace clackers::report {

/// Of one method what the verdict table shows. Of the finest level that was run, always the worst
/// of its neighbouring steps; NaN or nothing where nothing was measured.
struct Digest {
  double step = 0.0;  ///< nominal, of that level [s]; NaN without runs
  double u_error, v_error, energy_error;
  long long force_evaluations = 0;  ///< the largest
  double seconds = 0.0;             ///< the largest [s]
  /// Of the run with the most missed and extra collisions; the time error is the largest of all.
  std::optional<assess::ImpactScore> impacts;
  long long failed_runs = 0, runs = 0;  ///< of all levels
};
Digest digest(const study::MethodResult& method);

/// The name as one would type it: "newmark" for "newmark+event-driven", since event-driven is what a
/// name without "+contact" means.
std::string typed_name(const study::MethodResult& method);

/// "2.00 ±0.01", or an empty text where there is no line.
std::string order_text(const assess::LadderFit& fit, std::string_view between = " ");

/// "proper, order 2", "stagnating [contact-stiffness]"; without the code where there is no module.
std::string claim_text(const Claim& claim, bool with_code = true);

/// The word of the verdict column: the verdict, "refused" or "interrupted".
std::string verdict_word(const study::MethodResult& method);

/// What is said of a method beyond its numbers: its sentence or refusal and the code that
/// `clackers explain` knows.
struct Remark {
  std::string sentence, code;
};
/// Nothing for a method that simply does what it claims.
std::optional<Remark> remark(const study::MethodResult& method);

/// The verdict on a whole record.
struct Closing {
  std::string word;      ///< "agrees", "disagrees", "undecided", "not claimed" or "interrupted"
  std::string sentence;  ///< how many methods got which verdict
  std::string next;      ///< the command to type next
  std::string next_in_words;  ///< the same where there is no module for a long command
};
Closing closing(const study::Record& record);

/// "1 method", "7 methods".
std::string counted_methods(const study::Record& record);

/// "three-parameter (N = 2, xi1 = 0.05, a_t = 1 m)"; `space` stands around "=" and before units.
std::string case_text(const study::CaseSummary& problem, std::string_view space = " ");

/// "8 levels of 8 steps, h = 0.05 s to 0.00039 s, 13 to 1625 steps per fast period".
std::string ladder_text(const study::Record& record);

}  // namespace clackers::report
