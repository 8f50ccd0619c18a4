#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// What --require asks of every subject of a record, beside a verdict that neither disagrees nor is
/// undecided.
struct Requirement {
  enum class Kind {
    agrees,     ///< the verdict: a claim that was met
    behaviour,  ///< what was measured, claimed or not
    order,  ///< measured order, at least `value` within the tolerance of a claim; exact meets any
    error   ///< u_error of every run of the finest level, at most `value`
  };
  Kind kind = Kind::agrees;
  Behaviour behaviour = Behaviour::undecided;
  double value = 0.0;
  std::string text;  ///< as typed
};

/// Reads "agrees", a behaviour but `undecided`, "order:2" (0 < order <= 20) or "error:1e-3" (> 0).
/// Throws InputError for anything else, with did-you-mean for a word.
Requirement requirement_from(std::string_view text);

/// A subject that does not meet a requirement.
struct Unmet {
  std::string case_name, subject;
  /// What was found instead: "refused", "interrupted", "disagrees", "undecided" or "not claimed", or
  /// a behaviour, or "order" or "error" where `value` has it.
  std::string found;
  double value = 0.0;  ///< measured order or error; NaN where there is none
};
std::vector<Unmet> unmet(const Record& record, const Requirement& requirement);

/// exit_code(record), where a requirement that is not met counts as 1 and nothing but an interrupt
/// is worse.
int exit_code(const Record& record, const std::vector<Requirement>& requirements);

}  // namespace clackers::record
