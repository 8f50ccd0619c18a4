#pragma once

#include <string_view>

#include "clackers/cases/case.hpp"

namespace clackers::cases {

/// All parameters of `entry` in its order: the given ones, else their defaults. Throws InputError
/// for a name that the case does not have (with did-you-mean) or that stands twice.
Settings complete(const CaseEntry& entry, const Settings& given);

/// The values of a case by name, for builders.
class Values {
 public:
  explicit Values(const Settings& values) : values_(values) {}
  /// The value of a parameter that the case has.
  double operator[](std::string_view name) const;

 private:
  const Settings& values_;
};

/// The largest N whose X = 4N + 1 is within the ratios that the reference takes.
inline constexpr double largest_N = 249'999'999;

/// X = 4N + 1 of Eq. (9). Throws InputError unless N is a whole number from 0 to largest_N.
double ratio_of(std::string_view who, double N);

/// t_end = 20 a_t of Eq. (24) [s]. Throws InputError unless 0 < a_t < infinity.
double end_of(std::string_view who, double a_t);

}  // namespace clackers::cases
