#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/model/impact_problem.hpp"
#include "clackers/model/motion.hpp"

namespace clackers::cases {

/// One parameter of a named case.
struct CaseParameter {
  std::string name;
  double default_value = 0.0;  ///< used when not set
  std::string unit;            ///< empty when dimensionless
  std::string allowed;         ///< "0 <= xi1 < 1"
  std::string meaning;
};

/// What is known of a case before its parameters are.
struct CaseEntry {
  std::string name;       ///< never changes its meaning
  std::string summary;    ///< one sentence, with its full stop
  std::string equations;  ///< of the paper: "Eq. (25)-(26)"
  std::vector<CaseParameter> parameters;
};

/// Parameters by name; those not named keep their default.
using Settings = std::vector<std::pair<std::string, double>>;

/// A derived constant with the words a reader needs.
struct Constant {
  std::string name;
  double value = 0.0;
  std::string unit, meaning;
};

/// A problem together with its reference.
struct Case {
  const CaseEntry* entry = nullptr;
  Settings values;  ///< all parameters, in the entry's order
  model::ImpactProblem<> problem;
  std::shared_ptr<const model::Motion> motion;
  std::vector<Constant> constants;     ///< derived: m2, k2, omega_D2, r*, margin, ...
  std::vector<Constant> indicators;    ///< I_ms, T_L, T_S, I_OC, with their threshold
  std::vector<double> damped_periods;  ///< of the free masses [s]
};

/// The threshold of "non-trivially contributing" in Eq. (11), of the spectral peak.
inline constexpr double standard_threshold = 0.1;

/// All cases, the default one first marked by default_case().
std::span<const CaseEntry> entries();
std::string_view default_case();  ///< "three-parameter"

/// The entry of a name; throws InputError with did-you-mean.
const CaseEntry& entry(std::string_view name);

/// Builds a case. Throws InputError for unknown names (with did-you-mean) and for values outside
/// their range; a mass ratio beyond r*(X) is told how far outside, where and when the masses would
/// touch away from equilibrium, and what to change. `threshold` lies in (0, 1).
Case make(std::string_view name, const Settings& settings = {},
          double threshold = standard_threshold);

}  // namespace clackers::cases
