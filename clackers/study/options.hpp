#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "clackers/study/verify.hpp"

namespace clackers::study {

/// Time for refinement where neither a budget nor levels are given [s].
inline constexpr double default_budget = 20.0;

/// An option of verify that is a number: `--name value` of the command, `name=value` in Python.
struct VerifyOption {
  enum class Kind { whole, number, duration };  ///< whole: from 1; duration [s]
  std::string_view name;                        ///< "samples-per-level"; Python has underscores
  std::string_view former;                      ///< an earlier name that is still taken, or empty
  Kind kind;
  int most;                      ///< of a whole number
  std::string_view placeholder;  ///< of the value in the help: "n"
  std::string_view meaning;      ///< with the default
  void (*set)(VerifyRequest& request, double value);
};
std::span<const VerifyOption> verify_options();

/// Sets the options that are given, by name. Levels that are asked for are those that are run: with
/// them the budget is 0 unless it is given.
void set_options(VerifyRequest& request, const std::map<std::string, double>& given);

}  // namespace clackers::study
