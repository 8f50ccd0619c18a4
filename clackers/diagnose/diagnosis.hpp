#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/base/codes.hpp"

namespace clackers::diagnose {

/// A number that a diagnosis rests on.
struct Fact {
  std::string name;  ///< one of `fact_names`
  double value = 0.0;
};

/// What facts are called, everywhere:
///
///     gain, runner-up-gain   rms distance of the history from the reference over that from the
///                            motion under this cause, and under the next best one
///     uncertainty            half width of the 95 % interval of `value`, in its unit
///     expected               what the case has in place of `value`
///     mass, impact, contact  which one, from 1
///     files                  histories that show the cause with the same value
///     causes                 number of causes that `gain` is of together; missing for one
///     order                  power of the step that `value` or the error falls with
///     floor                  error relative to the envelope below which nothing falls
///     step                   step at which something begins or ends [s]
///     steps                  `value` in steps
///     penetration            largest violation of the gap [m]
///     stiffness              apparent stiffness of the contact [N/m]
///     digits                 decimal digits of a printed number
///     share                  part of the rows, runs or impacts that show the cause, 0 to 1
///     time                   where it happens [s]
inline constexpr auto fact_names = std::to_array<std::string_view>(
    {"gain", "runner-up-gain", "uncertainty", "expected", "mass", "impact", "contact", "files",
     "causes", "order", "floor", "step", "steps", "penetration", "stiffness", "digits", "share",
     "time"});

/// One cause.
struct Diagnosis {
  std::string code;  ///< of one of causes()
  /// The parameter of the cause, in `unit`; NaN where the code has none. Cause::value
  /// is its meaning.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string unit{};
  double confidence = 0.0;       ///< 0 to 1; only what reaches `least_confidence` is reported
  std::vector<Fact> evidence{};  ///< in the order in which a reader wants them
  /// A name where the cure needs one: "t,u2,v2,u1,v1" for --columns, the unit "mm", a column.
  std::string text{};
  std::string runner_up{};  ///< code of the next best cause, empty for none

  /// The fact of that name; NaN without it.
  double fact(std::string_view name) const {
    for (const auto& one : evidence)
      if (one.name == name) return one.value;
    return std::numeric_limits<double>::quiet_NaN();
  }
};

/// A diagnosis with its value; the rest is to be filled in.
inline Diagnosis diagnosis_of(Code code, double value, std::string unit) {
  Diagnosis found;
  found.code = code.name();
  found.value = value;
  found.unit = std::move(unit);
  return found;
}

/// Below it a cause is not reported.
inline constexpr double least_confidence = 0.5;

/// What a cause is found in, for the rules of which cause brings about another.
enum class CauseGroup { reading, output, system, gap, impacts, time, method, ladder, other };

/// What a cause says of the system that was solved.
enum class CauseEffect {
  open,
  other_system,  ///< it is another one: no refinement leads to the motion of the case
  method,        ///< nothing: it lies in the method, its steps or its output
  noise,         ///< nothing: a floor is noise, not another motion
  no_ladder      ///< nothing: the histories show no order, whatever their errors
};

/// All that is said of one cause beside its detection. {name} in a sentence is the value, a fact or the
/// text of a diagnosis; a part in brackets is left out where a number or a text in it is not known.
struct Cause {
  Code code;
  CauseGroup group;
  CauseEffect effect;
  std::string_view unit,
      value;  ///< of the value, and what it is; empty for a cause without a number
  std::string_view what, cure;
  /// Right methods have it as well, such as those of first order: it leads to no other motion.
  bool is_of_right_methods = false;
};

/// Every cause that is looked for: of files, time, the system, impacts, and what refinement shows.
std::span<const Cause> causes();
/// The row of a code, or nullptr for one that is no cause.
const Cause* find_cause(std::string_view code);

/// What it means and what to do about it, as `clackers explain` prints it.
std::string meaning_of(const Cause& cause);

/// What was found and what to do about it, in one sentence.
std::string sentence_of(const Diagnosis& found);

/// Whether `cause` brings about what `implied` describes, and is sure enough to replace it.
bool brings_about(const Diagnosis& cause, const Diagnosis& implied);

/// Confidence from which a cause changes the verdict.
inline constexpr double sure = 0.9;

/// Whether a cause that is sure means another system than the case.
bool is_other_system(const Diagnosis& found);

/// Cause::is_of_right_methods of the cause that was found.
bool is_of_right_methods(const Diagnosis& found);

/// Whether a cause that is sure means that a floor is noise, not another motion.
bool is_noise(const Diagnosis& found);

/// Whether a cause that is sure means that no order can be read from the histories.
bool denies_ladder(const Diagnosis& found);

}  // namespace clackers::diagnose
