#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/base/judgement.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/judge/testing/synthetic_ladder.hpp"

// Ladders of errors that a simple rule would misjudge, for tests.
namespace clackers::judge {

/// A ladder of errors, what is claimed of it, and the verdict of an expert.
struct VerdictSequence {
  std::string_view name;  ///< a sentence in lower case: how it is made, and what it is
  std::function<std::vector<ErrorLevel>()> make;
  Claim claim;
  Behaviour behaviour = Behaviour::undecided;
  Verdict verdict = Verdict::undecided;
  std::string_view reason = {};                       ///< code, empty for none
  double order = 0.0, within = 0.0;                   ///< of the line; within 0: there is no line
  double contact_time = 0.0;                          ///< of a compliant contact [s]
  bool by_tolerance = false;                          ///< steps are tolerances
  std::function<void(measure::Ladder&)> change = {};  ///< what else is wrong with the runs
};

/// For names of tests: the words of the sentence in camel case.
inline std::string camel_case(std::string_view sentence) {
  std::string name;
  bool begins = true;
  for (const char c : sentence) {
    const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (letter) name += begins ? char(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = !letter;
  }
  return name;
}

inline void PrintTo(const VerdictSequence& row, std::ostream* out) { *out << row.name; }

/// The test of verdict_sequences_test.cpp; other files give it their rows.
class VerdictSequences : public testing::TestWithParam<VerdictSequence> {};

inline auto name_of_row = [](const testing::TestParamInfo<VerdictSequence>& row) {
  return camel_case(row.param.name);
};

/// Scores of finished runs with these displacement errors and all six impacts found. NaN is a
/// run that failed; an infinite error one that came to its end.
inline measure::Ladder scores_of(const std::vector<ErrorLevel>& errors) {
  measure::Ladder made;
  for (const auto& level : errors) {
    made.push_back({level.empty() ? 0.0 : level.front().step, {}});
    for (const auto& point : level) {
      measure::RunScore run;
      run.step = point.step;
      run.finished = point.error == point.error;
      if (!run.finished) run.failure = "left the finite numbers.";
      run.u_error = run.v_error = point.error;
      run.rounding_floor = point.floor;
      run.impacts = measure::ImpactScore{.expected = 6, .found = 6, .matched = 6};
      run.impacts->worst_time_error = point.error;
      made.back().runs.push_back(run);
    }
  }
  return made;
}

namespace synthetic {

/// The default ladder with one step a level, or with other numbers of levels and samples.
inline constexpr Shape single{.samples = 1};

inline Claim claims(double order) { return {Behaviour::proper, order, ""}; }
inline Claim claims_envelope(double order) { return {Behaviour::irregular, order, ""}; }
inline Claim claims_floor(std::string reason) {
  return {Behaviour::stagnating, 0.0, std::move(reason)};
}

}  // namespace synthetic
}  // namespace clackers::judge
