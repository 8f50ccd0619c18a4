#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace clackers {

/// What a code stands for: `clackers explain CODE` prints it, `explain` alone lists all.
struct CodeEntry {
  std::string_view name;  ///< kebab-case, never reused for another meaning
  std::string_view kind;  ///< "refusal", "failure", "behaviour", "reason", "diagnosis" or "verdict"
  std::string_view meaning;  ///< what happened and, but for a diagnosis, what to do about it
};

// clang-format off
/// Every code, in the order of the rows of codes.cpp, which have the meanings. Names are never
/// reused for another meaning.
inline constexpr auto code_names = std::to_array<std::string_view>({
    "exact", "proper", "reduced", "irregular", "stagnating", "divergent", "undecided",
    "contact-stiffness", "tolerance-floor", "unexplained-floor", "too-few-levels",
    "contact-not-resolved", "no-convergence-yet", "larger-than-motion", "simultaneous-impacts", "one-sample-a-level",
    "more-samples", "errors-cancel", "error-grows-again", "no-fixed-order", "wrong-limit",
    "improper-convergence", "differences-turn", "run-failed", "no-impact-law", "energy-growth", "error-growth",
    "diverged", "newton-failed", "complementarity-failed", "step-too-small", "too-many-impacts",
    "agrees", "disagrees", "not-claimed", "not-a-number", "not-finite", "out-of-range",
    "wrong-size", "null-pointer", "wrong-struct-size", "not-positive-definite", "not-symmetric",
    "starts-in-contact", "not-odd", "not-admissible", "not-exact-data", "unknown-name",
    "bad-syntax", "step-not-positive", "too-many-steps", "too-many-rows", "not-a-record",
    "other-study", "not-whole", "penalty-needs-elastic", "law-needs-restitution",
    "no-default-stiffness", "linear-only", "not-stated", "redundant-contacts", "integrator-not-taken",
    "wrong-resolution", "tolerance-too-small", "beyond-last-impact", "no-closed-form",
    "no-derivative", "needs-arb", "no-enclosure", "time-outside", "three-limits", "not-text",
    "not-an-array", "no-column", "ragged-row", "decimal-comma", "not-sorted", "too-short",
    "not-this-case", "printed-digits", "sparse-rows", "restitution-differs", "mass-ratio-differs",
    "frequency-differs", "damping-differs", "stiffness-differs", "mass-differs", "load-differs", "constant-force", "restitution-varies", "momentum-not-kept",
    "restitution-threshold", "energy-gained-at-impacts", "restitution-scatters", "force-step", "event-interpolated", "fixed-internal-step",
    "damping-changes-at-impact", "gap-differs", "parameter-differs",
    "time-shifted", "time-unit", "time-drifts", "unit-scaled", "columns-exchanged",
    "masses-exchanged", "sign-reversed", "velocity-at-half-steps", "velocity-order-lower", "velocities-differ",
    "starts-at-rest", "impact-missed", "impact-doubled", "impact-impulse-wrong",
    "impact-at-step-end", "impact-interpolated", "impact-tolerance", "acceleration-not-renewed", "contact-compliant",
    "contact-in-tension", "output-offset", "output-drifts", "step-without-effect", "steps-contradict-rows", "odd-file", "single-precision", "noise-floor", "commensurate-steps",
    "numerical-damping", "period-error", "unstable-coarse-steps", "ends-early", "output-resampled",
    "cannot-write", "cannot-read", "no-renderer", "render-failed", "program-failed",
    "program-timeout", "program-output", "callable-failed",
    "callable-output", "foreign-folder", "no-deck", "too-many-runs", "not-a-campaign", "other-campaign",
    "other-version", "database-busy", "shard-missing", "no-mpi", "scheduler-failed", "out-of-memory", "system-failed", "internal-error", "interrupted",
});
// clang-format on

/// All rows, in the order of `code_names`.
std::span<const CodeEntry> code_table();

/// The row of a code, or nullptr for an unknown one.
const CodeEntry* find_code(std::string_view name);

constexpr std::string_view name_of_entry(std::string_view name) { return name; }
constexpr std::string_view name_of_entry(const auto& entry) { return entry.code; }

/// A name of the table `entries`: texts, or rows with a member `code`. A misspelled one does not compile.
template <const auto& entries>
class NameOf {
 public:
  consteval NameOf(const char* name) : name_(name) {
    for (const auto& entry : entries)
      if (name_of_entry(entry) == name_) return;
    throw "no such name in the table";
  }
  constexpr std::string_view name() const { return name_; }

 private:
  std::string_view name_;
};

/// A name of `code_names`. A misspelled one does not compile.
class Code {
 public:
  consteval Code(const char* name) : name_(code_names[position(name)]) {}
  constexpr std::string_view name() const { return name_; }
  std::string_view meaning() const { return find_code(name_)->meaning; }
  friend constexpr bool operator==(Code a, Code b) { return a.name_ == b.name_; }

 private:
  static consteval std::size_t position(std::string_view name) {
    for (std::size_t i = 0; i < code_names.size(); ++i)
      if (code_names[i] == name) return i;
    throw "no such code in code_names";
  }

  std::string_view name_;
};

}  // namespace clackers
